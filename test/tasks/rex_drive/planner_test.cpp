#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tasks/rex_drive/plan/built_in_plans.hpp"
#include "tasks/rex_drive/planner/ecsa.hpp"
#include "tasks/rex_drive/planner/survey.hpp"
#include "test/tasks/rex_drive/random_plans.hpp"

namespace mrroc::rex_drive {
namespace {

double distance(const PlanarPose& a, const PlanarPose& b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The driver's rules for a fragment that follows another one, far from their limits.
void expect_join(const PathPoint& end, const PathPoint& begin) {
  EXPECT_LT(distance(end.p, begin.p), 1e-3);
  EXPECT_NEAR(end.p.phi, begin.p.phi, 1e-3);
  EXPECT_NEAR(end.v, begin.v, 1e-3);
  EXPECT_NEAR(end.w, begin.w, 1e-3);
}

void expect_within_limits(const Trajectory& t, const PathLimits& limits) {
  constexpr double kRounding = 1e-9;
  for (const PathPoint& p : t.knot) {
    EXPECT_LE(p.v, limits.speed + kRounding);
    EXPECT_GE(p.v, -0.021);
    EXPECT_LE(std::abs(p.w), limits.turn_rate + kRounding);
    EXPECT_LE(std::abs(p.v * p.w), limits.lateral + kRounding);
  }
  const std::int32_t steps = traj_to_steps(t);
  EXPECT_GE(steps, 1);
  EXPECT_LE(steps, kMaxFragmentSteps);
  EXPECT_NEAR(t.duration, steps * kPlatformPeriod, 1e-9);
}

/// Plans everything, and looks at what every plan must have. @return the iterations of each search
void expect_drivable(const std::vector<Plan>& plans, const PlanarPose& start, const PlannerParameters& k,
                     std::vector<std::int32_t>& iterations) {
  const PlannerSurvey s = survey(plans, start, k);
  ASSERT_FALSE(s.missed) << "plan " << s.missed->plan << " point " << s.missed->point;
  PathPoint at{start};
  for (const auto& [plan, t] : s.found) {
    expect_join(at, t.knot.front());
    expect_within_limits(t, k.path);
    iterations.push_back(t.iterations);
    at = t.knot.back();
  }
  const Plan& last = plans.back();
  const auto end = last.point[static_cast<std::size_t>(last.n - 1)];
  EXPECT_LT(std::hypot(at.p.x - end[0], at.p.y - end[1]), kSamePoint);
  EXPECT_EQ(at.v, 0);
  EXPECT_EQ(at.w, 0);
}

TEST(Planner, DrivesEveryBuiltInPlanSlowlyAndAsFastAsTheDriverAllows) {
  for (const std::string_view name : built_in_plan_names())
    for (const double speed : {0.3, 0.6, 0.8, 0.95}) {
      SCOPED_TRACE(std::string(name) + " at " + std::to_string(speed));
      PlannerParameters k;
      if (speed > 0.7) k.route = {.lateral = 1.6, .acceleration = 0.6, .turn_rate = 2.1};
      const PlanList plans = built_in_plan(name);
      std::vector<std::int32_t> iterations;
      expect_drivable(to_messages(plans, speed), plans.start, k, iterations);
    }
}

TEST(Planner, SlowTurnsOnTheSpotAreMadeInPieces) {
  for (const double turn_rate : {0.1, 0.3, 0.9}) {
    SCOPED_TRACE(turn_rate);
    PlannerParameters k;
    k.route.turn_rate = turn_rate;
    std::vector<std::int32_t> iterations;
    for (const char* name : {"pivot", "there_and_back"}) {
      const PlanList plans = built_in_plan(name);
      expect_drivable(to_messages(plans, 0.3), {0, 0, 3}, k, iterations);
      for (const auto& [plan, t] : survey(to_messages(plans, 0.3), {0, 0, 3}, k).found)
        for (const PathPoint& p : t.knot) EXPECT_LE(std::abs(p.w), std::max(turn_rate, 0.2) + 1e-9);
    }
  }
}

TEST(Planner, ATurnOnTheSpotThatIsLongerThanAFragmentIsNotFound) {
  PlannerParameters k;
  k.route.turn_rate = 0.3;
  EXPECT_TRUE(plan_leg({}, {.at = {.p = {0, 0, 1.02}}}, k).found);
  EXPECT_FALSE(plan_leg({}, {.at = {.p = {0, 0, 1.03}}}, k).found);
}

TEST(Planner, FindsTrajectoriesForEveryRandomPlan) {
  std::mt19937 random(1);
  std::vector<std::int32_t> iterations;
  const auto try_plan = [&](const Plan& plan) { expect_drivable({plan}, {}, {}, iterations); };
  for (int n = 0; n < 500 && !HasFailure(); ++n) {
    SCOPED_TRACE(n);
    try_plan(scattered_plan(random, 12, 0.6));
    try_plan(winding_plan(random, 12, n % 2 == 0 ? 0.6 : 0.95));
  }
  std::ranges::sort(iterations);
  ASSERT_FALSE(iterations.empty());
  EXPECT_LE(iterations[iterations.size() * 95 / 100], 6);
}

}  // namespace
}  // namespace mrroc::rex_drive
