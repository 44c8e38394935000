// Virtual receptor r_1,1 of a platform (paper REX): visual odometry, the motion between the two last stereo pairs.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.hpp"
#include "base/odometry_support.hpp"
#include "base/platform_command.hpp"
#include "vsp/odometry/stereo_rig.hpp"

namespace mrroc::vsp {

/// What a motion must rest on to be valid.
struct StereoOdometryParameters {
  int inliers{25};   ///< least matches that agree, 6..400
  int cells{4};      ///< least cells of the picture, of 4 x 5, in which they lie, 1..20
  double rms_px{1};  ///< most root mean square of their reprojection errors [pixel]
  double way{0.25};  ///< longest way between two pairs [m]
  double change{
      0.075};  ///< most by which it differs from the way before [m]: nothing brakes harder than 1.2 g in 80 ms. Where all
  ///< looks alike, a motion that is off by a period of the pattern has as many inliers as the true one
};

/// A point that was found in all four pictures.
struct SeenPoint {
  Vector2 before;  ///< where it is in the left picture of the first pair [pixel]
  Vector2 now;     ///< in that of the second
  bool inlier{};   ///< the motion rests on it
};

/// Remembers one pair. A reading is a function of this pair, of the pair before and of the parameters: bit for bit. The
/// work for any two pairs is bounded. Not for the servo step.
class StereoOdometry {
 public:
  explicit StereoOdometry(const StereoRig& rig, const StereoOdometryParameters& parameters = {});
  StereoOdometry(StereoOdometry&&) noexcept;
  StereoOdometry& operator=(StereoOdometry&&) noexcept;
  ~StereoOdometry();

  /// @param left, right  1 or 3 channels, of the cameras' size; anything else is no picture
  /// @param frame        number of the pair
  /// @param step         at which both were taken
  /// @return motion of B since the pair before, with the covariance of its error: x y z [m], ax ay az [rad] along B at the
  ///         pair before. Not valid when there is no pair before, a picture of the two pairs is missing or the very same as
  ///         the one before it (the camera is frozen: when it was taken is not known), the step is not later, or the motion does
  ///         not rest on enough
  OdometryReading step(const ImageView& left, const ImageView& right, std::int64_t frame, std::int64_t step);
  /// @return what the last reading rests on
  [[nodiscard]] const OdometrySupport& support() const;
  /// @return the points of its pictures
  [[nodiscard]] const std::vector<SeenPoint>& seen() const;

 private:
  class Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace mrroc::vsp
