#include "sim/bullet/tool_load.hpp"

#include "sim/bullet/convert.hpp"

namespace mrroc::sim {

ToolLoad::ToolLoad(const ArmBody& arm, const Vector3& gravity, double h)
    : arm_(arm), gravity_(gravity), h_(h) {
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
}

Vector3 ToolLoad::spin() const {
  const Vector3 inertia = from_bullet(arm_.body->getLink(arm_.tool).m_inertiaLocal);
  return motion_.T_UG.R * inertia.cwiseProduct(motion_.T_UG.R.transpose() * motion_.angular_velocity);
}

Wrench ToolLoad::step(const Vector3& tip_force) {
  const btMultibodyLink& link = arm_.body->getLink(arm_.tool);
  const Pose T_UG = motion_.T_UG;  // where the forces acted
  const Vector3 velocity = motion_.velocity;
  const Vector3 spin_before = spin();
  update_motion();

  contact_force_ = from_bullet(link.m_appliedConstraintForce);
  const Vector3 others = link.m_mass * gravity_ + contact_force_ + tip_force;
  const Vector3 force = others - link.m_mass * (motion_.velocity - velocity) / h_;
  // About the mass centre: gravity has no moment.
  const Vector3 moment = from_bullet(link.m_appliedConstraintTorque) +
                         (T_UG.R * arm_.T_GE.p).cross(tip_force) - (spin() - spin_before) / h_;
  return xi_F(arm_.T_GS.inverse(), Wrench::from(T_UG.R.transpose() * force, T_UG.R.transpose() * moment));
}

}  // namespace mrroc::sim
