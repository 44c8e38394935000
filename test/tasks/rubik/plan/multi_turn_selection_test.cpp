// Selection of the turns of the last joints that take the least time together.
#include "tasks/rubik/plan/multi_turn_selection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "base/representation.hpp"
#include "tasks/rubik/plan/grips.hpp"

namespace mrroc::rubik {
namespace {

using std::numbers::pi;

/// Arms that carry E along the axes and turn it by Euler angles; nothing is in the way.
class Gantry final : public PlanCell {
 public:
  Gantry() {
    // Tilted, so that the Euler angles are unique.
    meeting_.T_UM = {rotation_from_angle_axis({1, 0, 0}), {0.5, 0, 0.5}};
    for (const Hand hand : kHands) {
      limits_[index(hand)] = {{AxisVector::Constant(6, 1), AxisVector::Constant(6, 2)}, 1e3, 1e3};
      meeting_.joints[index(hand)] = *inverse(hand, front_grip(meeting_, hand), AxisVector::Zero(6));
    }
  }
  [[nodiscard]] const Meeting& meeting() const override { return meeting_; }
  [[nodiscard]] const Viewing* viewing() const override { return nullptr; }
  [[nodiscard]] const SpeedLimits& limits(Hand hand) const override { return limits_[index(hand)]; }
  [[nodiscard]] AxisVector motors(Hand, const AxisVector& joints) const override { return joints; }
  [[nodiscard]] AxisVector joints(Hand, const AxisVector& motors) const override { return motors; }
  [[nodiscard]] Pose forward(Hand, const AxisVector& joints) const override {
    return pose_from_euler_zyz(joints.head<6>());
  }
  [[nodiscard]] std::optional<AxisVector> inverse(Hand, const Pose& T_UE,
                                                  const AxisVector& near) const override {
    AxisVector q = euler_zyz_from_pose(T_UE);
    for (int k = 3; k < 6; ++k) q[k] = near[k] + std::remainder(q[k] - near[k], 2 * pi);
    return q;
  }
  [[nodiscard]] double joint_limit_margin(Hand, const AxisVector& joints) const override {
    return 1 - joints.cwiseAbs().maxCoeff() / 8;
  }
  [[nodiscard]] double manipulability(Hand, const AxisVector&) const override { return 1; }
  [[nodiscard]] bool is_free(const CellState&) const override { return true; }

 private:
  Meeting meeting_;
  std::array<SpeedLimits, 2> limits_;
};

class MultiTurnSelection : public testing::Test {
 protected:
  /// The track arm comes from the front, turns by so many quarters and has the cube; the other one goes.
  [[nodiscard]] Edge turn_by(int quarters, bool either_direction) const {
    const Hand T = Hand::track, P = Hand::postument;
    Edge e;
    e.holder = front(P);
    e.comer = front(T);
    e.turn = Move(Face::U, 1);
    e.quarters = quarters;
    e.either_direction = either_direction;
    e.to.grasp.hand = T;
    return e;
  }
  [[nodiscard]] int front(Hand hand) const {
    for (int k = 0; k < static_cast<int>(motions.classes(hand).size()); ++k)
      if (motions.example(hand, k).place == Place::front &&
          motions.classes(hand)[static_cast<std::size_t>(k)].size() > 1)
        return k;
    return -1;
  }
  [[nodiscard]] double seconds(const SelectedStep& step) const {
    double sum = 0;
    for (const ArmTransfer& m : step.motions)
      if (m.kind != MotionKind::turn) sum += motions.seconds(m);
    return sum;
  }
  /// The least time of all postures of the classes, by trying them all.
  [[nodiscard]] double least(const Edge& e, const std::array<int, 2>& start) const {
    const std::size_t T = index(Hand::track), P = index(Hand::postument);
    double least = std::numeric_limits<double>::infinity();
    for (const int holds : motions.classes(Hand::postument)[static_cast<std::size_t>(e.holder)])
      for (const int comes : motions.classes(Hand::track)[static_cast<std::size_t>(e.comer)])
        for (int to = 0; to < motions.start(Hand::track); ++to)
          for (const int sign : {1, -1}) {
            if (sign < 0 && !e.either_direction) continue;
            const double turned = last(to) - last(comes) - sign * e.quarters * pi / 2;
            if (motions.configuration(Hand::track, to).place != Place::front || std::abs(turned) > 1e-6)
              continue;
            StepConfigurations s{start, {}, {}};
            s.meeting[P] = s.after[P] = holds;
            s.meeting[T] = comes;
            s.after[T] = to;
            least = std::min(least, seconds({s, 0, motions_of(Hand::postument, e, s)}));
          }
    return least;
  }
  [[nodiscard]] double last(int number) const { return motions.configuration(Hand::track, number).hold[5]; }

  Gantry cell;
  Motions motions{cell};
};

TEST_F(MultiTurnSelection, AreTheQuickestOfAllThatDoTheStep) {
  ASSERT_GE(front(Hand::track), 0);
  ASSERT_GE(front(Hand::postument), 0);
  Node classes;
  classes.grasp.hand = Hand::postument;
  std::set<double> times;
  for (const double track : {-6.0, -2.0, 0.5, 3.0, 6.0})
    for (const double postument : {-5.0, 0.0, 5.0})
      for (const int quarters : {1, -1, 2, 3}) {
        ArmJoints joints = cell.meeting().joints;
        joints[index(Hand::track)][5] = track;
        joints[index(Hand::postument)][5] = postument;
        motions.start_at(joints);
        const std::array<int, 2> start{motions.start(Hand::postument), motions.start(Hand::track)};
        const Edge e = turn_by(quarters, quarters == 2);
        const auto selected = select_turns(motions, classes, start, {e});
        ASSERT_TRUE(selected);
        ASSERT_EQ(selected->size(), 1U);
        const SelectedStep& step = selected->front();
        EXPECT_EQ(step.configurations.before, start);
        EXPECT_NEAR(last(step.configurations.after[1]) - last(step.configurations.meeting[1]),
                    step.quarters * pi / 2, 1e-6);
        EXPECT_EQ(std::abs(step.quarters), std::abs(quarters));
        EXPECT_NEAR(seconds(step), least(e, start), 1e-9) << track << ' ' << postument << ' ' << quarters;
        times.insert(seconds(step));
      }
  EXPECT_GT(times.size(), 5U) << "it makes a difference";
}

// What is quickest now may be slow in the end: both steps count together.
TEST_F(MultiTurnSelection, OfSeveralStepsAreTheQuickestTogether) {
  Node classes;
  classes.grasp.hand = Hand::postument;
  ArmJoints joints = cell.meeting().joints;
  joints[index(Hand::track)][5] = 1;
  motions.start_at(joints);
  const std::array<int, 2> start{motions.start(Hand::postument), motions.start(Hand::track)};
  Edge first = turn_by(3, false);
  Edge back = turn_by(-3, false);  // the track arm holds, the other one comes again
  back.holder = *motions.turned_class(first.comer, 3);
  back.comer = front(Hand::postument);
  const auto selected = select_turns(motions, classes, start, {first, back});
  ASSERT_TRUE(selected);
  ASSERT_EQ(selected->size(), 2U);
  EXPECT_EQ((*selected)[1].configurations.before, (*selected)[0].configurations.after);
  // The least of all pairs: every path of the first step, followed by the best second one.
  double best = std::numeric_limits<double>::infinity();
  for (const int comes : motions.classes(Hand::track)[static_cast<std::size_t>(first.comer)])
    for (const int holds : motions.classes(Hand::postument)[static_cast<std::size_t>(first.holder)])
      for (int to = 0; to < motions.start(Hand::track); ++to) {
        if (motions.configuration(Hand::track, to).place != Place::front ||
            std::abs(last(to) - last(comes) - 3 * pi / 2) > 1e-6)
          continue;
        const StepConfigurations s{start, {holds, comes}, {holds, to}};
        Node after;
        after.grasp.hand = Hand::track;
        const auto rest = select_turns(motions, after, s.after, {back});
        if (rest)
          best =
              std::min(best, seconds({s, 3, motions_of(Hand::postument, first, s)}) + seconds(rest->front()));
      }
  EXPECT_NEAR(seconds((*selected)[0]) + seconds((*selected)[1]), best, 1e-9);
}

TEST_F(MultiTurnSelection, AStepInWhichTheCubeOnlyChangesHandsTurnsNothing) {
  Node classes;
  classes.grasp.hand = Hand::postument;
  const std::array<int, 2> start{motions.start(Hand::postument), motions.start(Hand::track)};
  Edge change = turn_by(3, true);
  change.turn.reset();
  const auto selected = select_turns(motions, classes, start, {change});
  ASSERT_TRUE(selected);
  ASSERT_EQ(selected->size(), 1U);
  EXPECT_EQ(selected->front().quarters, 0);
  EXPECT_EQ(selected->front().configurations.after, selected->front().configurations.meeting);
}

TEST_F(MultiTurnSelection, AreNoneWhereAMotionIsBlockedOrTheJointEnds) {
  Node classes;
  classes.grasp.hand = Hand::postument;
  const std::array<int, 2> start{motions.start(Hand::postument), motions.start(Hand::track)};
  EXPECT_FALSE(select_turns(motions, classes, start, {turn_by(40, false)})) << "no joint turns ten times";
  const auto nothing = select_turns(motions, classes, start, {});
  ASSERT_TRUE(nothing);
  EXPECT_TRUE(nothing->empty());
}

}  // namespace
}  // namespace mrroc::rubik
