#include "sim/bullet/brakes.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

namespace mrroc::sim {
namespace {

constexpr int kBaseFreedoms = 6;  // a row begins with the base, which is fixed

}  // namespace

Brakes::Brakes(btMultiBody& body, const AxisVector& torque, double h)
    : btMultiBodyConstraint(&body, &body, 0, 0, static_cast<int>(torque.size()), false,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
      impulse_(torque * h) {}

void Brakes::close(const AxisMatrix& motors_per_joints) {
  motors_per_joints_ = motors_per_joints;
  closed_ = true;
}

void Brakes::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  m_numDofsFinalized = m_jacSizeBoth;
}

int Brakes::getIslandIdA() const {
  const auto* collider = m_bodyA->getLinkCollider(m_bodyA->getNumLinks() - 1);
  return collider ? collider->getIslandTag() : -1;
}

void Brakes::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                  const btContactSolverInfo& info) {
  if (!closed_) return;
  const btVector3 none(0, 0, 0);
  for (int motor = 0; motor < getNumRows(); ++motor) {
    for (int joint = 0; joint < impulse_.size(); ++joint)
      jacobianA(motor)[kBaseFreedoms + joint] = motors_per_joints_(motor, joint);
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    fillMultiBodyConstraint(row, data, jacobianA(motor), jacobianB(motor), none, none, none, none, 0, info,
                            -impulse_[motor], impulse_[motor]);
    row.m_orgConstraint = this;
    row.m_orgDofIndex = motor;
    // The row acts on joints only; no force of it appears at a link.
    row.m_contactNormal1 = row.m_contactNormal2 = none;
    row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
  }
}

}  // namespace mrroc::sim
