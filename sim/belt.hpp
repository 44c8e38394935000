// The belt of a conveyor as a box that moves with the tool of its description.
#pragma once
#include "base/axes.hpp"
#include "base/pose.hpp"
#include "edp/robot.hpp"
#include "robots/catalogue.hpp"

namespace mrroc::sim {

/// @return edges of the box [m]; it is as thick as a table
[[nodiscard]] inline Vector3 belt_size(const robots::Belt& belt) {
  constexpr double kThickness = 0.05;  // [m]
  return {belt.width, belt.length, kThickness};
}

/// @param type  with a belt @param robot  of that type
/// @return middle of the box in E of the conveyor
[[nodiscard]] inline Pose belt_in_effector(const robots::RobotType& type, const edp::Robot& robot) {
  const Pose T_0_box{Matrix3::Identity(),
                     type.belt->middle - belt_size(*type.belt).z() / 2 * Vector3::UnitZ()};
  const Pose T_0E = robot.forward(AxisVector::Zero(robot.axes())) * type.driver.T_WE;
  return T_0E.inverse() * T_0_box;
}

}  // namespace mrroc::sim
