// Fragments of the agent of a platform: when the planner makes them, from where and how fast, and when they are handed over.
#include <gtest/gtest.h>

#include "base/latency.hpp"
#include "tasks/rex_drive/locomotion.hpp"
#include "test/tasks/rex_drive/images.hpp"

namespace mrroc::rex_drive {
namespace {

using X = Locomotion::X;

TEST(Algorithm4, ANewPlanReplacesPlanAndFragmentsAndStartsThePlannerAtThePlatform) {
  X x = image_with(2);
  x.e.estimate.p = {0.1, 0.2, 0.3};
  x.T.desired = straight_plan(7);
  const Memory c = take_plan(x);
  EXPECT_TRUE(c.new_plan);
  EXPECT_EQ(c.taken, 7);
  EXPECT_TRUE(c.traj.empty());
  EXPECT_GE(c.plan.size(), 2U);
  EXPECT_EQ(c.trajgen.at.p.x, 0.1);
  EXPECT_EQ(c.trajgen.at.p.phi, 0.3);
  EXPECT_EQ(c.trajgen.at.v, 0);
}

TEST(Algorithm4, APlanThatWasTakenIsNotNew) {
  X x = image_with(2);
  x.c.taken = 7;
  x.T.desired = straight_plan(7);
  const Memory c = take_plan(x);
  EXPECT_FALSE(c.new_plan);
  EXPECT_EQ(c.traj.size(), 2U);
}

TEST(Algorithm4, StartsAtTheEndOfTheLastFragmentWhileThatIsUnderWay) {
  X x = idle_image();
  x.c.handed = 3;
  x.c.end = {{2, 1, 0.5}, 0.6, 0.1};
  x.T.desired = straight_plan(2);
  x.e.remaining = 100;
  EXPECT_EQ(take_plan(x).trajgen.at.v, 0.6);
  x.e.remaining = 5;  // over before a fragment can come
  EXPECT_EQ(take_plan(x).trajgen.at.v, 0);
  EXPECT_EQ(take_plan(x).trajgen.at.p.x, 2);
}

TEST(Algorithm6, DropsAFragmentOnlyWhenTheDriverIsReady) {
  X x = image_with(2);
  x.e.notified = 0;
  EXPECT_EQ(plan_and_hand_over(x).traj.size(), 1U);
  EXPECT_EQ(plan_and_hand_over(x).handed, 1);
  x.c.handed = 1;  // handed over, and the driver has not notified yet: the reply is older
  EXPECT_EQ(plan_and_hand_over(x).traj.size(), 2U);
  EXPECT_EQ(plan_and_hand_over(x).handed, 1);
}

TEST(Algorithm6, NewStartsThePlannerOnTheFirstPointAndDropsIt) {
  X x = idle_image();
  x.T.desired = straight_plan(1);
  x.c = take_plan(x);
  const std::size_t points = x.c.plan.size();
  const Memory c = plan_and_hand_over(x);
  EXPECT_FALSE(c.new_plan);
  EXPECT_TRUE(c.trajgen.busy);
  EXPECT_EQ(c.plan.size(), points - 1);
}

TEST(Algorithm6, APlannedFragmentIsAddedWhenPlanningHasTakenItsTime) {
  X x = idle_image();
  x.T.desired = straight_plan(1);
  x.c = take_plan(x);
  x.c = plan_and_hand_over(x);
  x.c.handed = 9;  // the driver wants nothing
  for (int k = 0; k < x.c.k.planner.planning; ++k) {
    EXPECT_TRUE(x.c.traj.empty());
    x.c = plan_and_hand_over(x);
  }
  x.c = plan_and_hand_over(x);
  EXPECT_EQ(x.c.traj.size(), 1U);
  EXPECT_TRUE(x.c.trajgen.busy) << "on the next point";
}

TEST(Algorithm7, HandsTheFirstFragmentOverWithItsStepsAndNotify) {
  X x = image_with(2);
  x.c.traj[0].duration = 2;
  const PlatformCommand y = fragment(x);
  EXPECT_EQ(y.instruction, Instruction::set);
  EXPECT_EQ(y.fragment.number, 1);
  EXPECT_EQ(y.fragment.steps, 100);
  EXPECT_EQ(y.fragment.notify, 46);
  x.c.handed = 1;
  EXPECT_EQ(fragment(x).instruction, Instruction::keep);
}

TEST(Algorithm7, RoutesMapOdometryAndPaceWithEveryCommand) {
  X x = image_with(1);
  x.c.pace = 0.4;
  x.T.map.pose = {50, true, {1, 2, 3}, {}};
  x.V.valid = true;
  x.V.step = 70;
  for (const PlatformCommand& y : {fragment(x), kBehaviours[0].f_ce(x), kBehaviours[2].f_ce(x)}) {
    EXPECT_EQ(y.pace, 0.4);
    EXPECT_EQ(y.map.step, 50);
    EXPECT_EQ(y.odometry.step, 70);
  }
}

TEST(Algorithm4, ANewPlanHasNoPointsAndBeginsBehindTheFragmentsHandedOver) {
  X x = telling_image();
  x.c.points = {0, 1};
  x.c.end = {{1.5, -0.5, 0.25}, 0, 0};
  x.c.before_plan = 2;
  x.T.desired = straight_plan(3);
  const Memory c = take_plan(x);
  EXPECT_EQ(c.before_plan, 6);
  EXPECT_TRUE(c.points.empty());
  EXPECT_EQ(c.handed, 6);
  x.c.taken = 3;
  EXPECT_EQ(take_plan(x).points.size(), 2U) << "the plan that was";
  EXPECT_EQ(take_plan(x).before_plan, 2);
}

// A fragment comes in time while more macrosteps of the last one are left than it takes: planning, start, messages and a reserve.

TEST(Algorithm4, AFragmentThatComesInTimeBeginsAtTheSpeedOfTheLastOnesEnd) {
  X x = telling_image();
  x.c.end = {{2, 1, 0.5}, 0.6, 0.1};
  x.T.desired = straight_plan(2);
  const int needed =
      x.c.k.planner.planning + 1 + static_cast<int>(latency::kMessage + latency::kCommandToReply) + 10;
  x.e.remaining = needed;
  EXPECT_EQ(take_plan(x).trajgen.at.v, 0);
  EXPECT_EQ(take_plan(x).trajgen.at.p.phi, 0.5);
  x.e.remaining = needed + 1;
  EXPECT_EQ(take_plan(x).trajgen.at.v, 0.6);
}

TEST(Algorithm4, OnSlipperyGroundCurvesAreSlowerAndNowhereFaster) {
  const auto speeds = [](double mu_y, double split) {
    X x = idle_image();
    x.T.desired = {.number = 1, .n = 3, .point = {{{1, 0}, {2, 0.3}, {3, 1}}}, .speed = 1.2};
    x.e.slip.mu_y = mu_y;
    x.e.slip.split = split;
    double sum = 0;
    for (const PlanPoint& point : take_plan(x).plan) sum += point.at.v;
    return sum;
  };
  const double usual = speeds(0.6, 0);
  EXPECT_GT(usual, 0);
  EXPECT_EQ(speeds(100, 0), usual);
  EXPECT_LT(speeds(0.05, 0), 0.9 * usual);
  EXPECT_LT(speeds(0.02, 0), speeds(0.05, 0));
  EXPECT_NEAR(speeds(0.1, 0.5), speeds(0.05, 0), 1e-12) << "the side that slips more";
  EXPECT_NEAR(speeds(0.1, -0.5), speeds(0.05, 0), 1e-12);
}

TEST(Algorithm4, WithoutAnyFrictionInTheEstimateCurvesAreAsOnTheMostSlipperyGround) {
  const auto route = [](double mu_y, double split) {
    X x = idle_image();
    x.T.desired = {.number = 1, .n = 3, .point = {{{1, 0}, {2, 0.3}, {3, 1}}}, .speed = 1.2};
    x.e.slip.mu_y = mu_y;
    x.e.slip.split = split;
    return take_plan(x).plan;
  };
  const Route least = route(0.01, 0);
  EXPECT_GT(least[1].at.v, 0);
  for (const auto& [mu_y, split] : {std::pair{0., 0.}, {0.6, 1.}, {0.6, 1.5}, {0.6, -1.5}, {-0.1, 0.}}) {
    const Route other = route(mu_y, split);
    ASSERT_EQ(other.size(), least.size()) << mu_y << ' ' << split;
    for (std::size_t k = 0; k < least.size(); ++k)
      EXPECT_EQ(other[k].at.v, least[k].at.v) << mu_y << ' ' << split << ", point " << k;
  }
}

X with_fragment(double ends_before, double begins) {
  X x = idle_image();
  Trajectory t;
  t.duration = 1;
  t.index = 4;
  t.knot.front().v = begins;
  t.knot.back() = {{3, 2, 1}, 0.5, 0.2};
  x.c.traj.push_back(t);
  x.c.end.v = ends_before;
  x.e.remaining = 10;
  return x;
}

TEST(Algorithm7, AFragmentFromRestWaitsForTheEndOfOneAtSpeed) {
  for (const double v : {0.3, -0.3}) EXPECT_EQ(fragment(with_fragment(v, 0)).instruction, Instruction::keep);
  EXPECT_EQ(fragment(with_fragment(0, 0)).instruction, Instruction::set);
  EXPECT_EQ(fragment(with_fragment(0.3, 0.3)).instruction, Instruction::set);
  X x = with_fragment(0.3, 0);
  x.e.remaining = 0;
  EXPECT_EQ(fragment(x).instruction, Instruction::set) << "it has ended";
}

TEST(Algorithm6, WhatIsHandedOverIsRememberedAndNothingElseWhileItWaits) {
  const Memory handed = plan_and_hand_over(with_fragment(0, 0));
  EXPECT_EQ(handed.handed, 1);
  EXPECT_EQ(handed.end.p.x, 3);
  EXPECT_EQ(handed.end.v, 0.5);
  EXPECT_EQ(handed.points, (std::vector<std::int32_t>{4}));
  EXPECT_TRUE(handed.traj.empty());
  const Memory waits = plan_and_hand_over(with_fragment(0.3, 0));
  EXPECT_EQ(waits.handed, 0);
  EXPECT_EQ(waits.end.v, 0.3);
  EXPECT_EQ(waits.traj.size(), 1U);
  EXPECT_TRUE(waits.points.empty());
}

}  // namespace
}  // namespace mrroc::rex_drive
