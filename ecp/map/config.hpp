// What a map agent reads from the configuration.
#pragma once
#include "base/config.hpp"
#include "ecp/map/map_agent.hpp"

namespace mrroc::ecp {

/// @return [map] and [motion_capture] of a_3
/// @throws ConfigError; FaultError bad_configuration: readings come less often than its timeout
[[nodiscard]] MapParameters read_map(const Config& config);

}  // namespace mrroc::ecp
