// The simulated platforms' part of the configuration.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "robots/platforms.hpp"
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// @param keys   of the platforms, one or two
/// @param types  that there are
/// @return the parameters in [sim.platforms.KEY], [sim.boxes.NAME], [sim.ground], [motion_capture] and [room]; a platform is that of its type
///         unless they say something else
/// @throws ConfigError; FaultError bad_configuration: too many platforms, or parameters that make no sense together
[[nodiscard]] PlatformWorldParameters read_platform_world(const Config& config,
                                                          const std::vector<std::string>& keys,
                                                          std::span<const robots::PlatformType* const> types);

}  // namespace mrroc::sim
