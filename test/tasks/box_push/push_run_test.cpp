// A push, stretch by stretch, against a box that lags and slips.
#include "tasks/box_push/push_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "test/tasks/box_push/halls.hpp"

namespace mrroc::box_push {
namespace {

constexpr PushSpeeds kSpeeds;

/// Pushes a box that is always at that place in front of the pair. @return where the box is in the end
PlanarPose push_to(const PlanarPose& goal, const PlanarPose& slip, PushRun& run) {
  const Hall hall = a_hall();
  const Formation& f = hall.formation;
  run = begin_push({Side::back, goal}, pair_at(f, Side::back, f.gap), f);
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  const PlanarPose held = chained(inverse(pair_at(f, Side::back, -0.02)), slip);
  constexpr double kQueued = 75;  // iterations that the pair is behind what it has been told
  for (int n = 0; n < 400; ++n) {
    run = with_next_stretch(run, hall, kSpeeds);
    for (int reading = 0; reading < 5; ++reading) {
      PlanarPose box = chained(told_before_end(run, kQueued - 5 * reading), held);
      box.x += 0.005 * noise(random);
      box.y += 0.005 * noise(random);
      box.phi += 0.01 * noise(random);
      run = with_reading(run, box, kQueued - 5 * reading, f);
    }
    if (end_of(run).v == 0) break;
  }
  return chained(end_of(run).p, held);
}

TEST(PushRun, BringsTheBoxToItsTarget) {
  for (const PlanarPose& goal : {PlanarPose{1, 0, 0}, {1.9, 0.8, 0.44}, {2, -0.25, -0.2}, {1.1, 0, 0}})
    for (const PlanarPose& slip : {PlanarPose{}, {0.01, 0.02, 0.02}, {-0.01, -0.03, -0.01}}) {
      PushRun run;
      const PlanarPose error = seen_from(goal, push_to(goal, slip, run));
      EXPECT_NEAR(error.x, 0, 0.015) << goal.x << ' ' << slip.y;
      EXPECT_NEAR(error.y, 0, 0.02) << goal.x << ' ' << slip.y;
      EXPECT_NEAR(error.phi, 0, 0.05) << goal.x << ' ' << slip.y;
    }
}

TEST(PushRun, JoinsItsStretchesWithinTheSpeeds) {
  PushRun run;
  std::ignore = push_to({1.9, 0.8, 0.52}, {}, run);
  PathPoint before{run.begin};
  double way = 0;
  for (const Stretch& s : run.stretches) {
    EXPECT_NEAR(distance(s.from, before.p), 0, 1e-12);
    EXPECT_NEAR(s.speed, before.v, 1e-12);
    EXPECT_LE(s.end_speed, kSpeeds.pushing);
    if (s.end_speed > 0) {
      EXPECT_LE(std::abs(s.end_speed - s.speed), kSpeeds.acceleration * s.steps * kPlatformPeriod + 1e-12);
    }
    if (way < a_hall().formation.gap) {
      EXPECT_LE(s.end_speed, kSpeeds.closing) << "it does not hit the box";
    }
    before = point_of(s, 1);
    way += distance(s.from, before.p);
  }
  EXPECT_EQ(before.v, 0);
}

TEST(PushRun, LearnsNothingBeforeBothPlatformsPush) {
  const Formation f;
  const PushRun run = begin_push({Side::back, {1, 0, 0}}, pair_at(f, Side::back, f.gap), f);
  const PushRun after = with_reading(run, {0, 0.3, 0.2}, 0, f);
  EXPECT_EQ(after.box.y, run.box.y);
  EXPECT_EQ(after.box.phi, run.box.phi);
}

TEST(PushRun, AnOutlierMovesTheBoxByNothingAndOneThatStaysIsABoxThatStaysBehind) {
  const Formation f;
  PushRun run = begin_push({Side::back, {3, 0, 0}}, pair_at(f, Side::back, f.gap), f);
  for (int n = 0; n < 20; ++n) run = with_next_stretch(run, a_hall(), kSpeeds);
  const PlanarPose with_pair = chained(end_of(run).p, inverse(pair_at(f, Side::back, 0)));
  run = with_reading(run, with_pair, 0, f);
  const PlanarPose before = run.box;
  for (const auto& [x, y] : {std::pair(-0.5, 0.), {0., 0.5}, {0., -0.5}}) {
    const PushRun after = with_reading(run, {with_pair.x + x, with_pair.y + y, with_pair.phi}, 0, f);
    EXPECT_EQ(after.box.x, before.x);
    EXPECT_EQ(after.box.y, before.y);
    EXPECT_FALSE(stays_behind(after));
  }
  for (int n = 0; n < 3; ++n) run = with_reading(run, {with_pair.x - 0.5, with_pair.y, with_pair.phi}, 0, f);
  EXPECT_TRUE(stays_behind(run)) << "it was left while nobody saw it";
}

TEST(PushRun, ABoxStaysBehindWhenItWasSeenSoSeveralTimesInSuccession) {
  const Formation f;
  PushRun run = begin_push({Side::back, {3, 0, 0}}, pair_at(f, Side::back, f.gap), f);
  for (int n = 0; n < 20; ++n) run = with_next_stretch(run, a_hall(), kSpeeds);
  const auto seen = [&](double lag) {
    run = with_reading(run, chained(end_of(run).p, inverse(pair_at(f, Side::back, -lag))), 0, f);
    return stays_behind(run);
  };
  for (int n = 0; n < 10; ++n) EXPECT_FALSE(seen(0.8 * kMostLag)) << "it lags a little on any way";
  EXPECT_NEAR(run.lag, 0.8 * kMostLag, 1e-9);
  EXPECT_FALSE(seen(1.2 * kMostLag)) << "readings have outliers";
  EXPECT_FALSE(seen(0.01));
  EXPECT_FALSE(seen(1.2 * kMostLag));
  EXPECT_FALSE(seen(1.2 * kMostLag));
  EXPECT_TRUE(seen(1.2 * kMostLag));
}

TEST(PushRun, KnowsWhatThePairWasToldBefore) {
  PushRun run;
  std::ignore = push_to({1, 0, 0}, {}, run);
  int all = 0;
  for (const Stretch& s : run.stretches) all += s.steps;
  EXPECT_EQ(distance(told_before_end(run, 0), end_of(run).p), 0);
  EXPECT_NEAR(distance(told_before_end(run, all), run.begin), 0, 1e-12);
  EXPECT_EQ(distance(told_before_end(run, all + 100), run.begin), 0);
  const int last = run.stretches.back().steps;
  EXPECT_NEAR(distance(told_before_end(run, last), run.stretches.back().from), 0, 1e-12);
}

}  // namespace
}  // namespace mrroc::box_push
