// The robots that drivers, tasks and the simulator know. The build makes the list from what `mrroc_robot` in
// robots/NAME/CMakeLists.txt has registered (cmake/functions.cmake).
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "robots/driver_config.hpp"
#include "robots/hardware_kind.hpp"
#include "robots/motor.hpp"

namespace mrroc::robots {

/// Distance from a joint of the description to the one before it.
struct LinkLength {
  std::string_view joint;  ///< name in the URDF
  double length{};         ///< [m]
};

/// A belt that moves with the tool of a robot, and carries the sheets of all arms.
struct Belt {
  Vector3 middle =
      Vector3::Zero();  ///< of its top in the base, with the joints at zero [m]; the top is level
  double width{};       ///< along x of the base [m]
  double length{};      ///< along y [m]
};

/// Data of a robot and of its plant.
struct RobotType {
  std::string_view name;     ///< as in [robots.ARM] model
  std::string_view program;  ///< of its driver; empty: edp_NAME
  /// @param model  number of the kinematic model, 0 to models() - 1
  /// @return the kernel of an arm of this type, which has that model; never null
  std::unique_ptr<edp::Robot> (*make)(int model){};
  /// Names of its sets of lengths and zero positions, for [robots.ARM] kinematics; fewer than two: the key is not read.
  std::vector<std::string_view> parameter_sets;
  /// Names of its rules for the redundant axis, for [robots.ARM] track; fewer than two: the key is not read. The kinematic
  /// model of set k with rule r has the number k + r * parameter_sets.size().
  std::vector<std::string_view> track_rules;
  DriverDefaults driver;  ///< sensor, tool, limits
  std::string_view urdf;  ///< for the simulator: serial chain, ends in "sensor", "tool", "pen_tip" as
                          ///< robots/irb6/irb6_postument.urdf does; no products of inertia
  /// @return lengths that a kinematic model has instead of those of the description; null: all have those
  std::vector<LinkLength> (*lengths)(int model){};
  std::vector<MotorParameters> motors;  ///< of the simulator, one per axis
  std::vector<HardwareKind> hardware;   ///< of its own, beside robots::common_hardware(); hardware.cpp
  /// @param motors  one per axis @param joints [rad, track m]
  /// @return inertia of the rotors as felt at the joints [kg m^2], track: [kg]; null: reflected_inertia()
  AxisVector (*rotor_inertia)(const edp::Robot& robot, std::span<const MotorParameters> motors,
                              const AxisVector& joints){};
  Pose T_UB;                  ///< its base in the world, unless the configuration places it
  std::vector<double> start;  ///< joints at the beginning of a simulation [rad, track m]
  /// At the beginning the tool stands upright above the middle of the sheet instead, in the branch of `start`.
  bool starts_above_sheet{};
  std::optional<Belt> belt;  ///< none: the robot is no conveyor
};

/// Content of the table [robots.ARM].
struct DriverSetup {
  std::unique_ptr<edp::Robot> robot;  ///< never null
  edp::DriverParameters driver;       ///< for the driver of this robot
};

/// @return every robot, in the order of their registration; they live to the end of the program
[[nodiscard]] std::span<const RobotType* const> catalogue();

/// @return the robot with that name, or null
[[nodiscard]] inline const RobotType* find(std::string_view name) {
  for (const RobotType* type : catalogue())
    if (type->name == name) return type;
  return nullptr;
}

/// @return the program that is the driver of this type
[[nodiscard]] std::string driver_program(const RobotType& type);

/// @return inertia of rotors behind their gears, as felt at the joints [kg m^2], track: [kg]; products between the joints
///         are neglected
/// @param motors  one per axis @param joints  [rad, track m]
[[nodiscard]] AxisVector reflected_inertia(const edp::Robot& robot, std::span<const MotorParameters> motors,
                                           const AxisVector& joints);

/// @param key       of the arm, e.g. "arm1"
/// @param types     that are allowed
/// @param fallback  name of one of them, when [robots.ARM] model is not given
/// @throws ConfigError  the model is none of them
[[nodiscard]] const RobotType& read_type(const Config& config, const std::string& key,
                                         std::span<const RobotType* const> types, std::string_view fallback);

/// @param key  of the arm
/// @return the robot with the kinematic model that its driver believes, from [robots.ARM]
/// @throws ConfigError
[[nodiscard]] std::unique_ptr<edp::Robot> read_robot(const Config& config, const std::string& key,
                                                     const RobotType& type);

/// @param key    of the arm
/// @param whose  "sim": where it really stands, "cell": where a planner believes it
/// @return its base in the world: WHOSE.robots.ARM.place if given, else robots.ARM.place, by default that of the type
/// @throws ConfigError; FaultError bad_configuration: neither six numbers nor none
[[nodiscard]] Pose read_place(const Config& config, const std::string& key, const std::string& whose,
                              const RobotType& type);

/// @param key             of the arm
/// @param synchro_joints  as in read_driver() of robots/driver_config.hpp
/// @throws ConfigError
[[nodiscard]] DriverSetup read_driver(const Config& config, const std::string& key, const RobotType& type,
                                      const std::vector<double>& synchro_joints);

/// @return the effector driver process of an arm of one of these types, for the main of its program.
/// @param types  live on; the first one is the fallback of [robots.ARM] model
[[nodiscard]] link::NodeMain driver_of(std::vector<const RobotType*> types);

}  // namespace mrroc::robots
