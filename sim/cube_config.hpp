// Reads the sections [cube], [sim.cube] and [sim.pads] of a configuration.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// Reads robots.ARM.fingers (none, one_layer, two_layers), sim.robots.ARM.fingers if the arm really has others, [sim.pads],
/// and robots.ARM.jaws, the distance of the jaws at the beginning.
/// @param key  of the arm
/// @throws ConfigError
void read_fingers(const Config& config, const std::string& key, ArmParameters& arm);

/// Reads [cube], what everybody is told: held_by (name of an arm; without it there is no cube), facing (the face that points
/// away from that hand), one of state (54 facelets), scramble (turns such as "R U' F2") and random_turns; seed (of the random
/// turns and the faces' friction; by default that of the run), twist (of a corner in its place, in thirds of a turn: no turns
/// lead to such a cube). And [sim.cube], what it really is: friction of faces and stickers, edge, mass, place in the hand.
/// Its place_error is along and about the axes of the hand, through the cube's middle, not about those of the cube.
/// @param arms  names in the order of the simulator's arms
/// @return nothing: there is no cube
/// @throws ConfigError, FaultError bad_cube
std::optional<CubeParameters> read_cube(const Config& config, const std::vector<std::string>& arms);

}  // namespace mrroc::sim
