#include "tasks/calibrate_cell/cell/believed_arm.hpp"

#include "edp/guard.hpp"

namespace mrroc::calibrate_cell {

AxisVector BelievedArm::usual_joints() const {
  return Eigen::Map<const Eigen::VectorXd>(type->start.data(), static_cast<Eigen::Index>(type->start.size()));
}

BelievedArm read_arm(const Config& config, std::size_t arm) {
  BelievedArm a;
  a.type = &robots::read_type(config, kKeys.at(arm), robots::catalogue(), kModels.at(arm));
  a.robot = robots::read_robot(config, kKeys.at(arm), *a.type);
  a.T_WE = a.type->driver.T_WE;
  const Bases bases = believed_bases(config);
  a.T_UB = bases.at(arm);
  Vector3 line = bases.at(1 - arm).p - bases.at(arm).p;
  line.z() = 0;
  a.R_UE.col(0) = Vector3::UnitZ();
  a.R_UE.col(2) = line.normalized();
  a.R_UE.col(1) = a.R_UE.col(2).cross(a.R_UE.col(0));
  return a;
}

Reach reach(const BelievedArm& a, const Pose& T_UE, const AxisVector& near) {
  const edp::InverseSolution s = a.robot->inverse(a.T_UB.inverse() * T_UE * a.T_WE.inverse(), near);
  if (!s.reached) return {{}, "it does not reach that"};
  const edp::AxisPositions to{s.joints, a.robot->motors_from_joints(s.joints)};
  const edp::AxisPositions from{near, a.robot->motors_from_joints(near)};
  if (const auto fault = edp::check_range(*a.robot, from, to, 0)) return {{}, describe(*fault)};
  return {s.joints, {}};
}

}  // namespace mrroc::calibrate_cell
