#include "vsp/apriltag/apriltag_sensor.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <algorithm>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "base/fault.hpp"
#include "vsp/apriltag/border.hpp"
#include "vsp/apriltag/tag_search.hpp"
#include "vsp/opencv.hpp"
#include "vsp/rectified_image.hpp"

namespace mrroc::vsp {
namespace {

struct DeleteDetector {
  void operator()(apriltag_detector_t* d) const { apriltag_detector_destroy(d); }
};
struct DeleteFamily {
  void operator()(apriltag_family_t* f) const { tag36h11_destroy(f); }
};
struct DeleteDetections {
  void operator()(zarray_t* z) const { apriltag_detections_destroy(z); }
};

}  // namespace

class AprilTagSensor::Search {
 public:
  void forget() { last_.reset(); }

  Search(const CameraModel& camera, const Tag& tag, const AprilTagParameters& parameters)
      : camera_(camera),
        rectified_(camera),
        tag_(tag),
        k_(parameters),
        family_(tag36h11_create()),
        detector_(apriltag_detector_create()) {
    if (tag.id < 0 || tag.id >= static_cast<int>(family_->ncodes) || !(tag.edge > 0))
      throw FaultError(FaultCode::bad_configuration, "there is no such tag in the family 36h11");
    apriltag_detector_add_family_bits(detector_.get(), family_.get(), 0);  // wrong ones that are allowed
    detector_->nthreads = 1;
    detector_->qtp.min_white_black_diff = parameters.contrast;
  }

  CameraReading detect(const ImageView& picture, std::int64_t frame, std::int64_t step) {
    CameraReading reading;
    reading.frame = frame;
    reading.step = step;
    if (!fits(picture, camera_)) return reading;
    const cv::Mat brightness = grey(picture);
    std::vector<Border> tags;
    if (last_) tags = find(brightness, part_around(*last_, rectified_.whole()), 0);
    if (tags.empty()) {
      tags = find(brightness, rectified_.whole(), k_.search_blur);
      if (tags.size() == 1) {
        const auto located = find(brightness, part_around(tags.front().corners, rectified_.whole()), 0);
        if (located.size() == 1) tags = located;
      }
    }
    last_.reset();
    if (tags.empty()) return reading;
    if (tags.size() == 1) last_ = tags.front().corners;
    fill_in(tags, reading);
    return reading;
  }

 private:
  void fill_in(const std::vector<Border>& tags, CameraReading& reading) const {
    PlanarPoseParameters k = k_.pose;
    k.noise_px = std::max(k.noise_px, tags.front().sigma);
    const auto pose = planar_pose(rectified_.camera(), tag_.corners(), tags.front().corners, k);
    if (!pose || pose->best.rms_px > k_.rms_px) return;
    reading.reprojection_px = pose->best.rms_px;
    reading.ambiguous = tags.size() > 1 || pose->ambiguous;
    const Eigen::Vector3d variances = pose->best.covariance.diagonal().tail<3>();
    if (reading.ambiguous || variances.maxCoeff() > k_.worst_angle * k_.worst_angle) return;
    reading.seen = true;
    reading.T_CG = pose->best.T_CG;
    reading.covariance = pose->best.covariance;
  }

  // Tags with the number that is looked for, corners in the order of Tag::corners().
  std::vector<Border> find(const cv::Mat& brightness, const cv::Rect& part, double blur) const {
    std::vector<Border> found;
    if (part.width < 16 || part.height < 16) return found;
    cv::Mat pixels = rectified_.part(brightness, part);
    image_u8_t image{pixels.cols, pixels.rows, static_cast<int>(pixels.step), pixels.data};
    detector_->quad_sigma = static_cast<float>(blur);
    detector_->quad_decimate = is_cluttered(pixels, std::max(0.8, blur), k_.contrast) ? 2 : 1;
    const std::unique_ptr<zarray_t, DeleteDetections> all(apriltag_detector_detect(detector_.get(), &image));
    for (int k = 0; k < zarray_size(all.get()); ++k) {
      apriltag_detection_t* tag{};
      zarray_get(all.get(), k, &tag);
      if (tag->id != tag_.id || tag->decision_margin < k_.margin) continue;
      Corners corners;
      // AprilTag counts pixels from the corner of the first one, not from its centre.
      for (std::size_t c = 0; c < 4; ++c) corners[c] = {tag->p[c][0] - 0.5, tag->p[c][1] - 0.5};
      auto border = locate_border(pixels, corners);
      if (!border || border->blur > k_.worst_blur) continue;
      found.push_back(*border);
      for (Vector2& c : found.back().corners) c += Vector2(part.x, part.y);
    }
    return found;
  }

  CameraModel camera_;
  RectifiedImage rectified_;
  Tag tag_;
  AprilTagParameters k_;
  std::unique_ptr<apriltag_family_t, DeleteFamily> family_;
  std::unique_ptr<apriltag_detector_t, DeleteDetector> detector_;
  std::optional<Corners> last_;
};

AprilTagSensor::AprilTagSensor(const CameraModel& camera, const Tag& tag,
                               const AprilTagParameters& parameters) {
  if (!is_proper(camera)) throw FaultError(FaultCode::bad_configuration, "the camera's model is not proper");
  search_ = std::make_unique<Search>(camera, tag, parameters);
}
AprilTagSensor::AprilTagSensor(AprilTagSensor&&) noexcept = default;
AprilTagSensor& AprilTagSensor::operator=(AprilTagSensor&&) noexcept = default;
AprilTagSensor::~AprilTagSensor() = default;

void AprilTagSensor::forget() { search_->forget(); }

CameraReading AprilTagSensor::detect(const ImageView& picture, std::int64_t frame, std::int64_t step) {
  return search_->detect(picture, frame, step);
}

}  // namespace mrroc::vsp
