// The plant's wheels against what can be computed by hand.
#include "sim/platform/skid_steer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>

#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

using test::drive;
using test::ideal_platform;
using test::ideal_world;
using test::run;
using test::turning;

constexpr double kGravity = 9.81;

double sum(const PerWheel& p) { return std::accumulate(p.begin(), p.end(), 0.0); }

/// Kinetic energy of body and wheels [J]; the centre of mass is B.
double energy(const PlatformTruth& t) {
  const auto& b = ideal_platform().body;
  double e = b.mass * (t.v.vx * t.v.vx + t.v.vy * t.v.vy) / 2 + b.inertia * t.v.w * t.v.w / 2;
  for (const double speed : t.wheel_speed) e += b.wheel_inertia * speed * speed / 2;
  return e;
}

/// Mass and bearings are all that four rolling wheels drive: a first-order lag.
TEST(SkidSteer, DrivesStraightAsItsMassAndBearingsLetIt) {
  const auto& b = ideal_platform().body;
  constexpr double kTorque = 3;
  const double mass = b.mass + 4 * b.wheel_inertia / (b.wheel_radius * b.wheel_radius);
  const double lag = mass * b.wheel_radius * b.wheel_radius / (4 * b.bearing_friction);
  const double last = kTorque / b.bearing_friction * b.wheel_radius;
  PlatformWorld world(ideal_world());
  for (double t = 0.5; t < 3; t += 0.5) {
    run(world, drive({kTorque, kTorque, kTorque, kTorque}), 0.5);
    EXPECT_NEAR(world.truth(0).v.vx, last * (1 - std::exp(-t / lag)), 0.01 * last) << t;
    EXPECT_NEAR(world.truth(0).v.vy, 0, 1e-9);
    EXPECT_NEAR(world.truth(0).v.w, 0, 1e-9);
  }
}

/// Slip of a platform that turns on the spot is across the wheels by a and along them by b, so friction holds it up to
/// r mu N a / sqrt(a^2 + b^2).
TEST(SkidSteer, TurnsOnTheSpotAboveTheThresholdOnly) {
  const auto& b = ideal_platform().body;
  const double a = b.half_wheelbase;
  const double threshold = b.wheel_radius * 0.7 * b.mass * kGravity / 4 * a / std::hypot(a, b.half_track);
  EXPECT_NEAR(threshold, 6.6, 0.05);
  for (const auto& [share, least, most] :
       {std::array{0.8, 0.0, 0.06}, std::array{0.95, 0.0, 0.15}, std::array{1.2, 0.5, 20.0}}) {
    PlatformWorld world(ideal_world());
    run(world, drive(turning(share * threshold)), 2);
    EXPECT_GE(world.truth(0).v.w, least) << share;
    EXPECT_LE(world.truth(0).v.w, most) << share;
    EXPECT_NEAR(world.truth(0).p.x, 0, 1e-6);
    EXPECT_NEAR(world.truth(0).p.y, 0, 1e-6);
  }
}

/// The wheels hold the body back by mu_x N each, however fast they spin.
TEST(SkidSteer, AcceleratesNoFasterThanFriction) {
  PlatformWorldParameters p = ideal_world();
  p.ground.friction.mu_x = 0.2;
  PlatformWorld world(p);
  run(world, drive({20, 20, 20, 20}), 0.5);
  EXPECT_NEAR(world.truth(0).v.vx, 0.2 * kGravity * 0.5, 0.02);
  for (const double speed : world.truth(0).wheel_speed) EXPECT_GT(0.15 * speed, 1.2 * world.truth(0).v.vx);
}

TEST(SkidSteer, DrivesFastWheelsWithLessTorque) {
  PlatformWorldParameters p = ideal_world();
  p.ground.friction = {.mu_x = 0.02, .mu_y = 0.02};
  PlatformWorld world(p);
  run(world, drive({20, 20, 20, 20}), 3);
  const auto& b = p.platforms[0].body;
  for (const double speed : world.truth(0).wheel_speed) {
    EXPECT_GT(speed, b.full_torque_speed);
    EXPECT_LT(speed, b.no_torque_speed);
  }
}

TEST(SkidSteer, NeverGivesMoreEnergyThanTheMotorsDo) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> torque(-20, 20);
  for (int run = 0; run < 20; ++run) {
    PlatformWorldParameters p = ideal_world();
    p.ground.model = run % 2 == 0 ? GroundModel::sharp : GroundModel::smooth;
    PlatformWorld world(p);
    double given = 0;
    for (int step = 0; step < 500; ++step) {
      PlatformDrive d = drive({torque(random), torque(random), torque(random), torque(random)});
      d.enabled = step < 400;
      for (int k = 0; k < 10; ++k) {
        const PerWheel before = world.truth(0).wheel_speed;
        world.step({&d, 1});
        const PlatformTruth& t = world.truth(0);
        for (std::size_t i = 0; i < kWheels; ++i)
          given += t.torque[i] * (before[i] + t.wheel_speed[i]) / 2 * kPlatformStep;
      }
      ASSERT_LT(energy(world.truth(0)), given + 1) << run << ' ' << step;
    }
  }
}

/// Short-circuited motors brake what the platform has, to rest.
TEST(SkidSteer, ComesToRestWithoutADrive) {
  PlatformWorld world(ideal_world());
  while (world.truth(0).v.vx < 0.8) run(world, drive({8, 8, 8, 8}), kPlatformStep);
  const double from = world.truth(0).p.x;
  double last = energy(world.truth(0));
  for (int step = 0; step < 600; ++step) {
    world.step({});
    const double now = energy(world.truth(0));
    ASSERT_LE(now, last * (1 + 1e-9)) << step;
    last = now;
  }
  EXPECT_LT(std::abs(world.truth(0).v.vx), 1e-3);
  EXPECT_LT(world.truth(0).p.x - from, 0.2);
}

PlatformTruth after_a_wild_ride(int micro_steps) {
  PlatformWorldParameters p = ideal_world();
  p.micro_steps = micro_steps;
  p.platforms[0].centre = {0.04, 0.01};
  p.platforms[0].motor_lag = 0.004;
  PlatformWorld world(p);
  for (const PerWheel& torque : {PerWheel{8, 8, 8, 8}, PerWheel{2, 14, 2, 14}, PerWheel{-10, 12, -10, 12},
                                 PerWheel{5, -3, 5, -3}, PerWheel{-8, -8, -8, -8}})
    run(world, drive(torque), 0.4);
  return world.truth(0);
}

TEST(SkidSteer, MicroStepsOfATenthOfAMillisecondAreShortEnough) {
  const PlatformTruth usual = after_a_wild_ride(10), fine = after_a_wild_ride(80);
  EXPECT_NEAR(usual.p.x, fine.p.x, 2e-3);
  EXPECT_NEAR(usual.p.y, fine.p.y, 2e-3);
  EXPECT_NEAR(usual.p.phi, fine.p.phi, 5e-3);
  EXPECT_NEAR(usual.v.vx, fine.v.vx, 5e-3);
  EXPECT_NEAR(usual.v.w, fine.v.w, 1e-2);
}

TEST(SkidSteer, LoadsAreTheWeightAndShiftWithAcceleration) {
  PlatformWorldParameters p = ideal_world();
  const double weight = p.platforms[0].body.mass * kGravity;
  p.platforms[0].centre = {0.05, -0.03};
  PlatformWorld world(p);
  const PerWheel still = world.reading(0).load;
  EXPECT_NEAR(sum(still), weight, 1e-9);
  EXPECT_NEAR((still[0] + still[1] - still[2] - still[3]) * 0.25 / weight, 0.05, 1e-12);
  EXPECT_NEAR((still[0] - still[1] + still[2] - still[3]) * 0.30 / weight, -0.03, 1e-12);
  run(world, drive({10, 10, 10, 10}), 0.2);
  const PerWheel fast = world.reading(0).load;
  EXPECT_NEAR(sum(fast), weight, 1e-9);
  EXPECT_LT(fast[0] + fast[1], still[0] + still[1] - 10) << "the front is lifted";

  p.ground.model = GroundModel::smooth;
  PlatformWorld smooth(p);
  run(smooth, drive({10, 10, 10, 10}), 0.2);
  EXPECT_EQ(smooth.reading(0).load, still);
}

TEST(SkidSteer, SmoothFrictionIsThatOfTheKernel) {
  const PlatformParameters k = ideal_platform();
  GroundParameters ground;
  ground.model = GroundModel::smooth;
  const PlanarState sliding{.x = 0, .y = 0, .phi = 0, .vx = 0.03, .vy = -0.02, .w = 0};
  SkidSteer wheels(k, ground, 1);
  std::array<Friction, kWheels> friction;
  friction.fill({.mu_x = 0.7, .mu_y = 0.5});
  const PlanarForce f = wheels.step(sliding, {}, friction, 1e-9, 1);
  const double n = std::sqrt(0.03 * 0.03 + 0.02 * 0.02 + k.body.slip_speed * k.body.slip_speed);
  EXPECT_NEAR(f.x, -0.7 * k.body.mass * kGravity * 0.03 / n, 1e-9);
  EXPECT_NEAR(f.y, 0.5 * k.body.mass * kGravity * 0.02 / n, 1e-9);
}

TEST(SkidSteer, DrivesLagAndRipple) {
  PlatformWorldParameters p = ideal_world();
  p.platforms[0].motor_lag = 0.02;
  PlatformWorld lagging(p);
  run(lagging, drive({5, 5, 5, 5}), 0.02);
  for (const double torque : lagging.truth(0).torque) EXPECT_NEAR(torque, 5 * (1 - std::exp(-1)), 0.02);

  p.platforms[0].motor_lag = 0;
  p.platforms[0].ripple = 0.01;
  PlatformWorld rippling(p);
  double least = 5, most = 5;
  for (int step = 0; step < 1000; ++step) {
    run(rippling, drive({5, 5, 5, 5}), kPlatformStep);
    least = std::min(least, rippling.truth(0).torque[0]);
    most = std::max(most, rippling.truth(0).torque[0]);
  }
  EXPECT_NEAR(least, 4.95, 0.003);
  EXPECT_NEAR(most, 5.05, 0.003);
}

TEST(SkidSteer, BlockedWheelSlides) {
  PlatformWorldParameters p = ideal_world();
  p.platforms[0].faults.wheel = 2;
  p.platforms[0].faults.wheel_blocked = {.from = 100, .to = 200};
  PlatformWorld world(p);
  for (int step = 1; step <= 300; ++step) {
    const PlatformDrive d = drive({3, 3, 3, 3});
    world.step({&d, 1});
    const bool blocked = world.truth(0).wheel_speed[2] == 0;
    EXPECT_EQ(blocked, step >= 100 && step < 200) << step;
    EXPECT_NE(world.truth(0).wheel_speed[0], 0) << step;
  }
}

}  // namespace
}  // namespace mrroc::sim
