// The postures and the plans of the usual cell, by their numbers: they change only when somebody means them to.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <string>
#include <vector>

#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/plan/arm_configurations.hpp"
#include "tasks/rubik/plan/planner.hpp"

namespace mrroc::rubik {
namespace {

class UsualCell : public testing::Test {
 protected:
  UsualCell() {
    start.joints = cell.meeting().joints;
    const Pose back =
        cell.forward(Hand::postument, start.joints[0]) * Pose{Matrix3::Identity(), {0, 0, -0.1}};
    start.joints[0] = *cell.inverse(Hand::postument, back, start.joints[0]);
    start.grasp = {Hand::track, Face::D, Face::B};
  }
  [[nodiscard]] std::vector<ArmConfiguration> configurations(Hand hand, Place place) const {
    std::vector<ArmConfiguration> all = find_configurations(cell, hand);
    std::erase_if(all, [&](const ArmConfiguration& s) { return s.place != place; });
    return all;
  }
  static void expect_joints(const AxisVector& q, const std::vector<double>& wanted) {
    ASSERT_EQ(q.size(), static_cast<Eigen::Index>(wanted.size()));
    for (Eigen::Index k = 0; k < q.size(); ++k)
      EXPECT_NEAR(q[k], wanted[static_cast<std::size_t>(k)], 1e-4) << k;
  }

  /// From where a hand draws back to, to where its approach begins, straight along its z.
  void expect_straight_path(Hand hand, const ArmConfiguration& configuration) const {
    ASSERT_EQ(configuration.path.size(), 3U);
    const Pose T = cell.forward(hand, configuration.hold);
    for (std::size_t n = 0; n < 3; ++n) {
      const double distance =
          kRetreatDistance + (kApproachDistance - kRetreatDistance) * static_cast<double>(n) / 2;
      const Pose at = cell.forward(hand, configuration.path[n]);
      EXPECT_LT((at.p - (T * Vector3(0, 0, -distance))).norm(), 1e-6);
      EXPECT_LT((at.R - T.R).norm(), 1e-6);
    }
  }

  CubePlanCell cell{usual_cell(), viewing_place()};
  PlanStart start;
};

/// How a hand grips the cube: of several postures that differ by turns of the last joint the first one.
struct Grip {
  Hand hand;
  Place place;
  std::size_t turns;  ///< number of them
  std::vector<double> hold, back;
};

std::vector<Grip> usual_grips() {
  return {
      {Hand::postument,
       Place::front,
       9,
       {-0.94898, -1.69515, 0.13709, -0.44340, 4.04028, -5.57807},
       {-0.86653, -1.76232, 0.07437, -0.25100, 4.00818, -5.47973}},
      {Hand::postument,
       Place::side,
       4,
       {-1.23593, -1.77403, 0.26229, 1.10929, 1.24248, -3.70397},
       {-1.29301, -1.97457, 0.47851, 1.08526, 1.19005, -3.67990}},
      {Hand::postument,
       Place::offered,
       5,
       {-0.94898, -1.69515, 0.13709, -0.44340, 4.04028, -5.57807},
       {-0.86653, -1.76232, 0.07437, -0.25100, 4.00818, -5.47973}},
      {Hand::track,
       Place::front,
       8,
       {0.39160, 1.19486, -1.54740, 0.24097, 0.51340, 1.63394, -4.54637},
       {0.39160, 1.20359, -1.65072, 0.45413, 0.40316, 1.64006, -4.55260}},
      {Hand::track,
       Place::side,
       4,
       {0.49160, 1.05818, -1.78631, 0.31988, -0.88705, 4.97554, -4.74647},
       {0.49160, 1.01729, -1.95195, 0.34844, -0.74167, 5.00427, -4.77675}},
      {Hand::track,
       Place::offered,
       4,
       {0.39160, 1.19486, -1.54740, 0.24097, 0.51340, 1.63394, -3.76097},
       {0.39160, 1.20359, -1.65072, 0.45413, 0.40316, 1.64006, -3.76721}},
  };
}

TEST_F(UsualCell, HasTheseGripsAndTheirPaths) {
  for (const Grip& g : usual_grips()) {
    const std::vector<ArmConfiguration> found = configurations(g.hand, g.place);
    ASSERT_EQ(found.size(), g.turns);
    expect_joints(found[0].hold, g.hold);
    expect_joints(found[0].back(), g.back);
    for (std::size_t k = 0; k < found.size(); ++k) {
      const double step = g.place == Place::front ? std::numbers::pi / 2 : std::numbers::pi;
      const Eigen::Index last = found[k].hold.size() - 1;
      EXPECT_NEAR(found[k].hold[last] - found[0].hold[last], static_cast<double>(k) * step, 1e-9);
      EXPECT_EQ(found[k].shown, Vector3(0, 0, 0));
      expect_straight_path(g.hand, found[k]);
    }
  }
}

TEST_F(UsualCell, ShowsEachFreeFaceInThisPosture) {
  struct Shown {
    Hand hand;
    Vector3 face;
    std::vector<double> hold;
  };
  const std::vector<Shown> all{
      {Hand::postument, {0, 0, 1}, {-1.42050, -1.27602, 0.14782, -0.93963, 6.68276, 0.53217}},
      {Hand::postument, {1, 0, 0}, {-1.24184, -1.48245, -0.28657, 0.20552, 5.06132, -0.02133}},
      {Hand::postument, {-1, 0, 0}, {-1.03654, -1.23438, 0.23790, -0.64125, 1.91358, -0.19684}},
      {Hand::track, {0, 0, 1}, {0.39160, 1.39652, -1.46044, -0.02611, 0.85715, 2.52175, 2.60654}},
      {Hand::track, {1, 0, 0}, {0.39160, 1.24947, -1.42342, -0.27142, -0.09829, 4.44111, 2.44080}},
      {Hand::track, {-1, 0, 0}, {0.49160, 1.21107, -1.63180, -0.05404, -0.11751, 4.44977, 5.54361}},
  };
  for (const Hand hand : kHands) EXPECT_EQ(configurations(hand, Place::shown).size(), 3U);
  for (const Shown& s : all) {
    const std::vector<ArmConfiguration> found = configurations(s.hand, Place::shown);
    const auto configuration = std::ranges::find(found, s.face, &ArmConfiguration::shown);
    ASSERT_NE(configuration, found.end());
    expect_joints(configuration->hold, s.hold);
    ASSERT_EQ(configuration->path.size(), 1U);
    EXPECT_EQ(configuration->back(), configuration->hold);
    // The middle of the face is at the place of Viewing, and the face looks out of it.
    const Pose T_UE = cell.forward(s.hand, configuration->hold);
    const Vector3 out = T_UE.R * s.face;
    EXPECT_LT((out - cell.viewing()->T_UG.R.col(2)).norm(), 1e-6);
    EXPECT_LT((T_UE * Vector3(0, 0, depth(s.hand)) + out * (kEdge / 2) - cell.viewing()->T_UG.p).norm(),
              1e-6);
  }
}

TEST_F(UsualCell, PostureThatKeepsLessMarginIsNone) {
  const AxisVector hold = configurations(Hand::track, Place::front)[0].hold;
  const double margin = cell.joint_limit_margin(Hand::track, hold);
  EXPECT_TRUE(find_path(cell, Hand::track, hold, {.limits = 0}));
  EXPECT_FALSE(find_path(cell, Hand::track, hold, {.limits = margin + 0.5}));
  EXPECT_TRUE(find_configurations(cell, Hand::track, {.limits = 1}).empty());
}

TEST_F(UsualCell, PlansTakeTheseTimes) {
  struct Case {
    const char* moves;
    double seconds;
    int grips, regrasps;
    std::vector<double> steps;  // of each
  };
  Planner planner(cell);
  for (const Case& c :
       {Case{"U", 10.236, 1, 0, {10.236}},
        {"R", 18.096, 2, 1, {6.8, 11.296}},
        {"U R2 F'", 56.424, 5, 2, {14.056, 6.34, 17.692, 6.8, 11.536}},
        {"D2 L B' U", 86.3349, 9, 5, {6.8, 8.215, 16.772, 6.34, 11.536, 6.8, 11.536, 6.8, 11.536}}}) {
    const Planned planned = planner.make_plan(start, parse_moves(c.moves));
    ASSERT_TRUE(planned.plan) << planned.text;
    EXPECT_NEAR(planned.plan->seconds, c.seconds, 0.005) << c.moves;
    EXPECT_EQ(planned.plan->grips, c.grips) << c.moves;
    EXPECT_EQ(planned.plan->regrasps, c.regrasps) << c.moves;
    ASSERT_EQ(planned.plan->steps.size(), c.steps.size()) << c.moves;
    for (std::size_t k = 0; k < c.steps.size(); ++k)
      EXPECT_NEAR(planned.plan->steps[k].seconds, c.steps[k], 0.005) << c.moves << " " << k;
  }
  const Planned reading = planner.make_reading_plan(start);
  ASSERT_TRUE(reading.plan);
  EXPECT_NEAR(reading.plan->seconds, 20.7, 0.005);
  EXPECT_EQ(reading.plan->grips, 1);
}

TEST_F(UsualCell, MotionsOfAPlanTakeTheseTimesAndBeginSoMuchLater) {
  Planner planner(cell);
  const Planned planned = planner.make_plan(start, parse_moves("R"));
  ASSERT_TRUE(planned.plan);
  const auto& steps = planned.plan->steps;
  ASSERT_EQ(steps.size(), 2U);
  ASSERT_EQ(steps[0].before.size(), 2U);
  EXPECT_NEAR(steps[0].before[0].seconds, 1.06, 0.005);
  EXPECT_FALSE(steps[0].before[0].delay);
  EXPECT_EQ(steps[0].before[0].points.size(), 2U);
  EXPECT_NEAR(steps[0].before[1].seconds, 2.16, 0.005);
  ASSERT_TRUE(steps[0].before[1].delay);
  EXPECT_NEAR(*steps[0].before[1].delay, 0, 1e-9);
  EXPECT_EQ(steps[0].before[1].points.size(), 4U);
  EXPECT_NEAR(steps[0].retreat.seconds, 0.34, 0.005);
  EXPECT_TRUE(steps[0].withdrawal.points.empty()) << "it turns nothing";
  ASSERT_TRUE(steps[1].before.at(1).delay);
  EXPECT_NEAR(*steps[1].before[1].delay, 0.08, 0.005);
  EXPECT_NEAR(steps[1].withdrawal.seconds, 0.34, 0.005);
}

}  // namespace
}  // namespace mrroc::rubik
