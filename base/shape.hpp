// Simple solids, for pictures and for the detection of collisions.
#pragma once
#include <cstdint>

namespace mrroc {

/// Solids have their origin in the middle; a cylinder stands along z; a quad is the upper side (z > 0) of its xy
/// plane and cannot be seen from below.
enum class Shape : std::uint8_t { box, cylinder, sphere, quad };

}  // namespace mrroc
