#include "sim/bullet/gripper_body.hpp"

#include <cmath>

#include "sim/bullet/contact_share.hpp"
#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

constexpr double kPalmThickness = 0.02;  // [m]

}  // namespace

GripperBody::GripperBody(const GripperBodyParameters& p, const ArmBody& arm, Scene& scene, double h)
    : p_(p),
      arm_(arm),
      scene_(scene),
      h_(h),
      pad_box_(btVector3(p.pad_width / 2, p.pad_thickness / 2, p.pad_depth / 2)),
      palm_box_(btVector3(p.palm_width / 2, p.palm_width / 2, kPalmThickness / 2)),
      stiffness_{p.pad_stiffness, p.pad_stiffness, p.palm_stiffness},
      drives_(std::make_unique<JointDrives>(*arm.body, arm.tool + 1, h)) {
  double mass = 0;
  for (int link = arm.tool; link < arm.body->getNumLinks(); ++link) mass += arm.body->getLink(link).m_mass;
  wrist_damping_ = 2 * p.wrist_damping * std::sqrt(p.wrist_stiffness * mass);

  // The links of the jaws have their origins in the middle of the pads.
  btTransform centre;
  centre.setIdentity();
  for (int jaw = 0; jaw < 2; ++jaw) {
    const auto k = static_cast<std::size_t>(jaw);
    pads_[k].addChildShape(centre, &pad_box_);
    colliders_[k] = add(arm.tool + 1 + jaw, pads_[k], p.friction, p.pad_stiffness);
  }
  palm_.addChildShape(to_bullet(arm.T_GE * Pose{Matrix3::Identity(), {0, 0, -p.palm - kPalmThickness / 2}}),
                      &palm_box_);
  colliders_[2] = add(arm.tool, palm_, p.palm_friction, p.palm_stiffness);

  scene_.dynamics().addMultiBodyConstraint(drives_.get());
  drives_->finalizeMultiDof();
}

GripperBody::~GripperBody() {
  scene_.dynamics().removeMultiBodyConstraint(drives_.get());
  for (const auto& collider : colliders_) scene_.dynamics().removeCollisionObject(collider.get());
}

std::unique_ptr<btMultiBodyLinkCollider> GripperBody::add(int link, btCollisionShape& shape, double friction,
                                                          double stiffness) {
  auto collider = std::make_unique<btMultiBodyLinkCollider>(arm_.body.get(), link);
  collider->setCollisionShape(&shape);
  collider->setFriction(friction);
  collider->setContactStiffnessAndDamping(stiffness, stiffness * p_.relaxation);
  collider->setActivationState(DISABLE_DEACTIVATION);
  arm_.body->getLink(link).m_collider = collider.get();
  scene_.dynamics().addCollisionObject(collider.get(), kGripperGroup, kCubeGroup);
  return collider;
}

void GripperBody::place(double distance) {
  for (int jaw = 1; jaw <= 2; ++jaw) {
    arm_.body->setJointPos(arm_.tool + jaw, distance / 2);
    arm_.body->setJointVel(arm_.tool + jaw, 0);
  }
}

void GripperBody::push(double distance) {
  for (int axis = 1; axis <= ArmBody::kWristAxes; ++axis) {
    const int link = arm_.tool - axis;
    arm_.body->addJointTorque(link, -p_.wrist_stiffness * arm_.body->getJointPos(link) -
                                        wrist_damping_ * arm_.body->getJointVel(link));
  }
  for (int jaw = 0; jaw < 2; ++jaw)
    drives_->drive(jaw, (distance / 2 - arm_.body->getJointPos(arm_.tool + 1 + jaw)) / h_, p_.jaw_force);
}

void GripperBody::share_stiffness() {
  btDispatcher& dispatcher = *scene_.dynamics().getDispatcher();
  for (std::size_t k = 0; k < colliders_.size(); ++k)
    share_contact_stiffness(dispatcher, colliders_[k].get(), stiffness_[k], p_.relaxation);
}

// Both jaws close by half of what the distance shrinks, so the force that belongs to the distance is their mean.
double GripperBody::force() { return -(drives_->given(0) + drives_->given(1)) / 2; }

double GripperBody::distance() const {
  return arm_.body->getJointPos(arm_.tool + 1) + arm_.body->getJointPos(arm_.tool + 2);
}

}  // namespace mrroc::sim
