#include "sim/start_joints.hpp"

#include <stdexcept>
#include <string>

namespace mrroc::sim {
namespace {

AxisVector of_robot(const edp::Robot& robot, const std::vector<double>& joints) {
  if (static_cast<int>(joints.size()) != robot.axes())
    throw std::invalid_argument("world: " + std::string(robot.name()) + " starts with one joint per axis");
  return Eigen::Map<const Eigen::VectorXd>(joints.data(), robot.axes());
}

/// The tool stands upright above the middle of the sheet.
AxisVector above_sheet(const edp::Robot& robot, const ArmParameters& arm) {
  const Pose& T_0P = arm.start_belief ? arm.start_belief->T_0P : arm.paper.T_0P;
  const Vector3 tip = T_0P * Vector3(0, 0, arm.start_height);
  const Pose T_0E{Eigen::DiagonalMatrix<double, 3>(1, -1, -1), tip};
  const auto solution =
      robot.inverse(T_0E * arm.type->driver.T_WE.inverse(), of_robot(robot, arm.type->start));
  if (!solution.reached)
    throw std::invalid_argument("world: " + std::string(robot.name()) + " does not reach the sheet");
  return solution.joints;
}

}  // namespace

AxisVector start_joints(const ArmParameters& arm) {
  const auto robot = arm.type->make(arm.start_belief ? arm.start_belief->model : arm.model);
  if (!arm.start.empty()) return of_robot(*robot, arm.start);
  return arm.type->starts_above_sheet ? above_sheet(*robot, arm) : of_robot(*robot, arm.type->start);
}

}  // namespace mrroc::sim
