// Whether the wheels contradict a motion that was seen.
#pragma once
#include <cstdint>
#include <vector>

#include "base/platform_command.hpp"

namespace mrroc::rex_drive {

/// How far the wheels had turned at a step.
struct WheelAngles {
  std::int64_t step{};  ///< of the estimate that tells it
  PerWheel theta{};     ///< turned since power-up [rad]
};

/// The newest estimates, the oldest first: at least as many as lie between the first picture of a motion and its reading.
using WheelWatch = std::vector<WheelAngles>;

/// @return the watch with an estimate that is newer than all others in it; else the watch
[[nodiscard]] WheelWatch watched(WheelWatch watch, const PlatformEstimate& estimate);

/// A camera that hangs gives a picture which does not move; with the sensor's noise on it, it looks like one of a platform that
/// stands. Wheels which turn against it are believed: what is lost, should they really spin, is a reading.
/// @return whether the reading is valid and shows no motion, though the wheels turned by more than they can slip between its two
///         pictures; false when the watch does not reach back to them
[[nodiscard]] bool stands_against_wheels(const OdometryReading& reading, const WheelWatch& watch);

}  // namespace mrroc::rex_drive
