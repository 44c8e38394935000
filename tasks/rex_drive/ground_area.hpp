// Rectangles in which the simulated ground has another friction, as pictures show them.
#pragma once
#include <vector>

#include "base/config.hpp"
#include "base/room_config.hpp"

namespace mrroc::rex_drive {

/// One of them.
struct GroundArea {
  RoomPoint lower{};  ///< corner on M [m]
  RoomPoint upper{};  ///< the opposite corner [m]
  double scale{1};    ///< of the friction
  double from{};      ///< since when [s]
};

/// @param config  from which the simulator has read its ground
/// @return [sim.ground.patches] @throws ConfigError
[[nodiscard]] std::vector<GroundArea> read_areas(const Config& config);

}  // namespace mrroc::rex_drive
