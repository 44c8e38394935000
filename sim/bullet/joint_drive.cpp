#include "sim/bullet/joint_drive.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

namespace mrroc::sim {
namespace {

constexpr int kBaseFreedoms = 6;  // a row begins with those of the base

}  // namespace

JointDrives::JointDrives(btMultiBody& body, int first, double h)
    : btMultiBodyConstraint(&body, &body, first, first, kJoints, false,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
      first_(first),
      h_(h) {}

void JointDrives::drive(int joint, double speed, double lower, double upper) {
  speed_[static_cast<std::size_t>(joint)] = speed;
  lower_[static_cast<std::size_t>(joint)] = lower * h_;
  upper_[static_cast<std::size_t>(joint)] = upper * h_;
}

double JointDrives::given(int joint) { return getAppliedImpulse(joint) / h_; }

void JointDrives::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  for (int joint = 0; joint < kJoints; ++joint)
    jacobianA(joint)[kBaseFreedoms + m_bodyA->getLink(first_ + joint).m_dofOffset] = 1;
  m_numDofsFinalized = m_jacSizeBoth;
}

int JointDrives::getIslandIdA() const {
  const auto* collider = m_bodyA->getLinkCollider(first_);
  return collider ? collider->getIslandTag() : -1;
}

void JointDrives::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                       const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  for (int joint = 0; joint < kJoints; ++joint) {
    const auto k = static_cast<std::size_t>(joint);
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    fillMultiBodyConstraint(row, data, jacobianA(joint), jacobianB(joint), none, none, none, none, 0, info,
                            lower_[k], upper_[k], false, 1, false, speed_[k]);
    row.m_orgConstraint = this;
    row.m_orgDofIndex = joint;
    row.m_contactNormal1 = row.m_contactNormal2 = none;
    row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
  }
}

}  // namespace mrroc::sim
