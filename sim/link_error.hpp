// By how much the links of an arm are otherwise than the robot's description says.
#pragma once
#include <string>
#include <vector>

#include "base/spatial.hpp"
#include "robots/catalogue.hpp"

namespace mrroc::sim {

/// Error of one link that moves, or of the tool.
struct LinkError {
  std::string link{};    ///< its name in the description
  double mass_scale{1};  ///< true mass, and inertia, over the described one, > 0
  Vector3 mass_centre_error{
      Vector3::Zero()};  ///< true mass centre less the described one, in the link's frame [m]
  double
      zero_error{};  ///< true position of its joint less the one that its encoder is taken for [rad], slider [m]
  Vector3 tip_error{Vector3::Zero()};  ///< of the tool only: the same as the centre's of its tip, in W [m]
  Vector3 tip_turn{Vector3::Zero()};   ///< of the tool only: its tip is turned about these axes of W [rad]
};

/// @return the links of a robot that have a mass, from the base on; the last one is the tool
/// @throws std::invalid_argument  its description is none
[[nodiscard]] std::vector<std::string> link_names(const robots::RobotType& type);

}  // namespace mrroc::sim
