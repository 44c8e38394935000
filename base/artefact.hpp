// An artefact to calibrate a cell by: balls that stand still, as everybody is told of them. Their truth is the simulator's.
#pragma once
#include <optional>
#include <vector>

#include "base/config.hpp"
#include "base/pose.hpp"

namespace mrroc {

/// What is told of the balls. Where they stand need be known only as well as a tool finds them.
struct ArtefactDescription {
  std::vector<Vector3> balls;  ///< their middles in the artefact's frame A [m], at least one
  double diameter{0.06};       ///< of each of them [m]
  Pose T_UA;                   ///< the artefact in the world
};

/// Reads [artefact]: balls, diameter, place.
/// @return nothing: there is no artefact
/// @throws ConfigError; FaultError bad_configuration: artefact.balls is not a list of x, y, z
[[nodiscard]] std::optional<ArtefactDescription> read_artefact(const Config& config);

}  // namespace mrroc
