// The planner's belief about the cell: configuration of its own, which the simulator does not read. The truth
// is in [sim], [cube] and the rest of [robots.ARM].
#pragma once
#include <array>
#include <optional>
#include <vector>

#include "base/config.hpp"
#include "base/cube/fingers.hpp"
#include "robots/catalogue.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// One arm of the cell.
struct ArmBelief {
  const robots::RobotType* type{};  ///< not null; lives on
  int model{};                      ///< number of the kinematic model, that of the driver
  Pose T_UB;                        ///< its base in the world
  GripperShape gripper;             ///< what can meet the cube and the other hand
  AxisVector start;                 ///< joints at the beginning [rad, track m]; empty: not known
};

/// The whole cell.
struct CellBelief {
  std::array<ArmBelief, 2> arms;  ///< by index(Hand)
  /// Middle of a table's top in the base of its arm, z up.
  Pose T_0P{(Matrix3() << 0, 1, 0, -1, 0, 0, 0, 0, 1).finished(), {0.90, 0, 0.92}};
  Grasp grasp;                ///< with which the cube is held at the beginning
  std::optional<Cube> known;  ///< its state, for a task that is told it
};

/// @return the cell as it usually is: both IRb-6 arms with their usual bases and fingers, the track arm with the cube
[[nodiscard]] CellBelief usual_cell();

/// Reads from [cell] robots.ARM.place, robots.ARM.fingers, table.distance, table.height, cube.held_by, cube.facing,
/// cube.state and cube.scramble. What they leave open is believed as [robots.ARM] place and fingers and as [cube] give
/// it; kinematics and start joints are those of [robots.ARM].
/// @throws ConfigError; FaultError bad_configuration: the cube is not held by the track arm, or an arm has no fingers
[[nodiscard]] CellBelief read_belief(const Config& config);

/// @param retreat  distance of the empty hand's palm from the cube [m]
/// @return joints of both arms at the meeting place [rad, track m]
/// @throws std::invalid_argument  the arms do not reach each other
[[nodiscard]] std::array<AxisVector, 2> joints_at_meeting(const CellBelief& cell, double retreat);

}  // namespace mrroc::rubik
