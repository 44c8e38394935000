#include "sim/bullet/palm_body.hpp"

#include "sim/bullet/contact_share.hpp"
#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
PalmBody::PalmBody(const PalmParameters& p, const ArmBody& arm, Scene& scene)
    : p_(p),
      scene_(scene),
      box_(btVector3(p.width / 2, p.width / 2, p.thickness / 2)),
      collider_(std::make_unique<btMultiBodyLinkCollider>(arm.body.get(), arm.tool)) {
  palm_.addChildShape(to_bullet(arm.T_GE * palm_middle(p)), &box_);
  collider_->setCollisionShape(&palm_);
  collider_->setFriction(p.friction);
  collider_->setContactStiffnessAndDamping(p.stiffness, p.stiffness * p.relaxation);
  collider_->setActivationState(DISABLE_DEACTIVATION);
  arm.body->getLink(arm.tool).m_collider = collider_.get();
  scene_.dynamics().addCollisionObject(collider_.get(), kGripperGroup, kCubeGroup);
}

PalmBody::~PalmBody() { scene_.dynamics().removeCollisionObject(collider_.get()); }

void PalmBody::share_stiffness() {
  share_contact_stiffness(*scene_.dynamics().getDispatcher(), collider_.get(), p_.stiffness, p_.relaxation);
}

}  // namespace mrroc::sim
