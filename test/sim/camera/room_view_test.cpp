// Platforms' cameras and what they see.
#include "sim/camera/room_view.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/camera/renderer.hpp"
#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

CameraSetup eye_of(const std::string& platform) {
  CameraSetup c;
  c.key = "eye";
  c.mount = platform.empty() ? CameraMount::world : CameraMount::robot;
  c.robot = platform;
  c.model = {.width = 80, .height = 60, .fx = 50, .fy = 50, .cx = 39.5, .cy = 29.5};
  return c;
}

std::vector<std::uint8_t> seen(const camera::Scene& scene, const Pose& T_UC) {
  camera::RenderProfile profile = camera::plain_profile();
  profile.channels = 1;
  profile.noise = 0;
  return camera::Renderer(eye_of("").model, profile).render(scene, T_UC, 0).data;
}

/// Mean of the brightness, and its spread.
std::pair<double, double> mean_and_sd(const std::vector<std::uint8_t>& grey) {
  double sum = 0;
  double squares = 0;
  for (const int g : grey) {
    sum += g;
    squares += g * g;
  }
  const double n = static_cast<double>(grey.size());
  return {sum / n, std::sqrt(squares / n - sum / n * sum / n)};
}

TEST(RoomScene, WallsFloorAndObstaclesAreSeenFromInsideInAllDirections) {
  Room room = built_in_room();
  const camera::Scene scene = room_scene(room, {});
  for (int k = 0; k < 12; ++k) {
    const double phi = k * 0.5236;
    const Vector3 eye(0.3, -0.2, 0.45);
    const auto grey =
        seen(scene, looking_at(eye, eye + Vector3(std::cos(phi), std::sin(phi), -0.1), {0, 0, 1}));
    const auto [mean, sd] = mean_and_sd(grey);
    EXPECT_GT(sd, 10) << k << ": terrazzo, not the background";
    EXPECT_LT(mean, 200) << k;
  }
}

TEST(RoomScene, EqualArgumentsGiveEqualPicturesAndAnotherSeedOthers) {
  const Pose T_UC = looking_at({0, 0, 0.45}, {2, 0.5, 0.3}, {0, 0, 1});
  const auto once = seen(room_scene(built_in_room(), {.seed = 4}), T_UC);
  EXPECT_EQ(once, seen(room_scene(built_in_room(), {.seed = 4}), T_UC));
  EXPECT_NE(once, seen(room_scene(built_in_room(), {.seed = 5}), T_UC));
}

TEST(RoomScene, PlainWallsHaveNoTextureAndTheFloorKeepsIts) {
  const Room empty;
  const camera::Scene scene = room_scene(empty, {.walls = 0});
  const auto wall = seen(scene, looking_at({2, 0, 1.5}, {3, 0, 1.5}, {0, 0, 1}));
  const auto floor = seen(scene, looking_at({0, 0, 1.5}, {0.01, 0, 0}, {0, 0, 1}));
  EXPECT_LT(mean_and_sd(wall).second, 1);
  EXPECT_GT(mean_and_sd(floor).second, 10);
}

TEST(RoomView, ACameraIsWhereItsPlatformIs) {
  PlatformWorldParameters p = test::ideal_world();
  p.platforms[0].start = {0.5, -0.3, 1.2};
  const PlatformWorld world(p);
  const RoomView view(world, p, {"rex"}, {}, {});
  const Pose T_UB = view.mount(eye_of("rex"));
  EXPECT_NEAR(T_UB.p.x(), 0.5, 1e-12);
  EXPECT_NEAR(T_UB.p.y(), -0.3, 1e-12);
  EXPECT_NEAR(T_UB.p.z(), 0, 1e-12);
  EXPECT_NEAR(std::atan2(T_UB.R(1, 0), T_UB.R(0, 0)), 1.2, 1e-12);
  EXPECT_TRUE(view.mount(eye_of("")).R.isIdentity());
  EXPECT_THROW((void)view.mount(eye_of("other")), std::out_of_range);
}

TEST(RoomView, APlatformSeesTheOtherOneAndNotItself) {
  PlatformWorldParameters p = test::ideal_world();
  p.platforms.push_back(p.platforms[0]);
  p.platforms[1].start = {1.5, 0, 0};
  const PlatformWorld world(p);
  const RoomView view(world, p, {"rex", "max"}, {}, {});
  const auto bodies = [&](const std::string& platform) {
    return view.scene(eye_of(platform), 0).bodies.size();
  };
  EXPECT_EQ(bodies("rex"), bodies("max"));
  EXPECT_EQ(bodies(""), bodies("rex") + 1);
  const camera::Body other = view.scene(eye_of("rex"), 0).bodies.back();
  EXPECT_NEAR(other.T_UB.p.x(), 1.5, 1e-12);
}

}  // namespace
}  // namespace mrroc::sim
