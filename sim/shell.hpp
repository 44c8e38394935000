// Shell of the simulated world: exchanges readings and commands with the effector drivers, step by step.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "sim/camera/camera_station.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// How the world belongs to its system.
struct ShellParameters {
  std::vector<std::string> robots;   ///< in the order of the world's arms: channel ROBOT.drive
  std::vector<std::string> drivers;  ///< names of their driver processes
  int n_s{10};                       ///< steps of a macrostep
  double speed{0};                   ///< simulated seconds per second; 0: as fast as possible
  std::vector<Polyline> strokes;     ///< what the hand leads along [mm]
  std::filesystem::path
      folder;  ///< where the inked sheets go: ROBOT-sheet-K.csv, and the steps before a fault
};

/// Runs the world until the task is over or the system ends.
/// @param cameras  null: there are none
void run_world(link::Process& process, World& world, const ShellParameters& parameters,
               CameraStation* cameras = nullptr);

}  // namespace mrroc::sim
