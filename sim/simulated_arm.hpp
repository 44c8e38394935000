// One arm of the simulator: its drives, encoders, switches, sensor and jaws, and the hand that leads it. Its bodies are
// those of an engine.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "edp/robot.hpp"
#include "sim/elastic_gears.hpp"
#include "sim/engine.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// @throws std::invalid_argument  a parameter is out of range
[[nodiscard]] ArmPlan plan_arm(const ArmParameters& parameters);

/// An arm. In every step: begin_step, then for each substep push, (integrate), follow, then end_step.
class SimulatedArm {
 public:
  /// @param plan  of these parameters @param body  built from it, outlives the arm @param h  integration step [s]
  /// @param substeps  of a step
  SimulatedArm(const ArmParameters& parameters, ArmPlan plan, ArmMechanics& body, double h, int substeps,
               std::uint64_t seed);
  ~SimulatedArm() = default;
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
  /// What the pen draws on has moved since the construction. @param way  in the world [m]
  void carry_sheet(const Vector3& way) { sheet_way_ = T_BU_.R * way; }
  /// @return E in the world
  [[nodiscard]] Pose T_UE() const { return body_.tool().T_UG * chain_.T_GE; }
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
    for (int k = 0; k < chain_.joints; ++k) {
      take(body_.position(k));
      take(body_.speed(k));
      take(friction_[static_cast<std::size_t>(k)].deflection());
    }
    for (int k = 0; gears_ && k < chain_.joints; ++k) {
      take(gears_->joints()[k]);
      take(gears_->shaft_speeds()[k]);
    }
    body_.visit_rest(take);
  }

 private:
  [[nodiscard]] AxisVector joint_speeds() const;
  void add_gears();
  /// @return where the motors have the joints: where they are, unless gears give way
  [[nodiscard]] const AxisVector& driven_joints() const { return gears_ ? gears_->joints() : truth_.joints; }
  /// @param torques  on the shafts @return on the joints
  [[nodiscard]] AxisVector geared(const AxisVector& torques);
  /// @return shafts as encoders and switches have them [rad]
  [[nodiscard]] AxisVector encoded_motors(const AxisVector& joints) const {
    return robot_->motors_from_joints(joints) - zero_motors_;
  }
  void read_joints();
  void measure(std::int64_t step);
  void observe();

  ArmParameters p_;
  ArmMechanics& body_;
  double h_;
  double share_;  // of a substep in the means over a step
  std::unique_ptr<edp::Robot> robot_;
  Pose T_BU_;
  Pose T_PU_;
  Vector3 paper_normal_;  // in the world

  AxisVector start_joints_;
  AxisVector zero_motors_;   // by how much the shafts are farther than encoders and switches say [rad]
  AxisVector start_motors_;  // as encoders and switches say [rad]
  Chain chain_;
  std::optional<ElasticGears> gears_;  // none: rigid, rotors are part of the links
  std::array<ShaftFriction, kMaxAxes> friction_{};
  std::vector<Encoder> encoders_;
  std::optional<Jaws> jaws_;
  Encoder jaw_encoder_;
  ForceSensor sensor_;
  Hand hand_;
  Ink ink_;
  Vector3 sheet_way_{Vector3::Zero()};  // since the construction, in the base

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
