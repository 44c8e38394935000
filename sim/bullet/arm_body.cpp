#include "sim/bullet/arm_body.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyLink.h>

#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

void set_up_link(btMultiBody& body, const Chain& chain, std::size_t k) {
  const ChainLink& link = chain.links[k];
  const int index = static_cast<int>(k);
  const int parent = index - link.back;
  const btQuaternion to_link = quaternion(link.T_PL.R.transpose());
  const Vector3 from_parent =
      parent < 0 ? link.T_PL.p : link.T_PL.p - chain.links[static_cast<std::size_t>(parent)].mass_centre;
  const btVector3 pivot = to_bullet(from_parent);
  const btVector3 centre = to_bullet(link.mass_centre);
  const btVector3 inertia = to_bullet(link.inertia);
  const btVector3 axis = to_bullet(link.axis);
  if (link.fixed)
    body.setupFixed(index, link.mass, inertia, parent, to_link, pivot, centre);
  else if (link.prismatic)
    body.setupPrismatic(index, link.mass, inertia, parent, to_link, axis, pivot, centre, true);
  else
    body.setupRevolute(index, link.mass, inertia, parent, to_link, axis, pivot, centre, true);
}

}  // namespace

ArmBody build_arm(const Chain& chain, const Pose& T_UB) {
  ArmBody arm;
  arm.joints = chain.joints;
  arm.tool = chain.tool;
  arm.T_GS = chain.T_GS;
  arm.T_GE = chain.T_GE;
  const int links = static_cast<int>(chain.links.size());
  arm.body = std::make_unique<btMultiBody>(links, 0, btVector3(0, 0, 0), true, false);
  arm.body->setBasePos(to_bullet(T_UB.p));
  arm.body->setWorldToBaseRot(quaternion(T_UB.R.transpose()));
  for (std::size_t k = 0; k < chain.links.size(); ++k) set_up_link(*arm.body, chain, k);
  arm.body->finalizeMultiDof();
  arm.body->setCanSleep(false);
  arm.body->setHasSelfCollision(false);
  arm.body->setUseGyroTerm(true);
  arm.body->setLinearDamping(0);
  arm.body->setAngularDamping(0);
  return arm;
}

void set_joints(btMultiBody& body, const AxisVector& joints) {
  for (int k = 0; k < joints.size(); ++k) {
    body.setJointPos(k, joints[k]);
    body.setJointVel(k, 0);
  }
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  body.forwardKinematics(rotations, origins);
  body.updateCollisionObjectWorldTransforms(rotations, origins);
}

Pose link_pose(const btMultiBody& body, int link) {
  return from_bullet(body.getLink(link).m_cachedWorldTransform);
}

}  // namespace mrroc::sim
