// What the task must know of robots and cells: what stands where, what the operator's hand is like, and whether both tools reach.
#pragma once
#include "base/config.hpp"
#include "edp/pair_stability.hpp"
#include "tasks/haptic/hand_way.hpp"

namespace mrroc::haptic {

/// @param config  of a run @return both cells
/// @throws ConfigError, FaultError bad_configuration  the slave has no plate to meet
[[nodiscard]] Scene read_scene(const Config& config);

/// Refuses a way that one of the tools does not reach with the orientation that it has at the beginning.
/// @throws FaultError bad_configuration
void check_reach(const Config& config, const Scene& scene, const Law& law,
                 const std::vector<mp::WayPoint>& way);

/// @return what edp/pair_stability.hpp has to know of a pair, with servos of 20 Hz
[[nodiscard]] edp::PairLoop pair_loop(const Scene& scene, const Law& law);

/// @return whether forces have to grow gently, see Law::grows_gently
[[nodiscard]] bool grows_gently(const Scene& scene, const Law& law);

/// Refuses a wall on which the slave would swing by itself, and, without passivity control, one that the pair does not bear.
/// @throws FaultError bad_configuration
void check_stability(const Scene& scene, const Law& law);

}  // namespace mrroc::haptic
