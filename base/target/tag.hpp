// The tag that the cameras look for; its family, number and size are defined only here.
#pragma once
#include <array>

#include "base/spatial.hpp"

namespace mrroc {

/// A tag of the family 36h11: a black border around a code, with a light margin around it.
struct Tag {
  int id{0};             ///< 0..586
  double edge{0.1};      ///< of the black border, outside [m]
  double margin{0.025};  ///< width of the light margin [m]: two cells, as a shadow on it hides the tag

  /// @return corners of the black border in G [m]: lower left, lower right, upper right, upper left. G lies in the
  ///         middle of the tag: x to the right, y up, z out of the tag toward the camera.
  [[nodiscard]] std::array<Vector3, 4> corners() const {
    const double h = 0.5 * edge;
    return {Vector3(-h, -h, 0), Vector3(h, -h, 0), Vector3(h, h, 0), Vector3(-h, h, 0)};
  }
};

/// The tag of the framework's tasks.
inline constexpr Tag kTag{};

}  // namespace mrroc
