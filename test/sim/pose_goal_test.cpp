// A pose that is commanded is reached.
#include "test/sim/pose_goal.hpp"

#include <gtest/gtest.h>

namespace mrroc::sim::test {
namespace {

void expect_reached(const PoseGoalCount& count) {
  EXPECT_EQ(count.faults, 0) << count.worst;
  EXPECT_LE(count.refused, count.commands) << "what is refused tests no motion";
  EXPECT_LE(count.error_mm, 0.1) << count.worst;
  EXPECT_LE(count.error_deg, 0.02) << count.worst;
  EXPECT_LE(count.set_error_mm, 1e-3) << count.worst;
  EXPECT_LE(count.acceleration, 1) << "of the motors' limit";
  EXPECT_LE(count.speed, 1 + 1e-9);
  EXPECT_LE(count.longest, 95) << "steps after the macrostep";
}

TEST(PoseGoal, ASinglePoseIsReachedAndNotPassed) {
  const PoseGoalCount count = count_pose_goals(60, 7);
  expect_reached(count);
  EXPECT_LE(count.overshoot_mm, 1) << count.worst;
  EXPECT_LE(count.longest, 45) << "steps after the macrostep";
}

TEST(PoseGoal, TheLastPoseOfTwoInARowIsReached) { expect_reached(count_pose_goals(30, 8, 2)); }

}  // namespace
}  // namespace mrroc::sim::test
