// The simulator's part of the configuration.
#pragma once
#include "base/config.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// @return the parameters in [sim] and [robots.ARM]; arms as [robots] order says. Without [robots.ARM] model the arms are
///         those of the catalogue, in its order; those beyond it are of its last type.
/// @throws ConfigError
WorldParameters read_world(const Config& config);

}  // namespace mrroc::sim
