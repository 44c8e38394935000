// One arm of the simulator: its body, drives, brakes, encoders, sensor and pen, and the hand that leads it.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <array>
#include <memory>
#include <vector>

#include "edp/robot.hpp"
#include "sim/bullet/brakes.hpp"
#include "sim/bullet/gripper_body.hpp"
#include "sim/bullet/multibody.hpp"
#include "sim/bullet/palm_body.hpp"
#include "sim/bullet/scene.hpp"
#include "sim/bullet/tool_load.hpp"
#include "sim/elastic_gears.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// An arm in the scene. In every step: begin_step, then for each substep push, (integrate the scene), follow,
/// then end_step.
class SimulatedArm {
 public:
  /// @param scene  outlives the arm @param h  integration step [s] @param substeps  of a step
  /// @throws std::invalid_argument  a parameter is out of range
  SimulatedArm(const ArmParameters& parameters, Scene& scene, double h, int substeps, std::uint64_t seed);
  ~SimulatedArm();
  SimulatedArm(const SimulatedArm&) = delete;
  SimulatedArm& operator=(const SimulatedArm&) = delete;

  /// @param command  null: there is none, the drives brake
  void begin_step(const HardwareCommand* command);
  /// Applies torques of the motors and the force of the hand to the body.
  void push();
  /// Takes over what the integration made of them.
  void follow();
  /// @param step  number of the steps done
  void end_step(std::int64_t step);

  /// @return what drives and sensor give after the last step
  [[nodiscard]] const HardwareReading& reading() const { return reading_; }
  /// @return of the last step
  [[nodiscard]] const ArmTruth& truth() const { return truth_; }
  /// @return joints after the construction [rad, track m]
  [[nodiscard]] const AxisVector& start_joints() const { return start_joints_; }
  /// @return what it looks like at present
  [[nodiscard]] std::vector<LinkShape> shapes() const;
  /// After contacts have been found.
  void share_stiffness() {
    if (gripper_) gripper_->share_stiffness();
    if (palm_) palm_->share_stiffness();
  }
  /// What the pen draws on has moved since the construction. @param way  in the world [m]
  void carry_sheet(const Vector3& way) { sheet_way_ = T_BU_.R * way; }
  /// @return angular velocity of the tool in the world [rad/s]
  [[nodiscard]] Vector3 tool_turning() const { return load_.motion().angular_velocity; }
  /// @return its links and joints
  [[nodiscard]] const btMultiBody* body() const { return arm_.body.get(); }
  /// @return E in the world
  [[nodiscard]] Pose T_UE() const { return load_.motion().T_UG * arm_.T_GE; }
  /// @return the operator's hand, which leads this arm
  Hand& hand() { return hand_; }
  /// @return what the pen has drawn
  Ink& ink() { return ink_; }
  /// @param width  of what is between the jaws from now on [m], 0: nothing. Without effect on an arm without jaws
  void set_object(double width) {
    if (jaws_) jaws_->set_object(width);
  }

  /// Calls take(double) with every number of the mechanical state.
  template <class Take>
  void visit_state(Take take) const {
    for (int k = 0; k < arm_.joints; ++k) {
      take(arm_.body->getJointPos(k));
      take(arm_.body->getJointVel(k));
      take(friction_[static_cast<std::size_t>(k)].deflection());
    }
    for (int k = 0; gears_ && k < arm_.joints; ++k) {
      take(gears_->joints()[k]);
      take(gears_->shaft_speeds()[k]);
    }
    for (int k = arm_.joints; gripper_ && k < arm_.body->getNumLinks(); ++k) {
      if (k == arm_.tool) continue;  // it has no joint
      take(arm_.body->getJointPos(k));
      take(arm_.body->getJointVel(k));
    }
  }

 private:
  [[nodiscard]] AxisVector joint_speeds() const;
  void add_gears();
  /// @return where the motors have the joints: where they are, unless gears give way
  [[nodiscard]] const AxisVector& driven_joints() const { return gears_ ? gears_->joints() : truth_.joints; }
  /// @param torques  on the shafts @return on the joints
  [[nodiscard]] AxisVector geared(const AxisVector& torques);
  void read_joints();
  void add_pen();
  void add_belt(const robots::Belt& belt);
  void add_collider(int group, int mask);
  void measure(std::int64_t step);
  void observe();

  ArmParameters p_;
  Scene& scene_;
  double h_;
  double share_;  // of a substep in the means over a step
  std::unique_ptr<edp::Robot> robot_;
  Pose T_BU_;
  Pose T_PU_;
  Vector3 paper_normal_;  // in the world

  AxisVector start_joints_, start_motors_;
  ArmBody arm_;
  std::unique_ptr<Brakes> brakes_;     // open for good where gears have rotors of their own
  std::optional<ElasticGears> gears_;  // none: rigid, rotors are part of the links
  ToolLoad load_;
  std::array<ShaftFriction, kMaxAxes> friction_{};
  std::vector<Encoder> encoders_;
  std::optional<Jaws> jaws_;
  Encoder jaw_encoder_;
  ForceSensor sensor_;
  Hand hand_;
  Ink ink_;
  Vector3 sheet_way_{Vector3::Zero()};  // since the construction, in the base
  btSphereShape ball_;
  std::unique_ptr<btBoxShape> belt_;  // none: a pen
  btCompoundShape touching_;          // pen or belt
  std::unique_ptr<btMultiBodyLinkCollider> collider_;
  std::unique_ptr<GripperBody> gripper_;
  std::unique_ptr<PalmBody> palm_;  // instead of a pen

  HardwareCommand command_{};
  double jaw_pwm_{};
  bool jaws_enabled_{};
  std::uint16_t outputs_{};  // of the last command: lines stay as they are while the drives brake
  AxisVector motors_;        // at the end of the step before [rad]
  AxisMatrix motors_per_joints_;
  Vector3 hand_force_{Vector3::Zero()};  // in the world
  HardwareReading reading_;
  std::array<bool, kMaxAxes> limited_{};  // currents of the step, by their drives
  ArmTruth truth_;
};

}  // namespace mrroc::sim
