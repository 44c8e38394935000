// The bodies of one arm in MuJoCo.
#pragma once
#include <mujoco/mujoco.h>

#include "sim/engine.hpp"
#include "sim/mujoco/model.hpp"

namespace mrroc::sim {

/// An arm of the model.
class MujocoArm final : public ArmMechanics {
 public:
  /// @param model, data  outlive the arm @param motors  of the arm
  MujocoArm(ArmInModel arm, mjModel& model, mjData& data, const std::vector<MotorParameters>& motors);

  [[nodiscard]] double position(int joint) const override { return data_.qpos[arm_.joint + joint]; }
  [[nodiscard]] double speed(int joint) const override { return data_.qvel[arm_.joint + joint]; }
  void close_brakes(const AxisMatrix& motors_per_joints) override;
  void open_brakes() override;
  void push_joint(int joint, double torque) override { data_.qfrc_applied[arm_.joint + joint] += torque; }
  void push_tip(const Vector3& force) override;
  Wrench follow(const Vector3& tip_force) override;
  [[nodiscard]] ArmAtRest at_rest() override;
  [[nodiscard]] Wrench weight() const override;
  [[nodiscard]] const ToolMotion& tool() const override { return motion_; }
  [[nodiscard]] const Vector3& contact_force() const override { return contact_force_; }
  [[nodiscard]] Pose link(int index) const override;

  /// Takes what the integration left behind, forces of contacts before all else; nothing pushes any more.
  void take_over();

 private:
  void update_motion();
  void sum_contacts();

  ArmInModel arm_;
  mjModel& model_;
  mjData& data_;
  std::vector<double> brake_torques_;  // [N m]
  ToolMotion motion_;
  Vector3 contact_force_{Vector3::Zero()};
};

}  // namespace mrroc::sim
