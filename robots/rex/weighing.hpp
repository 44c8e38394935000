// Mass and mass centre of Rex, weighed with the load cells of its wheels (paper REX: proprioceptors F_ij,k).
#pragma once
#include "robots/rex/model.hpp"

namespace mrroc::rex {

/// Weighs a platform that stands still on level ground. What it carries is found in the sum of the forces and in how the
/// axles and the sides share it.
/// @param load  means of the load cells [N]
/// @return mass, its centre and what each wheel carries; the empty platform when the cells tell what no platform is: a
///         number that is not finite, a negative force, less than half or more than four times the mass that was built, or
///         the centre further than half the way to the wheels. Real-time safe
[[nodiscard]] Load weigh(const PerWheel& load) noexcept;

}  // namespace mrroc::rex
