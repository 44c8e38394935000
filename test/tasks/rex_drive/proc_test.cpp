// What is added to a plan's points: turns on the spot, headings, speeds; and legs of trajectories, by value.
#include "tasks/rex_drive/plan/proc.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tasks/rex_drive/plan/plan_file.hpp"
#include "tasks/rex_drive/planner/trajgen.hpp"
#include "test/tasks/rex_drive/random_plans.hpp"

namespace mrroc::rex_drive {
namespace {

using std::numbers::pi;

constexpr double kLongest = kPlatformPeriod * kMaxFragmentSteps;  // of a fragment [s]

Plan plan_of(const std::vector<std::array<double, 2>>& points, double speed, std::int32_t ahead = 0) {
  Plan plan;
  plan.number = 1;
  plan.n = static_cast<std::int32_t>(points.size()) - ahead;
  plan.ahead = ahead;
  plan.speed = speed;
  std::ranges::copy(points, plan.point.begin());
  return plan;
}

void expect_point(const PlanPoint& p, double x, double y, double phi, double cruise, double v,
                  std::int32_t index) {
  EXPECT_NEAR(p.at.p.x, x, 1e-9);
  EXPECT_NEAR(p.at.p.y, y, 1e-9);
  EXPECT_NEAR(p.at.p.phi, phi, 1e-9);
  EXPECT_NEAR(p.cruise, cruise, 1e-9);
  EXPECT_NEAR(p.at.v, v, 1e-9);
  EXPECT_EQ(p.index, index);
}

TEST(Proc, AStraightWayIsPassedAtItsSpeed) {
  const Route route = proc(plan_of({{1, 0}, {2, 0}}, 0.5), {}, {});
  ASSERT_EQ(route.size(), 2U);
  expect_point(route[0], 1, 0, 0, 0.5, 0.5, 0);
  expect_point(route[1], 2, 0, 0, 0.5, 0, 1);
  EXPECT_EQ(route[0].at.w, 0);
}

// v^2 = 2 a s, from rest and to rest.
TEST(Proc, SpeedsAreWhatTheWayIsLongEnoughFor) {
  const RouteLimits limits{.acceleration = 0.5};
  const Route route = proc(plan_of({{0.1, 0}, {0.3, 0}, {1.3, 0}, {1.45, 0}, {1.51, 0}}, 0.9), {}, limits);
  ASSERT_EQ(route.size(), 5U);
  const double expected[]{std::sqrt(0.1), std::sqrt(0.3), std::sqrt(0.21), std::sqrt(0.06), 0};
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(route[k].at.v, expected[k], 1e-9) << k;
  PathPoint moving;
  moving.v = 0.4;
  EXPECT_NEAR(proc(plan_of({{0.1, 0}, {5, 0}}, 0.9), moving, limits)[0].at.v, std::sqrt(0.16 + 0.1), 1e-9);
}

TEST(Proc, NothingIsFarEnoughToGoThere) {
  EXPECT_TRUE(proc(plan_of({}, 0.5), {}, {}).empty());
  EXPECT_TRUE(proc(plan_of({{0.9 * kSamePoint, 0}, {0, 0.9 * kSamePoint}}, 0.5), {}, {}).empty());
  const Route route = proc(plan_of({{1, 0}, {1 + 0.9 * kSamePoint, 0}, {2, 0}}, 0.5), {}, {});
  ASSERT_EQ(route.size(), 2U);
  expect_point(route[1], 2, 0, 0, 0.5, 0, 2);
  EXPECT_EQ(proc(plan_of({{1.1 * kSamePoint, 0}}, 0.5), {}, {}).size(), 1U);
}

// Of 5 m at most, or of what is driven in 3.5 s.
TEST(Proc, LongLegsAreDividedEvenly) {
  const Route slow = proc(plan_of({{0, 0}, {3.6, 0}}, 0.5), {{-1, 0, 0}, 0, 0}, {});
  ASSERT_EQ(slow.size(), 4U) << "one of 1 m, and three of 1.2 m";
  for (std::size_t k = 1; k < 4; ++k)
    expect_point(slow[k], 1.2 * static_cast<double>(k), 0, 0, 0.5, k == 3 ? 0 : 0.5, 1);
  EXPECT_EQ(proc(plan_of({{5, 0}}, 1.45), {}, {}).size(), 1U);
  EXPECT_EQ(proc(plan_of({{5.01, 0}}, 1.45), {}, {}).size(), 2U);
  EXPECT_EQ(proc(plan_of({{1.75, 0}}, 0.5), {}, {}).size(), 1U);
  EXPECT_EQ(proc(plan_of({{1.76, 0}}, 0.5), {}, {}).size(), 2U);
}

TEST(Proc, APlatformAtRestTurnsFirstOneInMotionOnlyWhenItMust) {
  const auto first = [](double direction, double v) {
    PathPoint from{{1, 2, 0.3}, v, 0};
    const Route route =
        proc(plan_of({{1 + std::cos(0.3 + direction), 2 + std::sin(0.3 + direction)}}, 0.5), from, {});
    if (route.size() == 2) expect_point(route[0], 1, 2, 0.3 + direction, 0, 0, 0);
    return route.size();
  };
  EXPECT_EQ(first(0.249, 0), 1U);
  EXPECT_EQ(first(0.251, 0), 2U);
  EXPECT_EQ(first(-0.251, 0), 2U);
  EXPECT_EQ(first(pi / 3 - 0.001, 0.3), 1U);
  EXPECT_EQ(first(pi / 3 + 0.001, 0.3), 2U);
}

TEST(Proc, ASharpCornerIsATurnOnTheSpot) {
  const Route route = proc(plan_of({{1, 0}, {1, 1}, {2, 1}}, 0.5), {}, {});
  ASSERT_EQ(route.size(), 5U);
  expect_point(route[0], 1, 0, 0, 0.5, 0, 0);
  expect_point(route[1], 1, 0, pi / 2, 0, 0, 0);
  expect_point(route[2], 1, 1, pi / 2, 0.5, 0, 1);
  expect_point(route[3], 1, 1, 0, 0, 0, 1);
  expect_point(route[4], 2, 1, 0, 0.5, 0, 2);
  const auto size = [](double turn) {
    return proc(plan_of({{1, 0}, {1 + std::cos(turn), std::sin(turn)}}, 0.5), {}, {}).size();
  };
  EXPECT_EQ(size(kPivotAngle - 1e-6), 2U);
  EXPECT_EQ(size(kPivotAngle + 1e-6), 3U);
  EXPECT_EQ(size(-kPivotAngle - 1e-6), 3U);
}

TEST(Proc, SlowTurnsAreMadeInPiecesOfTheSameAngle) {
  const RouteLimits slow{.turn_rate = 0.3};
  const auto pieces = static_cast<std::size_t>(std::ceil(1.875 * (pi / 2) / 0.3 / kLongest));
  ASSERT_GT(pieces, 1U);
  const Route route = proc(plan_of({{0, 1}}, 0.5), {}, slow);
  ASSERT_EQ(route.size(), pieces + 1);
  for (std::size_t k = 0; k < pieces; ++k)
    expect_point(route[k], 0, 0, pi / 2 * static_cast<double>(k + 1) / static_cast<double>(pieces), 0, 0, 0);
}

TEST(Proc, HeadingsGoOnFromTheFirstOneWhateverItsTurns) {
  const Route route = proc(plan_of({{1, 0}, {1, -1}}, 0.5), {{0, 0, 6 * pi}, 0, 0}, {});
  ASSERT_EQ(route.size(), 3U);
  EXPECT_NEAR(route[0].at.p.phi, 6 * pi, 1e-9);
  EXPECT_NEAR(route[2].at.p.phi, 6 * pi - pi / 2, 1e-9);
}

TEST(Proc, PointsAheadAreNoPartOfTheRouteButTheLastOneIsPassed) {
  const auto points = std::vector<std::array<double, 2>>{{1, 0}, {2, 0}, {3, 0}};
  const Route route = proc(plan_of(points, 0.5, 1), {}, {});
  ASSERT_EQ(route.size(), 2U);
  expect_point(route[1], 2, 0, 0, 0.5, 0.5, 1);
  EXPECT_EQ(proc(plan_of(points, 0.5, 0), {}, {}).size(), 3U);
}

/// Curvatures of a leg's cubic at its ends, from the angles to its chord.
std::pair<double, double> curvatures(const PathPoint& a, const PathPoint& b) {
  const double chord = std::atan2(b.p.y - a.p.y, b.p.x - a.p.x);
  const double length = std::hypot(b.p.x - a.p.x, b.p.y - a.p.y);
  const double alpha = wrap_angle(a.p.phi - chord), beta = wrap_angle(b.p.phi - chord);
  return {-(4 * alpha + 2 * beta) / length, (2 * alpha + 4 * beta) / length};
}

TEST(Proc, OfAnyWindingWayCurvatureAndSpeedsKeepTheirRules) {
  std::mt19937 random(5);
  const RouteLimits limits{.lateral = 0.4, .acceleration = 0.3, .turn_rate = 0.8};
  int passed = 0, slowed = 0, by_turn_rate = 0;
  for (int run = 0; run < 200; ++run) {
    SCOPED_TRACE(run);
    const Plan plan = winding_plan(random, 12, 0.9);
    const PathPoint from{{0, 0, 0.1}, run % 2 == 0 ? 0 : 0.2, 0};
    const Route route = proc(plan, from, limits);
    std::vector<PathPoint> at{from};
    for (const PlanPoint& p : route) at.push_back(p.at);
    EXPECT_EQ(at.back().v, 0);
    for (std::size_t k = 1; k < at.size(); ++k) {
      const PlanPoint& p = route[k - 1];
      const double way = std::hypot(at[k].p.x - at[k - 1].p.x, at[k].p.y - at[k - 1].p.y);
      EXPECT_LE(at[k].v * at[k].v, at[k - 1].v * at[k - 1].v + 2 * limits.acceleration * way + 1e-9);
      if (k > 1) {
        EXPECT_LE(at[k - 1].v * at[k - 1].v, at[k].v * at[k].v + 2 * limits.acceleration * way + 1e-9);
      }
      if (p.cruise == 0) {
        EXPECT_EQ(way, 0);
        EXPECT_EQ(at[k].v, 0);
        continue;
      }
      const auto [begin, end] = curvatures(at[k - 1], at[k]);
      const double kappa = std::max({std::abs(begin), std::abs(end), 1e-9});
      EXPECT_NEAR(p.cruise, std::min({0.9, std::sqrt(0.4 / kappa), 0.8 / kappa}), 1e-6);
      slowed += p.cruise < 0.89;
      by_turn_rate += 0.8 / kappa < std::sqrt(0.4 / kappa);
      EXPECT_LE(at[k].v, p.cruise + 1e-12);
      if (at[k].v == 0) continue;
      // It is passed: the way goes on.
      ASSERT_LT(k + 1, at.size());
      const auto [next_begin, next_end] = curvatures(at[k], at[k + 1]);
      EXPECT_NEAR(end, next_begin, 1e-5);
      EXPECT_NEAR(at[k].w, at[k].v * (end + next_begin) / 2, 1e-9);
      EXPECT_LE(at[k].v, route[k].cruise + 1e-12);
      ++passed;
    }
  }
  EXPECT_GT(passed, 100);
  EXPECT_GT(slowed, 100);
  EXPECT_GT(by_turn_rate, 10);
}

TEST(Proc, ATurnTakesItsAngleByItsMeanRate) {
  EXPECT_NEAR(time_of_turn(1.6, 1.5), 2, 1e-12);
  EXPECT_NEAR(time_of_turn(-0.8, 0.5), 3, 1e-12);
}

// --- legs -----------------------------------------------------------------------------------------------------

PlanPoint to(double x, double y, double phi, double cruise, double v = 0, std::int32_t index = 7) {
  return {.at = {{x, y, phi}, v, 0}, .cruise = cruise, .index = index};
}

// One metre at 0.5 m/s with ramps at 0.6 m/s^2: 2.833 s, in whole iterations of 0.02 s.
TEST(Legs, TakeTheTimeOfTheirRampsAndOfTheirCruise) {
  const auto time = [](const PathPoint& from, const PlanPoint& goal) {
    const Leg leg = plan_leg(from, goal, {});
    EXPECT_TRUE(leg.found);
    EXPECT_EQ(leg.trajectory.index, 7);
    return leg.trajectory.duration;
  };
  EXPECT_NEAR(time({}, to(1, 0, 0, 0.5)), 2.84, 1e-9);
  EXPECT_NEAR(time({}, to(0.15, 0, 0, 0.5)), 1.0, 1e-9) << "too short for the cruise: up to 0.3 m/s";
  EXPECT_NEAR(time({{}, 0.5, 0}, to(1, 0, 0, 0.5, 0.5)), 2.0, 1e-9) << "no ramps";
  // 0.3 to 0.5 and down to 0.4 m/s: 0.5 s of ramps over 0.2083 m.
  EXPECT_NEAR(time({{}, 0.3, 0}, to(1, 0, 0, 0.5, 0.4)), 2.1, 1e-9);
}

TEST(Legs, OfACurveAreAsLongAsItsArc) {
  // A quarter of a circle of 1 m: pi/2 at 0.5 m/s is pi seconds.
  const Leg leg = plan_leg({{}, 0.5, 0.5}, {.at = {{1, 1, pi / 2}, 0.5, 0.5}, .cruise = 0.5}, {});
  ASSERT_TRUE(leg.found);
  EXPECT_NEAR(leg.trajectory.duration, 3.16, 1e-9);
}

TEST(Legs, OfATurnOnTheSpotHaveTheLeastJerk) {
  const PathPoint from{{2, 3, 0.5}, 0.019, 0};
  const Leg leg = plan_leg(from, to(9, 9, -0.3, 0), {});
  ASSERT_TRUE(leg.found);
  const Trajectory& t = leg.trajectory;
  EXPECT_EQ(t.index, 7);
  EXPECT_NEAR(t.duration, 1.0, 1e-9) << "0.8 rad at 1.5 rad/s";
  for (std::size_t n = 0; n < kFragmentKnots; ++n) {
    const double s = static_cast<double>(n) / (kFragmentKnots - 1);
    EXPECT_EQ(t.knot[n].p.x, 2);
    EXPECT_EQ(t.knot[n].p.y, 3);
    EXPECT_NEAR(t.knot[n].p.phi, 0.5 - 0.8 * (10 * s * s * s - 15 * s * s * s * s + 6 * s * s * s * s * s),
                1e-12);
    EXPECT_NEAR(t.knot[n].w, -0.8 * (30 * s * s - 60 * s * s * s + 30 * s * s * s * s), 1e-12);
    EXPECT_EQ(t.knot[n].v, 0);
  }
  EXPECT_EQ(t.knot.back().p.phi, -0.3);
  EXPECT_FALSE(plan_leg({{2, 3, 0.5}, 0.021, 0}, to(2, 3, -0.3, 0), {}).found) << "not at rest";
  EXPECT_FALSE(plan_leg({{2, 3, 0.5}, -0.021, 0}, to(2, 3, -0.3, 0), {}).found);
  EXPECT_NEAR(plan_leg({}, to(0, 0, 0, 0), {}).trajectory.duration, kPlatformPeriod, 1e-12) << "one at least";
}

// Limits hold for curves to either side, and are reached in some.
TEST(Legs, ToTheRightAreThoseToTheLeftInAMirror) {
  std::mt19937 random(8);
  std::uniform_real_distribution<> any(0, 1);
  PlannerParameters k;
  k.path = {.speed = 1.1, .turn_rate = 0.9, .lateral = 0.6};
  int found = 0, slower = 0, limited = 0;
  for (int run = 0; run < 200; ++run) {
    const double phi = 0.1 + 1.2 * any(random), r = 0.5 + any(random);
    const double v0 = any(random), v1 = any(random);
    const PlanPoint left{.at = {{r * std::sin(phi), r * (1 - std::cos(phi)), phi}, v1, v1 / r}, .cruise = 1};
    PlanPoint right = left;
    right.at.p.y *= -1;
    right.at.p.phi *= -1;
    right.at.w *= -1;
    const Leg a = plan_leg({{}, v0, v0 / r}, left, k), b = plan_leg({{}, v0, -v0 / r}, right, k);
    ASSERT_EQ(a.found, b.found) << run;
    if (!a.found) continue;
    ++found;
    ASSERT_EQ(a.trajectory.duration, b.trajectory.duration) << run;
    slower += std::abs(a.trajectory.knot.back().v - v1) > 1e-3;
    for (std::size_t n = 0; n < kFragmentKnots; ++n) {
      const PathPoint &p = a.trajectory.knot[n], &q = b.trajectory.knot[n];
      EXPECT_NEAR(p.p.x, q.p.x, 1e-6);
      EXPECT_NEAR(p.p.y, -q.p.y, 1e-6);
      EXPECT_NEAR(p.v, q.v, 1e-6);
      EXPECT_NEAR(p.w, -q.w, 1e-6);
      EXPECT_LE(std::abs(q.v * q.w), 0.6 + 1e-9);
      EXPECT_LE(std::abs(q.w), 0.9 + 1e-9);
      limited += std::abs(q.v * q.w) > 0.5;
    }
  }
  EXPECT_GT(found, 50);
  EXPECT_GT(slower, 10);
  EXPECT_GT(limited, 10);
}

TEST(Legs, ThatAreLongerThanAFragmentAreNotFound) {
  EXPECT_FALSE(plan_leg({}, to(20, 0, 0, 0.5), {}).found);
  const double most = 0.5 * (kLongest - 0.5 / 0.6);
  EXPECT_TRUE(plan_leg({}, to(most - 0.01, 0, 0, 0.5), {}).found);
  EXPECT_FALSE(plan_leg({}, to(most + 0.02, 0, 0, 0.5), {}).found);
}

// --- the planner's structure ----------------------------------------------------------------------------------

TEST(Trajgen, GoesFromIdleToBusyToReadyAndBack) {
  Trajgen g;
  g.k.planning = 3;
  g = trajgen_init(g, {{1, 2, 0}, 0, 0});
  EXPECT_EQ(g.k.planning, 3);
  EXPECT_EQ(g.at.p.y, 2);
  EXPECT_FALSE(g.busy || g.failed);
  EXPECT_EQ(trajgen_get_stat(g).elapsed, 0) << "idle";
  g = trajgen_start(g, to(2, 2, 0, 0.5));
  EXPECT_TRUE(g.busy);
  EXPECT_FALSE(g.failed);
  EXPECT_EQ(g.k.planning, 3);
  EXPECT_NEAR(g.at.p.x, 2, 1e-6) << "where the next one begins";
  for (int k = 0; k < 3; ++k) {
    EXPECT_FALSE(trajgen_is_ready(g)) << k;
    g = trajgen_get_stat(g);
    EXPECT_EQ(g.elapsed, k + 1);
  }
  EXPECT_TRUE(trajgen_is_ready(g));
  EXPECT_EQ(trajgen_get_traj(g).index, 7);
  const Trajgen stopped = trajgen_stop(g);
  EXPECT_FALSE(stopped.busy || trajgen_is_ready(stopped));
  EXPECT_EQ(stopped.elapsed, 0);
  EXPECT_NEAR(stopped.at.p.x, 2, 1e-6);
  EXPECT_EQ(stopped.k.planning, 3);
}

TEST(Trajgen, ThatFindsNothingFailsAndIsNeverReady) {
  Trajgen g = trajgen_start(trajgen_init({}, {{1, 2, 0}, 0, 0}), to(99, 2, 0, 0.5));
  EXPECT_TRUE(g.failed);
  EXPECT_FALSE(g.busy);
  EXPECT_EQ(g.at.p.x, 1);
  for (int k = 0; k < 20; ++k) {
    EXPECT_FALSE(trajgen_is_ready(g));
    g = trajgen_get_stat(g);
  }
  EXPECT_EQ(g.elapsed, 0);
}

TEST(Trajgen, AFragmentNotifiesItsLeadBeforeItsEnd) {
  Trajectory t;
  t.duration = 2;
  EXPECT_EQ(traj_to_steps(t), 100);
  EXPECT_EQ(traj_to_notify(t, 1.08), 46);
  EXPECT_EQ(traj_to_notify(t, 0), 99);
  EXPECT_EQ(traj_to_notify(t, 0.02), 99);
  EXPECT_EQ(traj_to_notify(t, 0.04), 98);
  EXPECT_EQ(traj_to_notify(t, 2), 0);
  EXPECT_EQ(traj_to_notify(t, 3), -50) << "before its beginning";
}

}  // namespace
}  // namespace mrroc::rex_drive
