// Model predictive control of Rex in closed loops with a plant of another structure, its state known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "edp/platform/follower.hpp"
#include "robots/rex/nmpc.hpp"
#include "robots/rex/rex.hpp"
#include "robots/rex/wheels.hpp"
#include "test/robots/rex/course.hpp"

namespace mrroc::rex::test {
namespace {

constexpr double kSlowLap = 20.4;
constexpr double kFastLap = 13.6;

Tracked tracked(const Course& course, const Loop& loop = {}) {
  Nmpc nmpc;
  Tracked t = track(nmpc, course, loop);
  EXPECT_EQ(t.failures, 0);
  EXPECT_LE(t.largest_torque, kMaxTorque);
  return t;
}

Truth with_friction(const Slip& friction) {
  Truth truth = another_structure();
  truth.friction = friction;
  return truth;
}

TEST(Nmpc, FollowsAFigureEight) {
  const Tracked t = tracked(figure_eight(kSlowLap));
  EXPECT_LT(t.rms, 0.008);
  EXPECT_LT(t.max, 0.030);
  EXPECT_LT(tracked(figure_eight(kFastLap)).rms, 0.012);
}

TEST(Nmpc, FollowsItWithinMillimetresWhereItKnowsThePlant) {
  EXPECT_LT(tracked(figure_eight(kSlowLap), {.truth = {}}).rms, 0.002);
}

TEST(Nmpc, FollowsItOnSlipperyGroundThatItKnows) {
  EXPECT_LT(tracked(figure_eight(kSlowLap), {with_friction({0.35, 0.3, 0}), {0.4, 0.37, 0}}).rms, 0.008);
}

TEST(Nmpc, FollowsItWithIceBelowTheRightWheelsThatItKnows) {
  const Loop loop{with_friction({0.525, 0.45, 1. / 3}), {0.57, 0.53, 1. / 3}};
  EXPECT_LT(tracked(figure_eight(kSlowLap), loop).rms, 0.010);
  // The other way round is far from it.
  EXPECT_GT(tracked(figure_eight(kSlowLap), {loop.truth, {0.57, 0.53, -1. / 3}}).rms, 0.015);
}

TEST(Nmpc, TakesACornerThatCannotBeTaken) {
  const Tracked t = tracked(corner(0.8));
  EXPECT_LT(t.rms, 0.030);
  EXPECT_LT(t.max, 0.100);
}

TEST(Nmpc, TurnsOnTheSpot) {
  const Tracked t = tracked(pivot());
  EXPECT_LT(t.rms, 0.008);
  EXPECT_LT(t.max, 0.020);
}

// Of a hundred such plants three do not find back; the others end within 64 mm.
TEST(Nmpc, RecoversOnRandomPlantsFromWhatFrictionDoesNotAllow) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 10; ++i) {
    Truth truth = another_structure();
    truth.mass = 40 * (1 + 0.15 * uniform(random));
    truth.centre_x = 0.06 * uniform(random);
    truth.centre_y = 0.06 * uniform(random);
    truth.friction = {0.625 + 0.375 * uniform(random), 0.6 + 0.35 * uniform(random), 0.3 * uniform(random)};
    Nmpc nmpc;
    const Tracked t = track(nmpc, i % 2 == 0 ? corner(1.2) : figure_eight(kFastLap), {.truth = truth});
    EXPECT_EQ(t.failures, 0) << i;
    EXPECT_LT(t.last, 0.07) << i;
  }
}

TEST(Nmpc, TorquesAreOnesThatTheDrivesCanGiveAtTheirSpeed) {
  Nmpc nmpc;
  Plant plant({});
  edp::EstimatorResult x = perfect(plant, {});
  x.estimate.v.vx = kMaxWheelSpeed * kWheelRadius;
  x.estimate.theta_dot.fill(kMaxWheelSpeed);
  nmpc.begin(x);
  const Course away{[](double t) { return PathPoint{{50 + 5 * t, 0, 0}, 5, 0}; }, 1};
  for (int i = 0; i < 20; ++i) {
    const auto r = nmpc.step(x, {}, standing_load(kMass, {}), horizon(away, 0));
    for (const double torque : r.torque) EXPECT_LT(torque, 0.01);
  }
}

// The solver has never been seen beyond its bounds; within_limit() takes away what it may pass them by.
TEST(Nmpc, TorquesAtTheLimitCanAllBeUsed) {
  edp::Follower follower(std::make_unique<Nmpc>(), platform().properties());
  Plant plant({});
  follower.begin(perfect(plant, {}));
  double largest = 0;
  for (int i = 0; i < 50; ++i) {
    // As far away as a reference may be, in front and behind.
    const PlanarPose p{plant.p().x + (i % 10 < 5 ? 5 : -5), plant.p().y, 0};
    const Course there{[p](double) { return PathPoint{p, 0, 0}; }, 1};
    EXPECT_FALSE(follower.step(perfect(plant, {}), {}, plant.load(), horizon(there, 0))) << i;
    for (const PerWheel& planned : follower.result().torques)
      for (const double torque : planned) {
        largest = std::max(largest, std::abs(torque));
        EXPECT_LE(std::abs(torque), kMaxTorque) << "to the last bit: " << i;
      }
    plant.step(follower.torque(), kPlatformPeriod);
  }
  EXPECT_EQ(follower.failures(), 0);
  EXPECT_GT(largest, 0.99 * kMaxTorque);
}

TEST(Nmpc, SpeedAtTheEndOfTheHorizonStaysNearItsLimit) {
  Nmpc nmpc;
  Plant plant({});
  const edp::EstimatorResult x = perfect(plant, {});
  nmpc.begin(x);
  const Course away{[](double t) { return PathPoint{{2.5 * t, 0, 0}, 2.5, 0}; }, 1};
  edp::TrackerResult r;
  for (int i = 0; i < 50; ++i) r = nmpc.step(x, {}, standing_load(kMass, {}), horizon(away, 0));
  const double fastest = (r.horizon[17].x - r.horizon[16].x) / 0.05;
  const double last = (r.horizon[20].x - r.horizon[19].x) / 0.05;
  EXPECT_GT(fastest, last + 0.1);
  EXPECT_LT(last, kMaxSpeed + 0.25);
}

TEST(Nmpc, ExpectsToBeWhereThePlantOfItsStructureGoes) {
  Nmpc nmpc;
  const Course course = figure_eight(kSlowLap);
  const Tracked t = track(nmpc, course, {.truth = {}});
  for (std::size_t i = 100; i + 50 < t.results.size(); i += 50) {
    const PlanarPose& expected = t.results[i].horizon[10];  // 0.5 s
    const PlanarPose& came = t.results[i + 25].horizon[0];
    EXPECT_LT(std::hypot(expected.x - came.x, expected.y - came.y), 0.01) << i;
  }
}

}  // namespace
}  // namespace mrroc::rex::test
