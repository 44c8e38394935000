#include "robots/catalogue.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/representation.hpp"

namespace mrroc::robots {
namespace {

/// @return number of the name that a table chooses; 0 when there is no choice
int read_choice(const Config& table, const char* key, const std::vector<std::string_view>& names) {
  if (names.size() < 2) return 0;
  std::vector<std::pair<std::string_view, int>> choices;
  for (const std::string_view name : names) choices.emplace_back(name, static_cast<int>(choices.size()));
  return table.choice(key, 0, std::span(std::as_const(choices)));
}

}  // namespace

std::string driver_program(const RobotType& type) {
  return type.program.empty() ? "edp_" + std::string(type.name) : std::string(type.program);
}

AxisVector reflected_inertia(const edp::Robot& robot, std::span<const MotorParameters> motors,
                             const AxisVector& joints) {
  const AxisMatrix J = robot.motors_per_joints(joints);
  AxisVector inertia = AxisVector::Zero(robot.axes());
  for (int k = 0; k < robot.axes(); ++k)
    for (int m = 0; m < robot.axes(); ++m)
      inertia[k] += motors[static_cast<std::size_t>(m)].rotor_inertia * J(m, k) * J(m, k);
  return inertia;
}

const RobotType& read_type(const Config& config, const std::string& key,
                           std::span<const RobotType* const> types, std::string_view fallback) {
  std::vector<std::pair<std::string_view, const RobotType*>> choices;
  const RobotType* usual = types.front();
  for (const RobotType* type : types) {
    choices.emplace_back(type->name, type);
    if (type->name == fallback) usual = type;
  }
  return *config.section("robots." + key).choice("model", usual, std::span(std::as_const(choices)));
}

std::unique_ptr<edp::Robot> read_robot(const Config& config, const std::string& key, const RobotType& type) {
  const Config table = config.section("robots." + key);
  const int set = read_choice(table, "kinematics", type.parameter_sets);
  const int rule = read_choice(table, "track", type.track_rules);
  return type.make(set + rule * static_cast<int>(type.parameter_sets.size()));
}

Pose read_place(const Config& config, const std::string& key, const std::string& whose,
                const RobotType& type) {
  constexpr Bounds kBounds{-10, 10};
  std::array<double, 6> usual{};
  Eigen::Map<AngleAxisPose>(usual.data()) = angle_axis_from_pose(type.T_UB);
  const auto given =
      config.numbers<6>("robots." + key + ".place", usual, kBounds, "m, rad, of the base in the world");
  const std::string own = whose + ".robots." + key + ".place";
  const std::string unit = "m, rad; empty: as robots." + key + ".place";
  auto place = config.list(own, std::vector<double>{}, kBounds,
                           {unit, "base of the arm in the world", "robots.ARM.place"});
  if (place.empty()) place.assign(given.begin(), given.end());
  if (place.size() != usual.size())
    throw FaultError(FaultCode::bad_configuration,
                     own + ": six numbers, x y z and angle times axis, or none");
  // The usual place is not taken apart and put together again: its bits stay.
  if (std::ranges::equal(place, usual)) return type.T_UB;
  return pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(place.data()));
}

DriverSetup read_driver(const Config& config, const std::string& key, const RobotType& type,
                        const std::vector<double>& synchro_joints) {
  DriverSetup s;
  s.robot = read_robot(config, key, type);
  s.driver = read_driver(config, key, *s.robot, type.driver, synchro_joints);
  return s;
}

link::NodeMain driver_of(std::vector<const RobotType*> types) {
  return [types = std::move(types)](link::Process& process, const Config& config,
                                    const link::NodeArguments& arguments) {
    const RobotType& type = read_type(config, arguments.arm, types, types.front()->name);
    const DriverSetup setup = read_driver(config, arguments.arm, type, {});
    run_driver(process, config, arguments, *setup.robot, setup.driver, type.hardware);
  };
}

}  // namespace mrroc::robots
