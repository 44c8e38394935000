#include "base/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

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

TEST(Camera, RadialDistortionHasThreeTerms) {
  CameraModel camera{.fx = 500, .fy = 700};
  camera.distortion = {-0.3, 0.2, 0, 0, -0.1};
  for (const auto& [x, y, z] :
       {std::tuple(0.3, -0.2, 1.), std::tuple(-0.7, 0.5, 2.), std::tuple(1., 1., 1.5)}) {
    const double r2 = (x * x + y * y) / (z * z);
    const double radial = 1 - 0.3 * r2 + 0.2 * r2 * r2 - 0.1 * r2 * r2 * r2;
    const Vector2 pixel = project(camera, {x, y, z});
    EXPECT_NEAR(pixel.x(), camera.cx + 500 * radial * x / z, 1e-9);
    EXPECT_NEAR(pixel.y(), camera.cy + 700 * radial * y / z, 1e-9);
  }
}

TEST(Camera, IsImproperWithoutSizeOrWithNumbersThatAreNone) {
  EXPECT_TRUE(is_proper(CameraModel{}));
  EXPECT_TRUE(is_proper({.width = 1, .height = 1, .fx = 1e-3, .fy = 1e-3, .cx = -5, .cy = -5}));
  for (const double bad : {0., -1., std::nan(""), double{INFINITY}}) {
    EXPECT_FALSE(is_proper({.fx = bad}));
    EXPECT_FALSE(is_proper({.fy = bad}));
    if (bad == 0 || bad == -1) {
      EXPECT_FALSE(is_proper({.width = static_cast<int>(bad)}));
      EXPECT_FALSE(is_proper({.height = static_cast<int>(bad)}));
      continue;
    }
    EXPECT_FALSE(is_proper({.cx = bad}));
    EXPECT_FALSE(is_proper({.cy = bad}));
    for (std::size_t k = 0; k < 5; ++k) {
      CameraModel camera;
      camera.distortion[k] = bad;
      EXPECT_FALSE(is_proper(camera)) << k;
    }
  }
  EXPECT_FALSE(is_proper({.width = 0}));
  EXPECT_FALSE(is_proper({.fy = -1}));
  EXPECT_FALSE(is_proper({.cx = std::nan("")}));
  EXPECT_FALSE(is_proper({.distortion = {0, 0, INFINITY, 0, 0}}));
}

}  // namespace
}  // namespace mrroc
