#include "sim/bullet/arm_mechanics.hpp"

#include "sim/belt.hpp"
#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

AxisVector brake_torques(const ArmParameters& p) {
  AxisVector torque(static_cast<int>(p.motors.size()));
  for (int k = 0; k < torque.size(); ++k) torque[k] = p.motors[static_cast<std::size_t>(k)].brake_torque;
  return torque;
}

}  // namespace

BulletArm::BulletArm(const ArmParameters& p, const ArmPlan& plan, Scene& scene, double h)
    : scene_(scene),
      arm_(build_arm(plan.chain, p.T_UB)),
      brakes_(std::make_unique<Brakes>(*arm_.body, brake_torques(p), h)),
      load_(arm_, scene.gravity(), h),
      ball_(p.pen_radius),
      touching_(false) {
  scene_.dynamics().addMultiBody(arm_.body.get());
  if (p.gripper) {
    gripper_ = std::make_unique<GripperBody>(*p.gripper, arm_, scene, h);
    gripper_->place(Jaws(*p.jaws, h).distance());
  } else if (p.type->belt) {
    add_belt(p, *plan.robot);
  } else if (p.palm) {
    palm_ = std::make_unique<PalmBody>(*p.palm, arm_, scene);
  } else {
    add_pen(p);
  }
  set_joints(*arm_.body, plan.start);
  load_.reset();
  scene_.dynamics().addMultiBodyConstraint(brakes_.get());
  brakes_->finalizeMultiDof();
}

BulletArm::~BulletArm() {
  scene_.dynamics().removeMultiBodyConstraint(brakes_.get());
  if (collider_) scene_.dynamics().removeCollisionObject(collider_.get());
  gripper_.reset();
  palm_.reset();
  scene_.dynamics().removeMultiBody(arm_.body.get());
}

void BulletArm::add_pen(const ArmParameters& p) {
  // The lowest point of the ball is the tip of the tool.
  const Pose T_G_ball = arm_.T_GE * Pose{Matrix3::Identity(), {0, 0, -p.pen_radius}};
  touching_.addChildShape(to_bullet(T_G_ball), &ball_);
  add_collider(kPenGroup, kPaperGroup);
  collider_->setFriction(p.paper.friction);
  collider_->setContactStiffnessAndDamping(p.paper.stiffness, p.paper.stiffness * p.paper.damping_ratio);
}

void BulletArm::add_belt(const ArmParameters& p, const edp::Robot& robot) {
  const Vector3 size = belt_size(*p.type->belt);
  belt_ = std::make_unique<btBoxShape>(btVector3(size.x() / 2, size.y() / 2, size.z() / 2));
  touching_.addChildShape(to_bullet(arm_.T_GE * belt_in_effector(*p.type, robot)), belt_.get());
  add_collider(kPaperGroup, kPenGroup);
  collider_->setFriction(1);
}

void BulletArm::add_collider(int group, int mask) {
  collider_ = std::make_unique<btMultiBodyLinkCollider>(arm_.body.get(), arm_.tool);
  collider_->setCollisionShape(&touching_);
  collider_->setActivationState(DISABLE_DEACTIVATION);
  arm_.body->getLink(arm_.tool).m_collider = collider_.get();
  scene_.dynamics().addCollisionObject(collider_.get(), group, mask);
}

void BulletArm::push_tip(const Vector3& force) {
  arm_.body->addLinkForce(arm_.tool, to_bullet(force));
  arm_.body->addLinkTorque(arm_.tool, to_bullet((tool().T_UG.R * arm_.T_GE.p).cross(force)));
}

void BulletArm::visit_rest(const std::function<void(double)>& take) const {
  for (int k = arm_.joints; gripper_ && k < arm_.body->getNumLinks(); ++k) {
    if (k == arm_.tool) continue;  // it has no joint
    take(arm_.body->getJointPos(k));
    take(arm_.body->getJointVel(k));
  }
}

}  // namespace mrroc::sim
