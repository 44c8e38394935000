// Prepares the effector before the task begins.
#pragma once
#include <functional>
#include <type_traits>

#include "base/config.hpp"
#include "ecp/effector_links.hpp"

namespace mrroc::ecp {

/// Set in an arm's driver before the task: SYNCHRO, then ROBOT_MODEL with its force bias at standstill.
struct Preparation {
  bool by_program{};            ///< nothing is set: the program does all of it itself
  RobotModel model{};           ///< tool and force tool
  int settling_macrosteps{50};  ///< at rest after SYNCHRO before the force sensor is biased
};

/// A platform's driver: SYNCHRO, which ends when it knows where the platform is.
struct PlatformPreparation {
  /// Fills in what is not numbered in a command, such as the position that SYNCHRO waits for; called before each is sent.
  /// Empty: nothing.
  std::function<void(PlatformCommand&)> renew{};
};

/// The preparation of a kind of effector.
template <Effector E>
using PreparationOf = std::conditional_t<std::is_same_v<E, ArmEffector>, Preparation, PlatformPreparation>;

/// @return tool and force tool, from [robots.ARM.tool]: pose (angle-axis), weight, mass_centre; all required
/// @throws ConfigError
RobotModel read_tool_model(const Config& config, const std::string& arm);

/// Brings the driver into the state ready.
/// @return terminated when ready; aborted when the system stops; faulted when the driver refused, see
/// fault_of()
Outcome prepare_effector(ArmLinks& links, const Preparation& prepare);
Outcome prepare_effector(PlatformLinks& links, const PlatformPreparation& prepare);

/// @return the reason of the outcome faulted: the link's fault or the driver's refusal
template <Effector E>
[[nodiscard]] Fault fault_of(const EffectorLinks<E>& links) {
  return links.client().fault() ? *links.client().fault() : links.reply().fault;
}

}  // namespace mrroc::ecp
