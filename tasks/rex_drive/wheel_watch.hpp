// How the wheels have turned lately.
#pragma once
#include <cstdint>
#include <optional>
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

/// @return how far the wheels had turned at a step; nothing when the watch does not reach there
[[nodiscard]] std::optional<PerWheel> angles_at(const WheelWatch& watch, std::int64_t step);

}  // namespace mrroc::rex_drive
