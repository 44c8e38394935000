// A room as cameras see it: terrazzo on the floor and the walls, and obstacles.
#pragma once
#include <cstdint>

#include "base/room_config.hpp"
#include "sim/camera/scene.hpp"

namespace mrroc::sim {

/// How a room looks.
struct RoomLook {
  std::uint32_t seed{1};   ///< of what is on its surfaces
  double contrast{1.2};    ///< of that; 0: grey
  double walls{1};         ///< contrast of the walls, as a share of that; 0: they are plain
  double height{2.5};      ///< of the walls [m]
  double obstacles{0.65};  ///< height of what stands in it [m]
};

/// Everything in it that never moves. U is M, z upwards; equal arguments give equal bytes.
[[nodiscard]] camera::Scene room_scene(const Room& room, const RoomLook& look);

}  // namespace mrroc::sim
