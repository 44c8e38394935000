// One turn of a face of the cube by two driven arms, a cycle of the task's program, and what is measured of it.
#pragma once
#include <functional>

#include "base/cube/move.hpp"
#include "base/fault.hpp"
#include "tasks/rubik/coordinator.hpp"
#include "test/rig/cube_cell.hpp"
#include "test/rig/driven_cell.hpp"

namespace mrroc::rig {

/// Figures of a turn. "Lateral" are x, y and z of the holder while it turns.
struct TurnFigures {
  bool done{};                     ///< the cycle has come to its end
  int grips{};                     ///< attempts of the worker at the cube
  int attempts{};                  ///< at m = 5
  rubik::FailureReason failure{};  ///< why the cycle was broken off
  Fault fault{};                   ///< why an arm stopped
  bool turned{};                   ///< the face is where it should be, all others are where they were
  bool dropped{};                  ///< the cube is on the floor
  double approach_peak{};          ///< F_z of the worker in m = 1, 2, largest [N]
  double approach_settled{};       ///< the same, mean over the second half of m = 2 [N]
  double lateral_std{};            ///< largest of the three standard deviations [N]
  double steady_std{};             ///< the same from 0.5 s on: the 4 N of the approach have died away [N]
  double lateral_peak{};           ///< [N]
  double torque_peak{};            ///< about z [N m]
  double
      angle_error{};  ///< by which the face is behind the tool, largest between 45 degrees and its seat [rad]
  double slip{};      ///< of the cube in the holder's jaws, largest during the turn [m]
  double squeeze{};   ///< largest force of a pad or palm on the cube [N]
  double turn_s{};    ///< duration of m = 5 [s]
  double cycle_s{};   ///< of m = 1..6 [s]
};

/// The turn to be made.
struct TurnPlan {
  rubik::CubeCellParameters cell;  ///< the cell and the cube
  int quarters{1};                 ///< that the track arm's tool turns about its z: 1 or -1
  rubik::Parameters task;          ///< as it solves; `load` is found from the cell
  double timeout{120};             ///< longest cycle [s]
};

/// @return the turn of the face that the plan stands for, as seen by the cube
cube::Move move_of(const TurnPlan& plan);

/// @param seed   of the simulator's sensors
/// @param watch  called in every macrostep with the cell and the coordinator's behaviour; may be empty
/// @throws FaultError  a driver refused to start
TurnFigures turn_face(const TurnPlan& plan, std::uint64_t seed,
                      const std::function<void(DrivenCell&, int m)>& watch = {});

/// @return a plan with a face, a direction, friction and grasp errors (up to 1 mm and 1 degree) drawn from the seed
TurnPlan random_turn(std::uint64_t seed);

}  // namespace mrroc::rig
