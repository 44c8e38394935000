// Shell of the simulator: exchanges readings and commands with the effector drivers, step by step.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "sim/camera/camera_station.hpp"
#include "sim/platform/platform_world.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// How the simulator belongs to its system.
struct ShellParameters {
  std::vector<std::string>
      robots;  ///< in the order of the simulator's arms: channels ROBOT.hardware_state, .hardware_command
  std::vector<std::string>
      drivers;  ///< names of their driver processes; empty: the robot is not simulated, and stands
  std::vector<std::string> platforms{};         ///< keys of the platforms, in their order: the same channels
  std::vector<std::string> platform_drivers{};  ///< names of their driver processes
  std::vector<std::string> boxes{};  ///< in the order of the world: channels NAME.motion_capture, NAME.truth
  double speed{0};                   ///< simulated seconds per second; 0: as fast as possible
  std::vector<Polyline> strokes;     ///< what the hand leads along [mm]
  HandTrack track{};                 ///< what it leads along through the air
  std::filesystem::path
      folder;  ///< where the inked sheets go: ROBOT-sheet-K.csv, and the steps before a fault
};

/// What is simulated. Everything outlives the simulator; null: there is none of it.
struct Simulated {
  World* arms{};               ///< arms with their cell
  PlatformWorld* platforms{};  ///< mobile platforms, beside them
  CameraStation* cameras{};    ///< that look at them
};

/// Runs the simulator until the task is over or the system ends. A robot without its driver's command brakes: at once in
/// lock-step, after ten steps by the wall clock.
void run_simulator(link::Process& process, const Simulated& simulated, const ShellParameters& parameters);

}  // namespace mrroc::sim
