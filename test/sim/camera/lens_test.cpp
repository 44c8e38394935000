#include "sim/camera/lens.hpp"

#include <gtest/gtest.h>

#include <random>

#include "test/sim/camera/scenes.hpp"

namespace mrroc::camera {
namespace {

TEST(Lens, InvertsTheProjection) {
  const CameraModel camera = test::bent_camera();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, 639);
  std::uniform_real_distribution<double> v(0, 479);
  for (int k = 0; k < 500; ++k) {
    const Vector2 pixel(u(random), v(random));
    const Vector2 x = unproject(camera, pixel);
    EXPECT_LT((project(camera, {x.x(), x.y(), 1}) - pixel).norm(), 1e-8);
  }
}

TEST(Lens, LetsAPictureThroughWhenItIsFlat) {
  const CameraModel camera;
  const Lens lens(camera);
  EXPECT_EQ(lens.pinhole(), camera);
  std::vector<std::uint32_t> seen(640 * 480);
  for (std::size_t k = 0; k < seen.size(); ++k) seen[k] = static_cast<std::uint32_t>(k);
  std::vector<std::uint32_t> bent(seen.size());
  lens.bend(seen, bent);
  EXPECT_EQ(bent, seen);
}

TEST(Lens, TakesEachPixelFromWhereItsLightPassesThePinhole) {
  const CameraModel camera = test::bent_camera();
  const Lens lens(camera);
  const CameraModel& pinhole = lens.pinhole();
  // A picture whose channels are linear in the place, so that means of pixels are exact.
  std::vector<std::uint32_t> seen;
  for (int v = 0; v < pinhole.height; ++v)
    for (int u = 0; u < pinhole.width; ++u)
      seen.push_back(static_cast<std::uint32_t>(u / 4) | static_cast<std::uint32_t>(v / 4) << 8);
  std::vector<std::uint32_t> bent(640U * 480U);
  lens.bend(seen, bent);
  for (int v = 0; v < camera.height; v += 7)
    for (int u = 0; u < camera.width; u += 7) {
      const Vector2 x = unproject(camera, {u, v});
      const Vector2 source = project(pinhole, {x.x(), x.y(), 1});
      const std::uint32_t pixel = bent.at(static_cast<std::size_t>(v) * 640 + static_cast<std::size_t>(u));
      EXPECT_NEAR(pixel & 0xff, source.x() / 4 - 0.375, 1);
      EXPECT_NEAR(pixel >> 8 & 0xff, source.y() / 4 - 0.375, 1);
    }
}

TEST(Lens, RefusesToFoldOrToNeedAHugePicture) {
  CameraModel camera;
  camera.distortion = {-2, 0, 0, 0, 0};
  EXPECT_THROW(Lens{camera}, std::invalid_argument);
  camera.distortion = {-0.9, 0.35, 0, 0, 0};
  camera.fx = camera.fy = 300;
  EXPECT_THROW(Lens{camera}, std::invalid_argument);
}

}  // namespace
}  // namespace mrroc::camera
