// What the task must know of robots and cells: what stands where, what the operator's hand is like, and whether both tools reach.
#pragma once
#include "base/config.hpp"
#include "edp/pair_stability.hpp"
#include "tasks/haptic/hand_way.hpp"

namespace mrroc::haptic {

/// What the law has been told of what the arms meet.
struct Surroundings {
  double stiffness{1e4};       ///< of what the slave meets [N/m]
  double damping{0.002};       ///< of the same, per stiffness [s]
  double hand_stiffness{800};  ///< of a hand with its grip [N/m]
  double hand_damping{30};     ///< of a hand [N s/m]
};

/// @return [table], and task.hand_stiffness, task.hand_damping @throws ConfigError
[[nodiscard]] Surroundings read_surroundings(const Config& config);

/// @param config  of a run @return both cells as the operator sees them
/// @throws ConfigError, FaultError bad_configuration  the slave has no plate to meet
[[nodiscard]] Scene read_scene(const Config& config);

/// Refuses a way that one of the tools does not reach with the orientation that it has at the beginning.
/// @throws FaultError bad_configuration
void check_reach(const Config& config, const Scene& scene, const Law& law,
                 const std::vector<mp::WayPoint>& way);

/// @return what edp/pair_stability.hpp has to know of a pair, with servos of 20 Hz
[[nodiscard]] edp::PairLoop pair_loop(const Surroundings& around, const Law& law);

/// @return whether forces have to grow gently, see Law::grows_gently
[[nodiscard]] bool grows_gently(const Surroundings& around, const Law& law);

/// Refuses a wall on which the slave would swing by itself, and, without passivity control, one that the pair does not bear.
/// @throws FaultError bad_configuration
void check_stability(const Surroundings& around, const Law& law);

}  // namespace mrroc::haptic
