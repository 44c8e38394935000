// Virtual receptor of a tag: pose of an AprilTag from one picture; same interface as the chessboard's.
#pragma once
#include <memory>

#include "base/target/tag.hpp"
#include "vsp/image_sensor.hpp"
#include "vsp/planar_pose.hpp"

namespace mrroc::vsp {

/// Thresholds of the detector.
struct AprilTagParameters {
  double search_blur{
      0.8};           ///< of the whole picture before it is searched: noise makes no outlines then [pixel]
  double margin{20};  ///< least mean difference between a bit and its threshold [grey levels]
  int contrast{15};   ///< least difference between light and dark next to an edge [grey levels]
  double worst_blur{1.4};     ///< of the border's edges: beyond it the corners say too little [pixel]
  double rms_px{0.2};         ///< no pose is delivered whose reprojection error is larger [pixel]
  double worst_angle{0.012};  ///< nor one whose orientation is less certain, standard deviation [rad]
  /// Four corners give two numbers more than a pose has, too few to estimate their noise.
  PlanarPoseParameters pose{.noise_px = 0.03, .significance = 49, .same_angle = 0.03};
};

/// Looks for one tag. The picture is freed of the lens's distortion first: the edges of the tag are located as straight
/// lines. The tag is searched for in a blurred picture, around its last place first, and then located in the unblurred
/// part that shows it. Two tags with the same number in the searched part are reported as
/// ambiguous; so are two poses of one tag.
class AprilTagSensor {
 public:
  /// @throws FaultError bad_configuration: the camera is not proper, or the tag is not in the family
  explicit AprilTagSensor(const CameraModel& camera, const Tag& tag = kTag,
                          const AprilTagParameters& parameters = {});
  AprilTagSensor(AprilTagSensor&&) noexcept;
  AprilTagSensor& operator=(AprilTagSensor&&) noexcept;
  ~AprilTagSensor();

  /// @param picture  1 or 3 channels, of the camera's size; anything else shows nothing
  /// @return pose of the tag's frame G (Tag::corners) in C; not seen and identity when there is none, or not one pose
  CameraReading detect(const ImageView& picture, std::int64_t frame, std::int64_t step);
  /// The next picture has nothing to do with the last one.
  void forget();

 private:
  class Search;
  std::unique_ptr<Search> search_;
};
static_assert(ImageSensor<AprilTagSensor>);

}  // namespace mrroc::vsp
