// Reads the section [cube] of a configuration.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// Reads robots.ARM.fingers (none, one_layer, two_layers), sim.robots.ARM.fingers if the arm really has others, and
/// robots.ARM.jaws, the distance of the jaws at the beginning.
/// @param key  of the arm
/// @throws ConfigError
void read_fingers(const Config& config, const std::string& key, ArmParameters& arm);

/// Reads [cube]: held_by (name of an arm; without it there is no cube), facing (the face that points away from that
/// hand), one of state (54 facelets), scramble (turns such as "R U' F2") and random_turns; seed (of the random turns and
/// the faces' friction; by default that of the run), breakaway, kinetic, jam [N m]. And what is wrong with it:
/// jam_direction (in which faces jam: both, clockwise, counterclockwise), jam_loosening, friction (of the stickers), offset (by which it
/// is elsewhere in the hand than it should be, along the axes of E [m]), twist (of a corner in its place, in thirds of a
/// turn: no turns lead to such a cube).
/// @param arms  names in the order of the simulator's arms
/// @return nothing: there is no cube
/// @throws ConfigError, FaultError bad_cube
std::optional<CubeParameters> read_cube(const Config& config, const std::vector<std::string>& arms);

}  // namespace mrroc::sim
