// Shell of the simulator: exchanges readings and commands with the effector drivers, step by step.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "sim/camera/camera_station.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// How the simulator belongs to its system.
struct ShellParameters {
  std::vector<std::string>
      robots;  ///< in the order of the simulator's arms: channels ROBOT.hardware_state, .hardware_command
  std::vector<std::string>
      drivers;      ///< names of their driver processes; empty: the robot is not simulated, and stands
  double speed{0};  ///< simulated seconds per second; 0: as fast as possible
  std::vector<Polyline> strokes;  ///< what the hand leads along [mm]
  std::filesystem::path
      folder;  ///< where the inked sheets go: ROBOT-sheet-K.csv, and the steps before a fault
};

/// Runs the simulator until the task is over or the system ends.
/// @param cameras  null: there are none
void run_simulator(link::Process& process, World& world, const ShellParameters& parameters,
                   CameraStation* cameras = nullptr);

}  // namespace mrroc::sim
