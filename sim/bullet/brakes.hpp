// The brakes on the shafts of an arm's motors.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include "base/axes.hpp"

namespace mrroc::sim {

/// One row per motor: it holds the shaft up to a torque at which it slips. It acts on motors, not on joints,
/// so that coupled axes are held as their transmission couples them. The arm needs a collider on its last
/// link, otherwise Bullet does not know to which island the brakes belong and ignores them.
class Brakes final : public btMultiBodyConstraint {
 public:
  /// @param body    of the arm
  /// @param torque  at which each brake slips [N m] @param h  integration step [s]
  Brakes(btMultiBody& body, const AxisVector& torque, double h);

  /// Closes the brakes. @param motors_per_joints  d motors / d joints, constant while they are closed
  void close(const AxisMatrix& motors_per_joints);
  /// From now on the shafts turn freely.
  void open() { closed_ = false; }
  /// @return whether they hold
  [[nodiscard]] bool closed() const { return closed_; }

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  AxisVector impulse_;
  AxisMatrix motors_per_joints_;
  bool closed_{};
};

}  // namespace mrroc::sim
