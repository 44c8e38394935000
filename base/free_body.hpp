// A rigid body that belongs to no robot, as everybody is told of it. Its truth is the simulator's.
#pragma once
#include <cstdint>
#include <optional>

#include "base/config.hpp"
#include "base/spatial.hpp"

namespace mrroc {

/// Form of the body.
enum class FreeBodyShape : std::uint8_t { ball, box };

/// What is told of a body, which rests on a pedestal at the beginning.
struct FreeBodyDescription {
  FreeBodyShape shape{FreeBodyShape::ball};  ///< its form
  double size{0.2};                   ///< diameter of a ball, edge of a box, whose edges are all alike [m]
  double mass{0.5};                   ///< [kg]
  double friction{0.8};               ///< on rubber palms
  Vector3 pedestal{0.3, 1.05, 0.75};  ///< middle of the pedestal's upper side in the world [m]
};

/// Reads [free_body]: shape (none, ball, box), size, mass, friction, pedestal.
/// @return nothing: there is no such body
/// @throws ConfigError
[[nodiscard]] std::optional<FreeBodyDescription> read_free_body(const Config& config);

}  // namespace mrroc
