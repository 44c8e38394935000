// Drives of single joints of a multibody: each holds its joint at a speed within the limit of its torque.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include <array>

namespace mrroc::sim {

/// A row for each of two joints. Unlike btMultiBodyJointMotor it leaves no trace in the forces that Bullet reports at
/// the links, so that the balance of a force sensor stays a balance of external forces. The body needs a collider on
/// one of the two links, otherwise Bullet does not know to which island the rows belong and ignores them.
class JointDrives final : public btMultiBodyConstraint {
 public:
  static constexpr int kJoints = 2;  ///< joints that are driven

  /// @param body   of the joints  @param first  link of the first joint; that of the second is the next one
  /// @param h      integration step [s]
  JointDrives(btMultiBody& body, int first, double h);

  /// Sets a drive until the next call.
  /// @param joint  0 or 1
  /// @param speed  [rad/s], [m/s]
  /// @param lower, upper  torque or force that it gives at least and at most, below and above zero [N m], [N]
  void drive(int joint, double speed, double lower, double upper);
  /// The same with one bound for both directions.
  void drive(int joint, double speed, double most) { drive(joint, speed, -most, most); }

  /// @return torque or force that the drive gave to the joint in the last integration [N m], [N]
  [[nodiscard]] double given(int joint);

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  int first_;
  double h_;
  std::array<double, kJoints> speed_{};
  std::array<double, kJoints> lower_{}, upper_{};  // impulses
};

}  // namespace mrroc::sim
