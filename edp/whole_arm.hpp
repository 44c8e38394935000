// The whole arm of edp/stability.hpp: from what a controller believes, and as a continuous plant.
#pragma once
#include <span>

#include "base/pose.hpp"
#include "base/spatial.hpp"
#include "edp/contact_map.hpp"
#include "edp/robot.hpp"
#include "edp/stability.hpp"

namespace mrroc::edp {

/// What else than its kernel is believed of an arm that touches something.
struct ArmBelief {
  AxisVector joints;   ///< where it touches [rad], track [m]
  Pose T_WE;           ///< tip E in the wrist
  Axis axis{Axis::z};  ///< of E along which law (28) presses: x, y or z
  /// Of what it touches, without friction, in E: along it the contact pushes [-]. Zero: that axis.
  Vector3 normal{Vector3::Zero()};
  AxisMatrix mass;    ///< mass matrix of links and tool at these joints, without rotors [kg m^2], track [kg]
  AxisVector rotors;  ///< inertia of what turns with each shaft without any link [kg m^2]
  double tool{};      ///< beyond the force sensor [kg]
  Vector3 tool_centre{Vector3::Zero()};  ///< its mass centre in the wrist [m]
};

/// @return that arm with its standard regulators, which must be those of algorithm 1
/// @throw FaultError out_of_limits  the arm has not six axes, or is singular there
[[nodiscard]] WholeArm whole_arm(const Robot& robot, const ArmBelief& belief);

/// Rigid gears: s = joints and their speeds; otherwise those of the links, then those of rotors, as joints.
/// @param K, D  stiffness and damping of the contact at the tip [N/m], [N s/m]
[[nodiscard]] TipPlant plant_of(const WholeArm& arm, const GearMode& gears, double K, double D);

}  // namespace mrroc::edp
