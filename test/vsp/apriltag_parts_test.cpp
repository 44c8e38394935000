// The reading of the tag is made of its parts: the detector in the rectified picture, around the last place and everywhere,
// the border and the pose.
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "test/vsp/plane_camera.hpp"
#include "test/vsp/reading_count.hpp"
#include "vsp/apriltag/apriltag_sensor.hpp"
#include "vsp/apriltag/tag_search.hpp"
#include "vsp/opencv.hpp"
#include "vsp/rectified_image.hpp"

namespace mrroc::vsp {
namespace {

/// As apriltag_sensor.hpp says; remembers where the tag was.
class Reference {
 public:
  Reference(const CameraModel& camera, const AprilTagParameters& k) : rectified_(camera), k_(k) {
    apriltag_detector_add_family_bits(detector_, family_, 0);
    detector_->qtp.min_white_black_diff = k.contrast;
  }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;
  ~Reference() {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }

  CameraReading detect(const cv::Mat& picture) {
    const cv::Rect whole = rectified_.whole();
    std::vector<Border> tags;
    if (last_) tags = borders(picture, part_around(*last_, whole), 0);
    if (tags.empty()) {
      tags = borders(picture, whole, k_.search_blur);
      if (tags.size() == 1) {
        const auto exact = borders(picture, part_around(tags[0].corners, whole), 0);
        if (exact.size() == 1) tags = exact;
      }
    }
    CameraReading r;
    last_.reset();
    if (tags.size() == 1) last_ = tags[0].corners;
    if (tags.empty()) return r;
    PlanarPoseParameters p = k_.pose;
    p.noise_px = std::max(p.noise_px, tags[0].sigma);
    const auto poses = planar_pose(rectified_.camera(), kTag.corners(), tags[0].corners, p);
    if (!poses || poses->best.rms_px > k_.rms_px) return r;
    r.reprojection_px = poses->best.rms_px;
    r.ambiguous = poses->ambiguous || tags.size() > 1;
    const double angle = std::sqrt(poses->best.covariance.diagonal().tail<3>().maxCoeff());
    if (r.ambiguous || angle > k_.worst_angle) return r;
    r.seen = true;
    r.T_CG = poses->best.T_CG;
    r.covariance = poses->best.covariance;
    return r;
  }

 private:
  std::vector<Border> borders(const cv::Mat& picture, const cv::Rect& part, double blur) {
    std::vector<Border> all;
    if (std::min(part.width, part.height) < 16) return all;
    cv::Mat pixels = rectified_.part(picture, part);
    image_u8_t image{pixels.cols, pixels.rows, static_cast<int>(pixels.step), pixels.data};
    detector_->quad_sigma = static_cast<float>(blur);
    detector_->quad_decimate = is_cluttered(pixels, std::max(0.8, blur), k_.contrast) ? 2 : 1;
    zarray_t* const found = apriltag_detector_detect(detector_, &image);
    for (int n = 0; n < zarray_size(found); ++n) {
      apriltag_detection_t* tag{};
      zarray_get(found, n, static_cast<void*>(&tag));
      if (tag->id != kTag.id || tag->decision_margin < k_.margin) continue;
      Corners rough;
      for (std::size_t c = 0; c < 4; ++c) rough[c] = Vector2(tag->p[c][0], tag->p[c][1]) - Vector2(0.5, 0.5);
      auto border = locate_border(pixels, rough);
      if (!border || border->blur > k_.worst_blur) continue;
      for (Vector2& c : border->corners) c += Vector2(part.x, part.y);
      all.push_back(*border);
    }
    apriltag_detections_destroy(found);
    return all;
  }

  RectifiedImage rectified_;
  AprilTagParameters k_;
  apriltag_family_t* family_{tag36h11_create()};
  apriltag_detector_t* detector_{apriltag_detector_create()};
  std::optional<Corners> last_;
};

TEST(AprilTagParts, MakeTheReading) {
  CameraModel camera = test::web_camera();
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 300;
  camera.cx = 159.5;
  camera.cy = 119.5;
  const test::PlaneCamera eye(camera, 2);
  std::mt19937 random(8);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  const auto tag = test::tag_texture(kTag.id, kTag.edge, kTag.margin);
  const auto wrong = test::tag_texture(7, kTag.edge, kTag.margin);
  test::ReadingCount count;
  for (int run = 0; run < 10; ++run) {
    AprilTagParameters k;
    k.search_blur = uniform(0.4, 1.2);
    k.margin = uniform(10, 40);
    k.contrast = static_cast<int>(uniform(5, 40));
    k.worst_blur = uniform(1, 2);
    k.rms_px = run % 5 == 0 ? 0.02 : uniform(0.05, 0.5);
    k.worst_angle = run % 4 == 1 ? uniform(0.0004, 0.001) : uniform(0.006, 0.06);
    k.pose.significance = run % 3 == 2 ? 1e5 : 9;
    AprilTagSensor sensor(camera, kTag, k);
    Reference reference(camera, k);
    const double z = uniform(0.22, 0.4), azimuth = uniform(0, 6.3);
    double x = 0;
    for (int step = 0; step < 12; ++step) {
      x += uniform(-0.02, 0.01);
      const bool hidden = step == 7, textured = step % 6 == 3;
      const double other = step % 3 == 2 ? uniform(0.13, 0.14) : 9;
      const Pose T = test::facing(z, 0.5, azimuth, 0.1 * step, x);
      const Image image = eye.render(
          T,
          [&](double a, double b) {
            if (hidden) return 120.0F;
            if (textured && std::max(std::abs(a), std::abs(b)) > 0.08)
              return std::fmod(std::abs(a), 0.012) < 0.006 ? 230.0F : 60.0F;
            return a > other - 0.065 ? (step == 5 ? wrong(a - other, b) : tag(a - other, b)) : tag(a, b);
          },
          {.blur = 0.3 + 0.1 * (run % 6), .noise = 1.0 + run % 4, .seed = static_cast<unsigned>(random())});
      const CameraReading is = sensor.detect(image.view(), step, 20 * step),
                          would = reference.detect(grey(image.view()));
      EXPECT_EQ(is.frame, step);
      EXPECT_EQ(is.step, 20 * step);
      count.compare(is, would, std::to_string(run) + " " + std::to_string(step));
    }
  }
  count.expect_all_kinds();
}

}  // namespace
}  // namespace mrroc::vsp
