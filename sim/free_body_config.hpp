// Reads a free body and the palms that touch it from a configuration.
#pragma once
#include <optional>
#include <string>

#include "base/config.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// Reads robots.ARM.palm, whether the tool ends in a palm, and [sim.palm]: width, friction, stiffness, relaxation.
/// @param key  of the arm
/// @throws ConfigError; FaultError bad_configuration: it has fingers, too
void read_palm(const Config& config, const std::string& key, ArmParameters& arm);

/// Reads [free_body], what is told of it (base/free_body.hpp), and [sim.free_body], what it really is: size, mass,
/// friction, offset (by which it stands elsewhere on the floor, with its pedestal).
/// @return nothing: there is none
/// @throws ConfigError
std::optional<FreeBodyParameters> read_true_body(const Config& config);

}  // namespace mrroc::sim
