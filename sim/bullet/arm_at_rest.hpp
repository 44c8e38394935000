// What the gears of an arm feel of its body at rest.
#pragma once
#include "base/spatial.hpp"
#include "sim/bullet/arm_body.hpp"
#include "sim/elastic_gears.hpp"

namespace mrroc::sim {

/// @param arm  at rest; forces on its body are forgotten. What is beyond its joints, a wrist that gives way or jaws, is
///             taken as rigid
/// @param gravity  in the world [m/s^2]
[[nodiscard]] ArmAtRest arm_at_rest(const ArmBody& arm, const Vector3& gravity);

}  // namespace mrroc::sim
