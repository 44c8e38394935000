// Pictures freed of the lens, against the projection.
#include "vsp/rectified_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "test/vsp/plane_camera.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

/// @return the direction in which the rectified camera has that pixel
Vector3 ray(const CameraModel& rectified, double u, double v) {
  return {(u - rectified.cx) / rectified.fx, (v - rectified.cy) / rectified.fy, 1};
}

TEST(RectifiedImage, SeesAtLeastWhatTheCameraSeesWithoutItsLens) {
  const CameraModel camera = test::web_camera();
  const CameraModel rectified = RectifiedImage(camera).camera();
  EXPECT_EQ(rectified.fx, camera.fx);
  EXPECT_EQ(rectified.fy, camera.fy);
  for (const double k : rectified.distortion) EXPECT_EQ(k, 0);
  EXPECT_GT(rectified.width, camera.width) << "the lens pulls the edges in";
  EXPECT_GT(rectified.height, camera.height);
  EXPECT_LE(rectified.width, 1.8 * camera.width + 2);
  int inside = 0;
  for (double x = -0.8; x <= 0.8; x += 0.02)
    for (double y = -0.6; y <= 0.6; y += 0.02) {
      const Vector2 seen = project(camera, {x, y, 1});
      // The lens's polynomial folds back far outside.
      if (x * x + y * y > 0.6 || seen.x() < 0 || seen.y() < 0 || seen.x() > camera.width - 1 ||
          seen.y() > camera.height - 1)
        continue;
      ++inside;
      const Vector2 p = project(rectified, {x, y, 1});
      EXPECT_GE(p.x(), -0.01);
      EXPECT_GE(p.y(), -0.01);
      EXPECT_LE(p.x(), rectified.width - 0.99);
      EXPECT_LE(p.y(), rectified.height - 0.99);
    }
  EXPECT_GT(inside, 1000);
}

// To the pixel, for lenses that pull the edges' middles in or out, and at most 0.4 of the picture to either side.
TEST(RectifiedImage, IsAsLargeAsWhatTheBordersOfThePictureShow) {
  int cut = 0;
  for (int run = 0; run < 112; ++run) {
    CameraModel camera;
    camera.width = 301 + 2 * run;
    camera.height = 241 + 2 * (run * 7 % 50);
    camera.cx = 0.5 * (camera.width - 1);
    camera.cy = 0.5 * (camera.height - 1);
    camera.fx = camera.fy = 250 + run;
    camera.distortion = {(run % 3 - 1) * (0.1 + 0.0025 * run), 0, 0, 0, 0};
    std::vector<cv::Point2d> border, straight;
    for (int k = 0; k <= 400; ++k) {
      const double u = k / 400.0 * (camera.width - 1), v = k / 400.0 * (camera.height - 1);
      for (const cv::Point2d& p :
           {cv::Point2d(u, 0), {u, camera.height - 1.0}, {0, v}, {camera.width - 1.0, v}})
        border.push_back(p);
    }
    cv::undistortPoints(border, straight, camera_matrix(camera), distortion(camera), cv::noArray(),
                        camera_matrix(camera));
    double left = 0, up = 0, right = camera.width - 1, low = camera.height - 1;
    for (const cv::Point2d& p : straight) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      left = std::min(left, p.x);
      right = std::max(right, p.x);
      up = std::min(up, p.y);
      low = std::max(low, p.y);
    }
    cut += left < -0.4 * camera.width ? 1 : 0;
    left = std::floor(std::max(left, -0.4 * camera.width));
    up = std::floor(std::max(up, -0.4 * camera.height));
    right = std::ceil(std::min(right, 1.4 * camera.width));
    low = std::ceil(std::min(low, 1.4 * camera.height));
    const CameraModel rectified = RectifiedImage(camera).camera();
    EXPECT_EQ(rectified.width, right - left + 1) << run;
    EXPECT_EQ(rectified.height, low - up + 1) << run;
    EXPECT_EQ(rectified.cx, camera.cx - left) << run;
    EXPECT_EQ(rectified.cy, camera.cy - up) << run;
  }
  EXPECT_GT(cut, 0);
}

TEST(RectifiedImage, ACameraWithoutALensKeepsItsPicture) {
  const CameraModel camera;
  const RectifiedImage rectified(camera);
  EXPECT_LE(std::abs(rectified.camera().width - camera.width), 2);
  EXPECT_LE(std::abs(rectified.camera().height - camera.height), 2);
  EXPECT_NEAR(rectified.camera().cx, camera.cx, 1);
  EXPECT_NEAR(rectified.camera().cy, camera.cy, 1);
}

TEST(RectifiedImage, EveryPixelShowsWhatTheCameraSeesInItsDirection) {
  const CameraModel camera = test::web_camera();
  const RectifiedImage rectified(camera);
  Image across(camera.width, camera.height, 1), down(camera.width, camera.height, 1);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const auto k = static_cast<std::size_t>(v * camera.width + u);
      across.data[k] = static_cast<std::uint8_t>(u / 4);
      down.data[k] = static_cast<std::uint8_t>(v / 2);
    }
  const cv::Mat us = rectified.part(grey(across.view()), rectified.whole());
  const cv::Mat vs = rectified.part(grey(down.view()), rectified.whole());
  ASSERT_EQ(us.cols, rectified.camera().width);
  ASSERT_EQ(us.rows, rectified.camera().height);
  int seen = 0;
  for (int v = 0; v < us.rows; v += 7)
    for (int u = 0; u < us.cols; u += 7) {
      const Vector2 p = project(camera, ray(rectified.camera(), u, v));
      if (p.x() < 2 || p.y() < 2 || p.x() > camera.width - 3 || p.y() > camera.height - 3) continue;
      ++seen;
      ASSERT_NEAR(us.at<std::uint8_t>(v, u), p.x() / 4, 1.3) << u << ' ' << v;
      ASSERT_NEAR(vs.at<std::uint8_t>(v, u), p.y() / 2, 1.6) << u << ' ' << v;
    }
  EXPECT_GT(seen, 5000);
  const cv::Rect part(100, 50, 60, 40);
  const cv::Mat cut = rectified.part(grey(across.view()), part);
  ASSERT_EQ(cut.cols, 60);
  ASSERT_EQ(cut.rows, 40);
  for (int v = 0; v < 40; v += 3)
    for (int u = 0; u < 60; u += 3)
      ASSERT_EQ(cut.at<std::uint8_t>(v, u), us.at<std::uint8_t>(50 + v, 100 + u));
}

TEST(OpenCv, APictureFitsACameraOfItsSizeInGreyOrColour) {
  CameraModel camera;
  camera.width = 8;
  camera.height = 6;
  EXPECT_TRUE(fits(Image(8, 6, 1).view(), camera));
  EXPECT_TRUE(fits(Image(8, 6, 3).view(), camera));
  EXPECT_FALSE(fits(Image(8, 6, 2).view(), camera));
  EXPECT_FALSE(fits(Image(6, 8, 1).view(), camera));
  EXPECT_FALSE(fits(Image(8, 7, 1).view(), camera));
  EXPECT_FALSE(fits(Image(9, 6, 1).view(), camera));
  EXPECT_FALSE(fits(ImageView{}, camera));
}

}  // namespace
}  // namespace mrroc::vsp
