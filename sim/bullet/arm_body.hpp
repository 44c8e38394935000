// An arm's links and joints as one Bullet multibody, built from the description's chain.
#pragma once
#include <BulletDynamics/Featherstone/btMultiBody.h>

#include <memory>

#include "base/axes.hpp"
#include "base/pose.hpp"
#include "sim/chain.hpp"

namespace mrroc::sim {

/// The multibody and the frames on it that matter; its links are those of the chain.
struct ArmBody {
  static constexpr int kWristAxes = Chain::kWristAxes;  ///< links of the elastic wrist

  std::unique_ptr<btMultiBody> body;  ///< never null
  int joints{};                       ///< number of moving joints
  int tool{};                         ///< index of the tool's link
  Pose T_GS;  ///< sensor in the frame of the tool's link; its origin G is the tool's mass centre
  Pose T_GE;  ///< tip of the tool, or E of the gripper, in the frame of the tool's link
};

/// @param T_UB  base of the arm in the world
[[nodiscard]] ArmBody build_arm(const Chain& chain, const Pose& T_UB);

/// Moves the joints and everything that is computed from them; at rest.
/// @param joints [rad, track m]
void set_joints(btMultiBody& body, const AxisVector& joints);

/// @return pose of a link's mass centre in the world, axes as in the description
Pose link_pose(const btMultiBody& body, int link);

}  // namespace mrroc::sim
