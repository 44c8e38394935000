// The odometry's part of the configuration, as its receptor and whoever uses its readings read it:
//
//   [odometry.rex]
//   left = "rex_left"       # of the cameras; both are mounted on "rex", whose odometry it is
//   right = "rex_right"
#pragma once
#include <string>

#include "base/camera_config.hpp"
#include "base/config.hpp"
#include "vsp/odometry/stereo_odometry.hpp"

namespace mrroc::vsp {

/// A pair of cameras on a platform as everybody knows it.
struct StereoSetup {
  std::string key;                      ///< of the platform
  CameraSetup left, right;              ///< their poses are in B
  StereoOdometryParameters parameters;  ///< `inliers`, `cells`, `rms`, `way`, `change`

  /// @return the pair as one instrument @throws FaultError bad_configuration, as StereoRig
  [[nodiscard]] StereoRig rig() const { return {{left.model, left.place}, {right.model, right.place}}; }
};

/// @param key  of the platform
/// @return [odometry.KEY] with its cameras
/// @throws ConfigError  `left` or `right` is missing, they are one camera, one of them is not mounted on the platform, or
///         they differ in size, period or latency
StereoSetup read_stereo(const Config& config, const std::string& key);

}  // namespace mrroc::vsp
