// The bodies of one arm in Bullet: its links, brakes, and the pen, belt, gripper or palm that touches things.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <functional>
#include <memory>

#include "sim/bullet/arm_at_rest.hpp"
#include "sim/bullet/arm_body.hpp"
#include "sim/bullet/ball_contact.hpp"
#include "sim/bullet/brakes.hpp"
#include "sim/bullet/gripper_body.hpp"
#include "sim/bullet/palm_body.hpp"
#include "sim/bullet/scene.hpp"
#include "sim/bullet/tool_load.hpp"
#include "sim/engine.hpp"

namespace mrroc::sim {

/// An arm in the scene.
class BulletArm final : public ArmMechanics {
 public:
  /// @param plan   read only by the call @param scene  outlives the arm @param h  integration step [s]
  /// @throws std::invalid_argument  a parameter is out of range
  BulletArm(const ArmParameters& parameters, const ArmPlan& plan, Scene& scene, double h);
  ~BulletArm() override;

  [[nodiscard]] double position(int joint) const override { return arm_.body->getJointPos(joint); }
  [[nodiscard]] double speed(int joint) const override { return arm_.body->getJointVel(joint); }
  void close_brakes(const AxisMatrix& motors_per_joints) override { brakes_->close(motors_per_joints); }
  void open_brakes() override { brakes_->open(); }
  void push_joint(int joint, double torque) override { arm_.body->addJointTorque(joint, torque); }
  void push_tip(const Vector3& force) override;
  Wrench follow(const Vector3& tip_force) override { return load_.step(tip_force); }
  [[nodiscard]] ArmAtRest at_rest() override { return arm_at_rest(arm_, scene_.gravity()); }
  [[nodiscard]] Wrench weight() const override { return load_.weight(); }
  [[nodiscard]] const ToolMotion& tool() const override { return load_.motion(); }
  [[nodiscard]] const Vector3& contact_force() const override { return load_.contact_force(); }
  [[nodiscard]] Pose link(int index) const override { return link_pose(*arm_.body, index); }
  void push_jaws(double distance) override {
    if (gripper_) gripper_->push(distance);
  }
  [[nodiscard]] double jaw_force() override { return gripper_ ? gripper_->force() : 0; }
  void visit_rest(const std::function<void(double)>& take) const override;

  /// After contacts have been found.
  void share_stiffness() {
    if (gripper_) gripper_->share_stiffness();
    if (palm_) palm_->share_stiffness();
  }
  /// After contacts have been found, of a pen: Bullet keeps points of contact from one integration to the next, where
  /// nothing is grasped (Scene::prepare_for_grasping()). For a belt the pens on it do this.
  void drop_stale_contacts() {
    if (collider_ && !belt_) keep_newest_contact(*scene_.dynamics().getDispatcher(), collider_.get());
  }
  /// @return its links and joints
  [[nodiscard]] const btMultiBody* body() const { return arm_.body.get(); }
  /// @return E in the world
  [[nodiscard]] Pose T_UE() const { return load_.motion().T_UG * arm_.T_GE; }

 private:
  void add_pen(const ArmParameters& p);
  void add_belt(const ArmParameters& p, const edp::Robot& robot);
  void add_collider(int group, int mask);

  Scene& scene_;
  ArmBody arm_;
  std::unique_ptr<Brakes> brakes_;
  ToolLoad load_;
  btSphereShape ball_;
  std::unique_ptr<btBoxShape> belt_;  // none: a pen
  btCompoundShape touching_;          // pen or belt
  std::unique_ptr<btMultiBodyLinkCollider> collider_;
  std::unique_ptr<GripperBody> gripper_;
  std::unique_ptr<PalmBody> palm_;  // instead of a pen
};

}  // namespace mrroc::sim
