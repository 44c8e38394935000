// The gripper of an arm as bodies of the scene: its drive, its wrist, and the contacts of its pads.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <array>
#include <memory>

#include "sim/bullet/arm_body.hpp"
#include "sim/bullet/joint_drive.hpp"
#include "sim/bullet/scene.hpp"
#include "sim/gripper_body.hpp"

namespace mrroc::sim {

/// Belongs to an arm whose body was built with a gripper. The screw that moves the jaws does not give way, so both
/// follow it, one as the mirror of the other; what they press with is the load of its motor (sim/jaws.hpp).
class GripperBody {
 public:
  /// @param arm  outlives the gripper, its body is in the scene  @param h  integration step [s]
  GripperBody(const GripperBodyParameters& parameters, const ArmBody& arm, Scene& scene, double h);
  ~GripperBody();
  GripperBody(const GripperBody&) = delete;
  GripperBody& operator=(const GripperBody&) = delete;

  /// Puts the jaws at a distance, at rest. @param distance [m]
  void place(double distance);
  /// Before each integration. @param distance  between the jaws, as the screw has it now [m]
  void push(double distance);
  /// Divides the stiffness of pads and palm among their points of contact, however many Bullet has found: a pad on two
  /// layers of a cube has twice as many as on one. Call after contacts have been found.
  void share_stiffness();
  /// @return force that opens the jaws, in the last integration [N]: positive when they press on something
  [[nodiscard]] double force();
  /// @return distance between the pads [m]
  [[nodiscard]] double distance() const;

 private:
  std::unique_ptr<btMultiBodyLinkCollider> add(int link, btCollisionShape& shape, double friction,
                                               double stiffness);

  GripperBodyParameters p_;
  const ArmBody& arm_;
  Scene& scene_;
  double h_;
  double wrist_damping_;  // [N s/m]
  btBoxShape pad_box_, palm_box_;
  std::array<btCompoundShape, 2> pads_;
  btCompoundShape palm_;
  std::array<std::unique_ptr<btMultiBodyLinkCollider>, 3> colliders_;
  std::array<double, 3> stiffness_;  // [N/m]
  std::unique_ptr<JointDrives> drives_;
};

}  // namespace mrroc::sim
