// Reads a cube from a configuration.
#pragma once
#include "base/config.hpp"
#include "base/cube/cube.hpp"

namespace mrroc::cube {

/// @return the faces by their names, for Config::choice
[[nodiscard]] std::vector<std::pair<std::string_view, Face>> face_names();

/// Reads from [cube] one of state (54 facelets), scramble (turns such as "R U' F2") and random_turns, with the seed of
/// [cube] or of the run, and twist (of a corner in its place, in thirds of a turn: no turns lead to such a cube).
/// @throws ConfigError; FaultError bad_cube, bad_configuration: more than one is given
[[nodiscard]] Cube read_given_cube(const Config& config);

/// @return the seed of [cube], by default that of the run
[[nodiscard]] std::uint64_t read_cube_seed(const Config& config);

}  // namespace mrroc::cube
