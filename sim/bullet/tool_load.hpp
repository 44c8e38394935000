// Load of a force/torque sensor between flange and tool, from the momentum balance of the tool and its jaws.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <array>

#include "base/pose.hpp"
#include "sim/bullet/arm_body.hpp"
#include "sim/tool_motion.hpp"

namespace mrroc::sim {

/// The balance: what the flange exerts on the tool is the change of the tool's momentum less all other forces
/// on it. Bullet's own joint feedback counts joint torques twice and is not used. It contains the tool's
/// inertial forces, as a real sensor's reading does.
class ToolLoad {
  // Of a link beyond the tool, in the world.
  struct JawMotion {
    Vector3 centre{Vector3::Zero()};
    Vector3 momentum{Vector3::Zero()};  // [kg m/s]
    Vector3 spin{Vector3::Zero()};      // angular momentum about its centre [kg m^2/s]
  };

 public:
  /// @param arm      kept by reference @param gravity [m/s^2] @param h integration step [s]
  ToolLoad(const ArmBody& arm, const Vector3& gravity, double h);

  /// Takes the present state without a force. Call after setting joints.
  void reset();

  /// Call after each integration.
  /// @param tip_force  of anything else that pushes the tip, in the world, as applied in that integration [N]
  /// @return S_F: load on the tool side of the sensor, gravity and inertial forces included, in S [N, N m]
  Wrench step(const Vector3& tip_force);

  /// @return S_F of the tool at rest, in S [N, N m]
  [[nodiscard]] Wrench weight() const;
  /// @return motion after the last integration
  [[nodiscard]] const ToolMotion& motion() const { return motion_; }
  /// @return force of all contacts on the tool's own link, jaws not included, in the last integration, in the world [N]
  [[nodiscard]] const Vector3& contact_force() const { return contact_force_; }

 private:
  void update_motion();
  [[nodiscard]] Vector3 spin() const;
  const ArmBody& arm_;
  Vector3 gravity_;
  double h_;
  ToolMotion motion_;
  std::array<JawMotion, 2> jaws_{};
  std::size_t jaw_count_;
  Vector3 contact_force_{Vector3::Zero()};
  btAlignedObjectArray<btVector3> turning_, moving_;  // of all links, in their frames
  btAlignedObjectArray<btQuaternion> rotations_;      // work space
  btAlignedObjectArray<btVector3> origins_;
};

}  // namespace mrroc::sim
