// What kind of drive a run is: what is wanted of its figures depends on it.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/config.hpp"

namespace mrroc::rex_drive {

/// Drives of which different things are wanted. All but `other` are with the platform, its sensors and its kernels (NMPC and
/// MHE) as they are built in.
enum class DriveCase {
  usual,      ///< a built-in plan on the usual ground, as fast as the built-in configuration says or slower
  own_plan,   ///< the same with a plan of the user's
  fast,       ///< any plan on the usual ground, faster
  slippery,   ///< on the ground of this name, at any speed
  ice_right,  ///< the same
  smooth,     ///< the same
  other       ///< anything else
};

/// @param run   the configuration of a run, all of which has been read
/// @param read  reads what simulator and driver read of a configuration: their keys are compared, defaults and all
/// @return the kind of that run; its cameras and its odometry do not matter
[[nodiscard]] DriveCase drive_case(const Config& run, const std::function<void(const Config&)>& read);

/// @param run   as above  @param read  as above, and what the odometry reads
/// @return keys of cameras and odometry with other values than the built-in ones; none without eyes
[[nodiscard]] std::vector<std::string> changed_eyes(const Config& run,
                                                    const std::function<void(const Config&)>& read);

}  // namespace mrroc::rex_drive
