// Plans of grasps in the real cell: they do what was asked for, within limits, without collisions, from every grasp.
#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/plan/planner.hpp"
#include "test/tasks/rubik/cell/plan_replay.hpp"

namespace mrroc::rubik {
namespace {

constexpr auto kP = Hand::postument;
constexpr auto kT = Hand::track;

/// A cell with flaws, for what cannot be done.
class FlawedCell : public PlanCell {
 public:
  explicit FlawedCell(const PlanCell& cell) : cell_(cell) {}
  [[nodiscard]] const Meeting& meeting() const override { return cell_.meeting(); }
  [[nodiscard]] const Viewing* viewing() const override { return cell_.viewing(); }
  [[nodiscard]] const SpeedLimits& limits(Hand h) const override { return cell_.limits(h); }
  [[nodiscard]] AxisVector motors(Hand h, const AxisVector& q) const override { return cell_.motors(h, q); }
  [[nodiscard]] AxisVector joints(Hand h, const AxisVector& m) const override { return cell_.joints(h, m); }
  [[nodiscard]] Pose forward(Hand h, const AxisVector& q) const override { return cell_.forward(h, q); }
  [[nodiscard]] std::optional<AxisVector> inverse(Hand h, const Pose& T,
                                                  const AxisVector& near) const override {
    return cell_.inverse(h, T, near);
  }
  [[nodiscard]] double joint_limit_margin(Hand h, const AxisVector& q) const override {
    return cell_.joint_limit_margin(h, q);
  }
  [[nodiscard]] double manipulability(Hand h, const AxisVector& q) const override {
    return cell_.manipulability(h, q);
  }
  [[nodiscard]] bool is_free(const CellState& s) const override { return cell_.is_free(s); }
  [[nodiscard]] Vector3 z(Hand h, const CellState& s) const {
    return forward(h, s.joints[index(h)]).R.col(2);
  }

 private:
  const PlanCell& cell_;
};

class CubePlan : public testing::Test {
 protected:
  CubePlan() {
    for (const Hand hand : kHands) start.joints[index(hand)] = cell.meeting().joints[index(hand)];
    // The postument begins drawn back.
    const Pose back = cell.forward(kP, start.joints[0]) * Pose{Matrix3::Identity(), {0, 0, -0.1}};
    start.joints[0] = *cell.inverse(kP, back, start.joints[0]);
    start.grasp = {kT, Face::D, Face::B};
  }
  void expect_plan(Planner& planner, const Moves& moves, const PlanOptions& options = {}) {
    const Planned planned = planner.make_plan(start, moves, options);
    ASSERT_TRUE(planned.plan) << planned.text;
    PlanReplay replay(cell, *planned.plan);
    int states = 0, free = 0;
    replay.run(*planned.plan, [&](const CellState& s) {
      ++states;
      free += cell.is_free(s);
    });
    EXPECT_EQ(states, free) << cell.touching();
    together += replay.together;
    EXPECT_EQ(replay.cube, after({}, moves)) << to_string(moves);
    EXPECT_EQ(after({}, planned.plan->turns), after({}, moves));
    for (const Step& s : planned.plan->steps)
      EXPECT_FALSE(s.turn && options.blocked.has(s.turn->face(), s.angle)) << to_string(moves);
  }

  CubePlanCell cell{usual_cell(), viewing_place()};
  PlanStart start;
  int together{};
};

TEST_F(CubePlan, DoesExactlyTheTurnsWithinLimitsAndWithoutCollisions) {
  Planner planner(cell);
  std::mt19937_64 random(1);
  for (int n = 0; n < 5; ++n) expect_plan(planner, random_moves(1 + 3 * n, random));
  EXPECT_GT(together, 3) << "motions of both arms at the same time";
  // The last joint of the track arm is turned back in time.
  expect_plan(planner, parse_moves("U R U R U R U R U R U R"));
}

TEST_F(CubePlan, TurnsAFaceThatJamsByThreeQuartersTheOtherWay) {
  Planner planner(cell);
  PlanOptions options;
  options.blocked.add(Face::R, 1);
  options.blocked.add(Face::U, -1);
  for (const char* moves : {"R", "U'", "R2", "U2", "R'", "R U' R2 U2 R U' R'"})
    expect_plan(planner, parse_moves(moves), options);
  const Planned planned = planner.make_plan(start, parse_moves("U'"), options);
  const Step& step = planned.plan->steps.back();
  // If the other direction jams as well, the hand that has come can go back.
  ASSERT_FALSE(step.withdrawal.points.empty());
  EXPECT_EQ(step.withdrawal.hand, step.comes);
  const PlanStart again{step.before_grasp, step.withdrawn};
  EXPECT_TRUE(planner.make_plan(again, parse_moves("U'"), {}).plan);
  EXPECT_NEAR(planned.plan->steps.back().angle, 1.5 * std::numbers::pi, 1e-12);
}

TEST_F(CubePlan, TurnsEveryFaceFromEveryGraspOfEitherHand) {
  Planner planner(cell);
  const ArmJoints joints = start.joints;
  for (const Hand hand : kHands)
    for (int palm = 0; palm < kFaces; ++palm)
      for (int jaw = 0; jaw < kFaces; ++jaw) {
        start.grasp = {hand, static_cast<Face>(palm), static_cast<Face>(jaw)};
        if (!is_valid(start.grasp)) continue;
        start.joints = joints;
        if (hand == kP) {
          start.joints[0] = cell.meeting().joints[0];
          const Pose back = cell.forward(kT, joints[1]) * Pose{Matrix3::Identity(), {0, 0, -0.1}};
          start.joints[1] = *cell.inverse(kT, back, joints[1]);
        }
        for (int face = 0; face < kFaces; ++face) {
          const Moves moves{Move(static_cast<Face>(face), 1)};
          const Planned planned = planner.make_plan(start, moves);
          ASSERT_TRUE(planned.plan) << to_string(start.grasp) << ' ' << face << ": " << planned.text;
          EXPECT_LE(planned.plan->grips, 5) << to_string(start.grasp) << ' ' << face;
          EXPECT_EQ(planned.plan->turns, moves);
        }
      }
}

TEST_F(CubePlan, FewestGripsForNeighbouringAndOppositeFaces) {
  Planner planner(cell);
  const auto grips = [&](std::string_view moves) {
    const Planned planned = planner.make_plan(start, parse_moves(moves));
    EXPECT_TRUE(planned.plan) << planned.text;
    return planned.plan ? planned.plan->grips : -1;
  };
  EXPECT_EQ(grips(""), 0);
  EXPECT_EQ(grips("U"), 1);
  EXPECT_EQ(grips("U R"), 3);
  EXPECT_EQ(grips("U R U"), 5);
  EXPECT_EQ(grips("U D"), 4);
  // Opposite faces may be exchanged: U, which the postument reaches at once, comes first.
  EXPECT_EQ(grips("D U"), 4);
  EXPECT_EQ(planner.make_plan(start, parse_moves("D U")).plan->turns, parse_moves("U D"));
}

TEST_F(CubePlan, TellsHowLongItTakesBySumsOfItsSteps) {
  Planner planner(cell);
  const Planned planned = planner.make_plan(start, parse_moves("U R2 F'"));
  ASSERT_TRUE(planned.plan);
  double seconds = 0;
  int grips = 0, regrasps = 0;
  for (const Step& s : planned.plan->steps) {
    double motions = s.retreat.seconds;
    for (const auto& m : s.before)
      motions = m.delay ? s.retreat.seconds + *m.delay + m.seconds : motions + m.seconds;
    EXPECT_GT(s.seconds, motions);
    seconds += s.seconds;
    ++grips;
    regrasps += s.regrasp();
  }
  EXPECT_DOUBLE_EQ(planned.plan->seconds, seconds);
  EXPECT_EQ(planned.plan->grips, grips);
  EXPECT_EQ(planned.plan->regrasps, regrasps);
  // A second time the paths are known, and the plan is the same.
  EXPECT_EQ(planner.make_plan(start, parse_moves("U R2 F'")).plan->seconds, seconds);
}

TEST_F(CubePlan, ShowsEveryFaceOnceToTheCamera) {
  const CubePlanCell tilted(usual_cell(), viewing_place(1));
  struct Case {
    const CubePlanCell& place;
    Face palm;
    int most_grips;
  };
  for (const Case& c :
       {Case{cell, Face::D, 2}, {cell, Face::R, 2}, {cell, Face::F, 2}, {tilted, Face::D, 3}}) {
    Planner planner(c.place);
    start.grasp = {kT, c.palm, c.palm == Face::R ? Face::U : Face::R};
    const Planned planned = planner.make_reading_plan(start);
    ASSERT_TRUE(planned.plan) << planned.text;
    PlanReplay replay(c.place, *planned.plan);
    replay.run(*planned.plan,
               [&](const CellState& s) { EXPECT_TRUE(c.place.is_free(s)) << c.place.touching(); });
    EXPECT_EQ(std::set<Face>(replay.shown.begin(), replay.shown.end()).size(), 6u);
    EXPECT_EQ(replay.shown.size(), 6u);
    EXPECT_EQ(replay.cube, Cube{});
    EXPECT_LE(planned.plan->grips, c.most_grips);
  }
}

TEST_F(CubePlan, NamesWhyThereIsNone) {
  Planner planner(cell);
  const Moves moves = parse_moves("R U");
  PlanStart bad = start;
  bad.grasp.jaw = opposite(bad.grasp.palm);
  EXPECT_EQ(planner.make_plan(bad, moves).why, NoPlan::bad_start);
  bad = start;
  bad.joints[1].conservativeResize(6);
  EXPECT_EQ(planner.make_plan(bad, moves).why, NoPlan::bad_start);
  bad = start;
  bad.joints[0][5] = std::nan("");
  EXPECT_EQ(planner.make_plan(bad, moves).why, NoPlan::bad_start);
  bad = start;
  bad.joints[0][0] = 3;
  EXPECT_EQ(planner.make_plan(bad, moves).why, NoPlan::bad_start);
  bad = start;
  bad.joints[0] = cell.meeting().joints[0];
  EXPECT_EQ(planner.make_plan(bad, moves).why, NoPlan::collision) << "the open hand is at the cube";

  /// No hand comes from the side.
  struct NoSide : FlawedCell {
    using FlawedCell::FlawedCell;
    [[nodiscard]] bool is_free(const CellState& s) const override {
      return FlawedCell::is_free(s) && z(kT, s).dot(z(kP, s)) < -0.9;
    }
  } no_side(cell);
  EXPECT_EQ(Planner(no_side).make_plan(start, moves).why, NoPlan::unreachable);
  EXPECT_TRUE(Planner(no_side).make_plan(start, parse_moves("U")).plan);

  /// There is a wall on the way to the side, for both.
  struct Wall : FlawedCell {
    using FlawedCell::FlawedCell;
    [[nodiscard]] bool is_free(const CellState& s) const override {
      const auto in_wall = [&](Hand h) {
        const double along = std::abs(z(h, s).dot(meeting().T_UM.R.col(2)));
        return along > 0.4 && along < 0.6;
      };
      return FlawedCell::is_free(s) && !in_wall(kT) && !in_wall(kP);
    }
  } wall(cell);
  EXPECT_EQ(Planner(wall).make_plan(start, parse_moves("R")).why, NoPlan::blocked);
}

}  // namespace
}  // namespace mrroc::rubik
