#include "sim/bullet/tool_load.hpp"

#include "sim/bullet/convert.hpp"

namespace mrroc::sim {

ToolLoad::ToolLoad(const ArmBody& arm, const Vector3& gravity, double h)
    : arm_(arm), gravity_(gravity), h_(h), jaw_count_(arm.body->getNumLinks() - arm.tool - 1) {
  turning_.resize(arm.body->getNumLinks() + 1);
  moving_.resize(arm.body->getNumLinks() + 1);
  reset();
}

void ToolLoad::reset() {
  contact_force_.setZero();
  update_motion();
}

void ToolLoad::update_motion() {
  // Bullet computes the poses of links at the beginning of a step; here they are wanted after it.
  arm_.body->forwardKinematics(rotations_, origins_);
  arm_.body->compTreeLinkVelocities(&turning_[0], &moving_[0]);
  motion_.T_UG = link_pose(*arm_.body, arm_.tool);
  motion_.velocity = motion_.T_UG.R * from_bullet(moving_[arm_.tool + 1]);
  motion_.angular_velocity = motion_.T_UG.R * from_bullet(turning_[arm_.tool + 1]);
  for (std::size_t k = 0; k < jaw_count_; ++k) {
    const int link = arm_.tool + 1 + static_cast<int>(k);
    const Pose T_UJ = link_pose(*arm_.body, link);
    const auto& jaw = arm_.body->getLink(link);
    jaws_[k].centre = T_UJ.p;
    jaws_[k].momentum = jaw.m_mass * (T_UJ.R * from_bullet(moving_[link + 1]));
    jaws_[k].spin = T_UJ.R * from_bullet(jaw.m_inertiaLocal).cwiseProduct(from_bullet(turning_[link + 1]));
  }
}

Vector3 ToolLoad::spin() const {
  const Vector3 inertia = from_bullet(arm_.body->getLink(arm_.tool).m_inertiaLocal);
  return motion_.T_UG.R * inertia.cwiseProduct(motion_.T_UG.R.transpose() * motion_.angular_velocity);
}

Wrench ToolLoad::weight() const {
  const Pose& T_UG = motion_.T_UG;
  Vector3 force = arm_.body->getLink(arm_.tool).m_mass * gravity_;
  Vector3 moment = Vector3::Zero();
  for (std::size_t k = 0; k < jaw_count_; ++k) {
    const Vector3 jaw = arm_.body->getLink(arm_.tool + 1 + static_cast<int>(k)).m_mass * gravity_;
    force += jaw;
    moment += (jaws_[k].centre - T_UG.p).cross(jaw);
  }
  return xi_F(arm_.T_GS.inverse(), Wrench::from(T_UG.R.transpose() * force, T_UG.R.transpose() * moment));
}

Wrench ToolLoad::step(const Vector3& tip_force) {
  const btMultibodyLink& link = arm_.body->getLink(arm_.tool);
  const Pose T_UG = motion_.T_UG;  // where the forces acted
  const Vector3 velocity = motion_.velocity;
  const Vector3 spin_before = spin();
  const auto jaws = jaws_;
  update_motion();

  contact_force_ = from_bullet(link.m_appliedConstraintForce);
  const Vector3 others = link.m_mass * gravity_ + contact_force_ + tip_force;
  Vector3 force = others - link.m_mass * (motion_.velocity - velocity) / h_;
  // About the mass centre: gravity has no moment.
  Vector3 moment = from_bullet(link.m_appliedConstraintTorque) + (T_UG.R * arm_.T_GE.p).cross(tip_force) -
                   (spin() - spin_before) / h_;
  for (std::size_t k = 0; k < jaw_count_; ++k) {
    const btMultibodyLink& jaw = arm_.body->getLink(arm_.tool + 1 + static_cast<int>(k));
    const Vector3 lost = jaw.m_mass * gravity_ + from_bullet(jaw.m_appliedConstraintForce) -
                         (jaws_[k].momentum - jaws[k].momentum) / h_;
    force += lost;
    moment += (jaws[k].centre - T_UG.p).cross(lost) + from_bullet(jaw.m_appliedConstraintTorque) -
              (jaws_[k].spin - jaws[k].spin) / h_;
  }
  return xi_F(arm_.T_GS.inverse(), Wrench::from(T_UG.R.transpose() * force, T_UG.R.transpose() * moment));
}

}  // namespace mrroc::sim
