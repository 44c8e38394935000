// What the task reads of its configuration.
#pragma once
#include <string_view>

#include "base/config.hpp"
#include "tasks/haptic/haptic.hpp"

namespace mrroc::haptic {

/// @return the task's TOML file
std::string_view config();

/// @return gains, channel and passivity, from [task], with the seed of the run
/// @throws ConfigError  out of range  @throws FaultError bad_configuration  what cannot go together
Parameters read_parameters(const Config& config);

/// What a simulated operator does.
struct OperatorPlan {
  double speed{0.04};                           ///< of his hand through the air [m/s]
  double touch{0.02};                           ///< towards what the slave will meet [m/s]
  double push{12};                              ///< that he wants to feel [N]
  double circle{0.03};                          ///< radius of the circle that he leads through the air [m]
  double hold{2};                               ///< for which he pushes [s]
  double slave_mobility{Law{}.slave.mobility};  ///< that he expects of the slave [s/kg] ...
  double return_rate{Law{}.return_rate};  ///< ... with this [1/s]: how far beyond a surface he has to go
};

/// @param law  that he expects unless [operator] says otherwise
/// @return from [operator] @throws ConfigError
OperatorPlan read_operator(const Config& config, const Law& law);

}  // namespace mrroc::haptic
