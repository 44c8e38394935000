#include "base/camera.hpp"

#include <gtest/gtest.h>

namespace mrroc {
namespace {

TEST(Camera, PointOnTheAxisIsSeenAtThePrincipalPointWhateverTheLens) {
  CameraModel camera;
  camera.distortion = {-0.28, 0.09, 1e-3, -2e-3, 0.01};
  EXPECT_EQ(project(camera, {0, 0, 0.7}), Vector2(camera.cx, camera.cy));
}

TEST(Camera, PinholeScalesByFocalLengthOverDistance) {
  const CameraModel camera;
  const Vector2 pixel = project(camera, {0.1, -0.2, 0.5});
  EXPECT_NEAR(pixel.x(), 319.5 + 600 * 0.2, 1e-12);
  EXPECT_NEAR(pixel.y(), 239.5 - 600 * 0.4, 1e-12);
}

TEST(Camera, BarrelDistortionDrawsPointsToTheCentre) {
  CameraModel camera;
  camera.distortion[0] = -0.28;
  const Vector2 pixel = project(camera, {0.25, 0, 0.5});
  EXPECT_NEAR(pixel.x(), 319.5 + 600 * 0.5 * (1 - 0.28 * 0.25), 1e-12);
  EXPECT_NEAR(pixel.y(), 239.5, 1e-12);
}

TEST(Camera, TangentialDistortionIsThatOfAnObliqueLens) {
  CameraModel camera;
  camera.distortion = {0, 0, 0.01, 0.02, 0};
  const double x = 0.2;
  const double y = -0.3;
  const double r2 = x * x + y * y;
  const Vector2 pixel = project(camera, {x, y, 1});
  EXPECT_NEAR(pixel.x(), 319.5 + 600 * (x + 2 * 0.01 * x * y + 0.02 * (r2 + 2 * x * x)), 1e-12);
  EXPECT_NEAR(pixel.y(), 239.5 + 600 * (y + 0.01 * (r2 + 2 * y * y) + 2 * 0.02 * x * y), 1e-12);
}

TEST(Camera, IsImproperWithoutSizeOrWithNumbersThatAreNone) {
  EXPECT_TRUE(is_proper(CameraModel{}));
  EXPECT_FALSE(is_proper({.width = 0}));
  EXPECT_FALSE(is_proper({.fy = -1}));
  EXPECT_FALSE(is_proper({.cx = std::nan("")}));
  EXPECT_FALSE(is_proper({.distortion = {0, 0, INFINITY, 0, 0}}));
}

}  // namespace
}  // namespace mrroc
