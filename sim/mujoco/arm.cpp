#include "sim/mujoco/arm.hpp"

#include <algorithm>
#include <utility>

#include "sim/mujoco/convert.hpp"

namespace mrroc::sim {

MujocoArm::MujocoArm(ArmInModel arm, mjModel& model, mjData& data, const std::vector<MotorParameters>& motors)
    : arm_(std::move(arm)), model_(model), data_(data) {
  for (const MotorParameters& motor : motors) brake_torques_.push_back(motor.brake_torque);
  update_motion();
}

void MujocoArm::close_brakes(const AxisMatrix& motors_per_joints) {
  for (int motor = 0; motor < arm_.joints; ++motor) {
    const int shaft = arm_.brake + motor;
    for (int joint = 0; joint < arm_.joints; ++joint)
      model_.wrap_prm[model_.tendon_adr[shaft] + joint] = motors_per_joints(motor, joint);
    model_.tendon_frictionloss[shaft] = brake_torques_[static_cast<std::size_t>(motor)];
  }
}

void MujocoArm::open_brakes() { std::fill_n(model_.tendon_frictionloss + arm_.brake, arm_.joints, 0); }

void MujocoArm::push_tip(const Vector3& force) {
  mjtNum* const at_centre = data_.xfrc_applied + 6 * arm_.tool;
  Vector3::Map(at_centre) += force;
  Vector3::Map(at_centre + 3) += (motion_.T_UG.R * arm_.T_GE.p).cross(force);
}

void MujocoArm::take_over() {
  sum_contacts();
  std::fill_n(data_.qfrc_applied + arm_.joint, arm_.joints, 0);
  std::fill_n(data_.xfrc_applied + 6 * arm_.tool, 6, 0);
}

void MujocoArm::sum_contacts() {
  contact_force_.setZero();
  for (int k = 0; k < data_.ncon; ++k) {
    const mjContact& contact = data_.contact[k];
    const bool first = contact.geom[0] == arm_.pen;
    if (!first && contact.geom[1] != arm_.pen) continue;
    mjtNum force
        [6];  // along the axes of the contact: the normal, from the first shape to the second, then two tangents
    mj_contactForce(&model_, &data_, k, force);
    for (int axis = 0; axis < 3; ++axis)
      contact_force_ += (first ? -force[axis] : force[axis]) * Vector3::Map(contact.frame + 3 * axis);
  }
}

void MujocoArm::update_motion() {
  motion_.T_UG = pose_from(data_.xipos + 3 * arm_.tool, data_.ximat + 9 * arm_.tool);
  mjtNum velocity[6];  // angular, then that of the mass centre
  mj_objectVelocity(&model_, &data_, mjOBJ_BODY, arm_.tool, velocity, 0);
  motion_.angular_velocity = Vector3::Map(velocity);
  motion_.velocity = Vector3::Map(velocity + 3);
}

Wrench MujocoArm::follow(const Vector3& /*tip_force*/) {
  update_motion();
  // MuJoCo tells what the arm exerts on the tool, in the axes of the sensor.
  const mjtNum* const exerted = data_.sensordata + arm_.force;
  return Wrench::from(-Vector3::Map(exerted), -Vector3::Map(exerted + 3));
}

ArmAtRest MujocoArm::at_rest() {
  mj_fwdPosition(&model_, &data_);  // masses belong to the present joints from here on
  mj_fwdVelocity(&model_, &data_);
  std::vector<mjtNum> all(static_cast<std::size_t>(model_.nv) * static_cast<std::size_t>(model_.nv));
  mj_fullM(&model_, all.data(), data_.qM);
  ArmAtRest rest;
  rest.joints = Eigen::Map<const Eigen::VectorXd>(data_.qpos + arm_.joint, arm_.joints);
  rest.mass = Eigen::Map<const Eigen::MatrixXd>(all.data(), model_.nv, model_.nv)
                  .block(arm_.joint, arm_.joint, arm_.joints, arm_.joints);
  rest.holding = Eigen::Map<const Eigen::VectorXd>(data_.qfrc_bias + arm_.joint, arm_.joints);
  return rest;
}

Wrench MujocoArm::weight() const {
  const Vector3 force(0, 0, -kGravity * model_.body_mass[arm_.tool]);
  return xi_F(arm_.T_GS.inverse(), Wrench::from(motion_.T_UG.R.transpose() * force, Vector3::Zero()));
}

Pose MujocoArm::link(int index) const {
  const int body = arm_.links[static_cast<std::size_t>(index)];
  return pose_from(data_.xipos + 3 * body, data_.ximat + 9 * body);
}

}  // namespace mrroc::sim
