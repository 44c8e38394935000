// The ground that a simulation has laid, and rectangles in which it has another friction, as pictures show them.
#pragma once
#include <array>
#include <vector>

#include "base/config.hpp"
#include "base/room_config.hpp"

namespace mrroc {

/// One of them.
struct GroundArea {
  RoomPoint lower{};  ///< corner on M [m]
  RoomPoint upper{};  ///< the opposite corner [m]
  double scale{1};    ///< of the friction
  double from{};      ///< since when [s]
};

/// The floor as it is simulated.
struct DriveGround {
  std::array<double, 2> friction{};  ///< along and across the wheels, where there is no area
  std::vector<GroundArea> areas;     ///< with another friction; where some overlap, all their scales count
  bool smooth{};                     ///< friction grows with slip as the kernels' model has it
};

/// @param config  from which the simulator has read its ground
/// @return [sim.ground] @throws ConfigError
[[nodiscard]] DriveGround read_ground(const Config& config);

/// @return the areas of [sim.ground], none where the simulator has read none @throws ConfigError
[[nodiscard]] std::vector<GroundArea> read_ground_areas(const Config& config);

}  // namespace mrroc
