// Boxes that platforms push: dry friction below them, contacts at their sides, and what is told of them.
#include "sim/platform/simulated_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

using test::drive;
using test::ideal_platform;
using test::ideal_world;

constexpr double kGravity = 9.81;
constexpr double kH = 0.001;

BoxParameters a_box() { return {.name = "crate"}; }

/// A box whose side is half a centimetre before the platform that stands at the origin.
BoxParameters box_before_platform() {
  BoxParameters box = a_box();
  box.start.x = ideal_platform().body.length / 2 + 0.005 + box.length / 2;
  return box;
}

PlatformWorldParameters world_with(const BoxParameters& box) {
  PlatformWorldParameters p = ideal_world();
  p.boxes = {box};
  return p;
}

/// Two platforms side by side before it.
PlatformWorldParameters world_of_two(const BoxParameters& box) {
  PlatformWorldParameters p = world_with(box);
  p.platforms.assign(2, ideal_platform());
  p.platforms[0].start.y = 0.36;
  p.platforms[1].start.y = -0.36;
  return p;
}

void drive_all(PlatformWorld& world, const std::vector<double>& torque, int steps) {
  std::vector<PlatformDrive> drives;
  for (const double t : torque) drives.push_back(drive({t, t, t, t}));
  for (int k = 0; k < steps; ++k) world.step(drives);
}

TEST(SlidingBase, RubsWithItsWeightAgainstTheMotion) {
  const BoxParameters box = a_box();
  const PlanarForce f = SlidingBase(box).friction({.phi = 0.7, .vx = 0.3, .vy = 0.4}, {}, 0, kH);
  const double most = box.friction * box.mass * kGravity;
  EXPECT_NEAR(f.x, -0.6 * most, 1e-9);
  EXPECT_NEAR(f.y, -0.8 * most, 1e-9);
  EXPECT_NEAR(f.moment, 0, 1e-9);
}

TEST(SlidingBase, OfALongBoxTurnsAgainstAQuarterOfItsLength) {
  BoxParameters rod = a_box();
  rod.length = 2;
  rod.width = 0.01;
  const PlanarForce f = SlidingBase(rod).friction({.phi = 1, .w = 2}, {}, 0, kH);
  EXPECT_NEAR(f.moment, -rod.friction * rod.mass * kGravity * rod.length / 4, 0.01);
  EXPECT_NEAR(std::hypot(f.x, f.y), 0, 1e-9);
}

TEST(SlidingBase, HoldsWithNoMoreThanWhatBringsItToRest) {
  const BoxParameters box = a_box();
  const SlidingBase base(box);
  const PlanarForce f = base.friction({.vx = 1e-3, .vy = -5e-4, .w = 1e-3}, {}, 0, kH);
  EXPECT_NEAR(f.x, -1e-3 * box.mass / kH, 1e-9);
  EXPECT_NEAR(f.y, 5e-4 * box.mass / kH, 1e-9);
  EXPECT_NEAR(f.moment, -1e-3 * base.inertia() / kH, 1e-9);
  const PlanarForce none = base.friction({}, {}, 0, kH);
  EXPECT_EQ(none.x, 0);
  EXPECT_EQ(none.moment, 0);
}

TEST(SlidingBase, TurnsAPushedBoxOnIceOfOneSide) {
  GroundParameters ground;
  ground.patches.push_back({.lower = {-5, -5}, .upper = {5, 0}, .scale = 0.1});
  const PlanarForce f = SlidingBase(a_box()).friction({.vx = 0.2}, ground, 0, kH);
  EXPECT_GT(f.moment, 20) << "the side where y > 0 is held back";
}

double energy(const BoxParameters& box, double inertia, double vx, double vy, double w) {
  return 0.5 * (box.mass * (vx * vx + vy * vy) + inertia * w * w);
}

TEST(SlidingBase, TakesEnergyOutAndIsNeverMoreThanItsWeightAllows) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int k = 0; k < 20'000; ++k) {
    BoxParameters box = a_box();
    box.length = between(0.1, 2);
    box.width = between(0.1, 2);
    box.mass = between(1, 500);
    box.friction = between(0, 1.5);
    GroundParameters ground;
    ground.patches.push_back({.lower = {-5, -5}, .upper = {5, between(-1, 1)}, .scale = between(0.01, 2)});
    const double h = between(1e-4, 0.01), size = std::pow(10, between(-6, 1));
    const PlanarState s{.x = between(-1, 1),
                        .y = between(-1, 1),
                        .phi = between(-3, 3),
                        .vx = between(-size, size),
                        .vy = between(-size, size),
                        .w = between(-size, size)};
    const SlidingBase base(box);
    const PlanarForce f = base.friction(s, ground, 0, h);
    // Coulomb: no more than the weight times the largest coefficient, in any direction, and about the middle.
    const double most = box.friction * box.mass * kGravity * std::max(1.0, ground.patches[0].scale);
    ASSERT_LE(std::hypot(f.x, f.y), most * (1 + 1e-9)) << k;
    ASSERT_LE(std::abs(f.moment), most * std::hypot(box.length, box.width) / 2 * (1 + 1e-9)) << k;
    const double inertia = base.inertia();
    const double after = energy(box, inertia, s.vx + h * f.x / box.mass, s.vy + h * f.y / box.mass,
                                s.w + h * f.moment / inertia);
    ASSERT_LE(after, energy(box, inertia, s.vx, s.vy, s.w) * (1 + 1e-9)) << k;
  }
}

TEST(SlidingBase, BringsToRestAndKeepsThere) {
  BoxParameters box = a_box();
  box.friction = 1;
  const SlidingBase base(box);
  PlanarState s{.phi = 0.4, .vx = 0.3, .vy = -0.2, .w = 1};
  for (int n = 0; n < 200; ++n) {
    const PlanarForce f = base.friction(s, {}, 0, kH);
    s.vx += kH * f.x / box.mass;
    s.vy += kH * f.y / box.mass;
    s.w += kH * f.moment / base.inertia();
  }
  EXPECT_NEAR(std::hypot(s.vx, s.vy), 0, 1e-12);
  EXPECT_NEAR(s.w, 0, 1e-12);
}

TEST(SimulatedBox, StandsAgainstAPushThatIsLessThanItsFriction) {
  const PlatformWorldParameters p = world_with(box_before_platform());
  PlatformWorld world(p);
  drive_all(world, {6}, 500);  // 6 N m at four wheels are 160 N, its friction is 294 N
  const double hit = world.box_truth(0).p.x;
  EXPECT_NEAR(hit, p.boxes[0].start.x, 0.005) << "the blow of the contact";
  EXPECT_NEAR(world.box_truth(0).push[0], 160, 2);
  drive_all(world, {6}, 2500);
  EXPECT_NEAR(world.box_truth(0).p.x, hit, 1e-6) << "it does not creep";
}

TEST(SimulatedBox, IsTooHeavyForOnePlatformAndNotForTwo) {
  const BoxParameters box = box_before_platform();
  PlatformWorld one(world_with(box));
  drive_all(one, {20}, 500);
  const double hit = one.box_truth(0).p.x;
  EXPECT_NEAR(hit, box.start.x, 0.03) << "the blow of the contact";
  drive_all(one, {20}, 1000);
  EXPECT_NEAR(one.box_truth(0).p.x, hit, 1e-4) << "its wheels spin";
  PlatformWorld two(world_of_two(box));
  drive_all(two, {9, 9}, 1500);
  EXPECT_GT(two.box_truth(0).p.x, box.start.x + 0.5);
  EXPECT_NEAR(two.box_truth(0).p.y, 0, 0.02);
  EXPECT_NEAR(two.box_truth(0).p.phi, 0, 0.02);
}

TEST(SimulatedBox, OnePlatformAtItsEndTurnsItAboutAndDoesNotBringItAway) {
  BoxParameters box = box_before_platform();
  box.start.y = -0.54;  // the platform is where it is as one of two that push
  PlatformWorld world(world_with(box));
  for (int second = 0; second < 10; ++second) {
    drive_all(world, {20}, 500);
    EXPECT_LT(world.box_truth(0).p.x, box.start.x + 0.6) << "its middle goes round";
    if (second == 3) {
      EXPECT_LT(world.box_truth(0).p.phi, -1);
    }
  }
}

TEST(SimulatedBox, TurnsToTheSideThatIsPushedLess) {
  BoxParameters box = box_before_platform();
  PlatformWorld world(world_of_two(box));
  drive_all(world, {12, 5}, 1000);  // the first one pushes where y > 0
  EXPECT_LT(world.box_truth(0).p.phi, -0.03);
}

TEST(SimulatedBox, ComesToRestAsSoonAsNobodyPushes) {
  PlatformWorld world(world_of_two(box_before_platform()));
  drive_all(world, {10, 10}, 600);
  ASSERT_GT(world.box_truth(0).speed[0], 0.1);
  for (int k = 0; k < 1000; ++k) world.step({});
  EXPECT_EQ(std::hypot(world.box_truth(0).speed[0], world.box_truth(0).speed[1]), 0);
  EXPECT_EQ(world.box_truth(0).push[0], 0)
      << "the platforms are heavier than what their brakes hold them with";
}

TEST(SimulatedBox, IsSeenByMotionCaptureAsPlatformsAre) {
  PlatformWorldParameters p = world_with(a_box());
  p.boxes[0].start = {.x = 5, .y = 2, .phi = 1};
  p.motion_capture.setup = {.period = 30, .latency = 10};
  p.motion_capture.noise = {0.005, 0.01};
  PlatformWorld world(p);
  int readings = 0;
  for (int step = 1; step <= 300; ++step) {
    world.step({});
    const auto& captured = world.box_motion_capture(0);
    EXPECT_EQ(captured.has_value(), step % 30 == 10);
    if (!captured) continue;
    ++readings;
    EXPECT_EQ(captured->reading.step, step - 10);
    EXPECT_TRUE(captured->reading.seen);
    EXPECT_NEAR(captured->reading.p.x, 5, 0.025);
    EXPECT_NE(captured->reading.p.x, 5);
    EXPECT_NEAR(captured->reading.p.phi, 1, 0.05);
  }
  EXPECT_EQ(readings, 10);
}

TEST(SimulatedBox, DoesNotChangeTheNoiseOfPlatforms) {
  PlatformWorldParameters p = ideal_world();
  p.platforms[0].imu = {};
  PlatformWorld without(p, 4);
  p.boxes = {a_box()};
  p.boxes[0].start.x = 10;
  PlatformWorld with(p, 4);
  for (int step = 0; step < 50; ++step) {
    drive_all(without, {5}, 1);
    drive_all(with, {5}, 1);
    ASSERT_EQ(with.reading(0).yaw_rate, without.reading(0).yaw_rate);
  }
  EXPECT_NE(with.state_hash(), without.state_hash()) << "its state counts";
}

TEST(SimulatedBox, EqualSeedsGiveEqualBits) {
  PlatformWorld one(world_of_two(box_before_platform()), 3), other(world_of_two(box_before_platform()), 3);
  for (int step = 0; step < 500; ++step) {
    drive_all(one, {12, 8}, 1);
    drive_all(other, {12, 8}, 1);
    ASSERT_EQ(one.state_hash(), other.state_hash());
  }
}

}  // namespace
}  // namespace mrroc::sim
