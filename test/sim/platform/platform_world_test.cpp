// Platforms in their room: walls, patches of the ground, frames, and the same bits again.
#include "sim/platform/platform_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "base/room_config.hpp"
#include "sim/platform/ground.hpp"
#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

using test::drive;
using test::ideal_platform;
using test::ideal_world;
using test::run;

/// A world as a run has it: noise, lag, ripple, furniture.
PlatformWorldParameters usual_world() {
  PlatformWorldParameters w;
  PlatformParameters p;
  p.body = ideal_platform().body;
  w.platforms = {p};
  w.room = built_in_room();
  w.motion_capture.outliers = 0.1;
  return w;
}

std::vector<std::uint64_t> hashes(PlatformWorld& world, std::uint64_t inputs) {
  std::mt19937_64 random(inputs);
  std::uniform_real_distribution<double> torque(-15, 15);
  std::vector<std::uint64_t> all;
  for (int macrostep = 0; macrostep < 100; ++macrostep) {
    const PlatformDrive d = drive({torque(random), torque(random), torque(random), torque(random)});
    run(world, d, 0.02);
    all.push_back(world.state_hash());
  }
  return all;
}

TEST(PlatformWorld, EqualSeedsGiveEqualBits) {
  PlatformWorld one(usual_world(), 5), other(usual_world(), 5);
  const auto first = hashes(one, 1);
  EXPECT_EQ(hashes(other, 1), first);
  PlatformWorld different(usual_world(), 6);
  EXPECT_NE(hashes(different, 1), first);
}

TEST(PlatformWorld, StartsAtRestWhereItIsTold) {
  PlatformWorldParameters p = usual_world();
  p.platforms[0].start = {.x = 1, .y = -0.5, .phi = 2};
  p.platforms[0].centre = {0.04, 0.02};
  const PlatformWorld world(p);
  EXPECT_EQ(world.steps(), 0);
  EXPECT_EQ(world.reading(0).step, 0);
  EXPECT_NEAR(world.truth(0).p.x, 1, 1e-12);
  EXPECT_NEAR(world.truth(0).p.y, -0.5, 1e-12);
  EXPECT_NEAR(world.truth(0).p.phi, 2, 1e-12);
  EXPECT_EQ(world.truth(0).v.vx, 0);
  EXPECT_EQ(world.truth(0).friction[3][1], 0.6);
}

/// Pose and velocity are those of B, wherever the centre of mass is.
TEST(PlatformWorld, VelocityIsTheDerivativeOfThePose) {
  PlatformWorldParameters p = ideal_world();
  p.platforms[0].centre = {0.1, -0.08};
  PlatformWorld world(p);
  run(world, drive({-6, 16, -6, 16}), 0.5);
  ASSERT_GT(world.truth(0).v.w, 0.5);
  for (int step = 0; step < 200; ++step) {
    const PlatformTruth before = world.truth(0);
    run(world, drive({-6, 16, -6, 16}), kPlatformStep);
    const PlatformTruth& now = world.truth(0);
    const double dx = (now.p.x - before.p.x) / kPlatformStep, dy = (now.p.y - before.p.y) / kPlatformStep;
    const double phi = before.p.phi + wrap_angle(now.p.phi - before.p.phi) / 2;
    EXPECT_NEAR(std::cos(phi) * dx + std::sin(phi) * dy, (before.v.vx + now.v.vx) / 2, 0.01);
    EXPECT_NEAR(std::cos(phi) * dy - std::sin(phi) * dx, (before.v.vy + now.v.vy) / 2, 0.01);
    EXPECT_NEAR(wrap_angle(now.p.phi - before.p.phi) / kPlatformStep, (before.v.w + now.v.w) / 2, 0.05);
  }
}

TEST(PlatformWorld, WallsStopThePlatform) {
  PlatformWorldParameters p = ideal_world();
  p.room = {.lower = {-3, -2}, .upper = {3, 2}, .obstacles = {}};
  PlatformWorld world(p);
  run(world, drive({12, 12, 12, 12}), 6);
  EXPECT_NEAR(world.truth(0).p.x, 3 - ideal_platform().body.length / 2, 0.01);
  EXPECT_NEAR(world.truth(0).v.vx, 0, 0.01);
  EXPECT_GT(world.truth(0).wheel_speed[0], 1) << "its wheels go on";
}

/// Every obstacle and every wall, from every side: the outline stays out of them.
TEST(PlatformWorld, NothingIsDrivenThrough) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> torque(-12, 16);
  PlatformWorldParameters p = usual_world();
  p.room.obstacles.push_back({"crate", {{0.9, 0.4}, {1.5, 0.4}, {1.5, 1}, {0.9, 1}}});
  p.room.obstacles.push_back({"column", {{-1.2, -0.6}, {-0.9, -1}, {-0.7, -0.4}}});
  const auto& b = p.platforms[0].body;
  PlatformWorld world(p, 2);
  for (int k = 0; k < 2000; ++k) {
    const PlatformDrive d = drive({torque(random), torque(random), torque(random), torque(random)});
    run(world, d, 0.05);
    const PlanarPose at = world.truth(0).p;
    for (const auto& [i, j] : {RoomPoint{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      // A little inside of the outline.
      const double u = i * (b.length / 2 - 0.03), v = j * (b.width / 2 - 0.03);
      const RoomPoint corner{at.x + std::cos(at.phi) * u - std::sin(at.phi) * v,
                             at.y + std::sin(at.phi) * u + std::cos(at.phi) * v};
      ASSERT_GT(clearance(p.room, {at.x, at.y}, corner), 0) << k << ": " << at.x << ' ' << at.y;
    }
  }
}

TEST(PlatformWorld, TwoPlatformsPushEachOther) {
  PlatformWorldParameters p = ideal_world();
  p.platforms.assign(2, ideal_platform());
  p.platforms[1].start.x = 1.5;
  PlatformWorld world(p);
  const std::vector<PlatformDrive> drives{drive({5, 5, 5, 5}), drive({0, 0, 0, 0})};
  for (int step = 0; step < 2000; ++step) world.step(drives);
  EXPECT_GT(world.truth(1).p.x, 1.6);
  EXPECT_GT(world.truth(1).p.x - world.truth(0).p.x, ideal_platform().body.length - 0.01);
}

TEST(PlatformWorld, PatchesSlipBelowTheWheelsThatAreOnThem) {
  GroundParameters ground;
  ground.patches = {{.lower = {0, -2}, .upper = {4, 0}, .scale = 0.5, .from = 0},
                    {.lower = {1, -5}, .upper = {5, 5}, .scale = 0.5, .from = 15}};
  EXPECT_DOUBLE_EQ(friction_at(ground, -1, -1, 20).mu_x, 0.7);
  EXPECT_DOUBLE_EQ(friction_at(ground, 2, -1, 14.9).mu_x, 0.35);
  EXPECT_DOUBLE_EQ(friction_at(ground, 2, -1, 15).mu_y, 0.15);
  EXPECT_DOUBLE_EQ(friction_at(ground, 2, 1, 15).mu_y, 0.3);

  PlatformWorldParameters p = ideal_world();
  p.ground.patches = {{.lower = {-9, -9}, .upper = {9, 0}, .scale = 0.1, .from = 0}};
  PlatformWorld world(p);
  run(world, drive({15, 15, 15, 15}), 0.5);
  EXPECT_LT(world.truth(0).friction[1][0], 0.08) << "right";
  EXPECT_GT(world.truth(0).friction[0][0], 0.6) << "left";
  EXPECT_LT(world.truth(0).p.phi, -0.1) << "the side that grips overtakes";
}

TEST(PlatformWorld, CurrentsAreThoseOfTheTorques) {
  PlatformWorld world(ideal_world());
  run(world, drive({4, 5, 6, -7}), 0.1);
  for (std::size_t i = 0; i < kWheels; ++i)
    EXPECT_NEAR(world.reading(0).current[i], world.truth(0).torque[i] / 2, 1e-9);
}

TEST(PlatformWorld, RefusesWhatCannotBeSimulated) {
  const auto refused = [](const auto& change) {
    PlatformWorldParameters p = ideal_world();
    change(p);
    EXPECT_THROW(PlatformWorld{p}, std::invalid_argument);
  };
  refused([](auto& p) { p.platforms.clear(); });
  refused([](auto& p) { p.platforms.assign(3, ideal_platform()); });
  refused([](auto& p) { p.micro_steps = 0; });
  refused([](auto& p) { p.platforms[0].body.mass = 0; });
  refused([](auto& p) { p.platforms[0].centre = {0.26, 0}; });
  refused([](auto& p) { p.ground.slip_speed = 0; });
  refused([](auto& p) { p.boxes.assign(kMostBoxes + 1, {}); });
  refused([](auto& p) { p.boxes = {{.mass = 0}}; });
  refused([](auto& p) { p.boxes = {{.friction = -0.1}}; });
}

}  // namespace
}  // namespace mrroc::sim
