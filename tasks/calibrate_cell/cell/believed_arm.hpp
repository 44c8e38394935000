// An arm of the cell as everybody believes it: where its base stands, and which joints put E somewhere.
#pragma once
#include <memory>
#include <string>

#include "base/config.hpp"
#include "robots/catalogue.hpp"
#include "tasks/calibrate_cell/cell/cell.hpp"

namespace mrroc::calibrate_cell {

/// An arm as everybody believes it.
struct BelievedArm {
  const robots::RobotType* type{};      ///< never null
  std::unique_ptr<edp::Robot> robot{};  ///< with the kinematic set that its driver believes
  Pose T_WE;                            ///< its tool
  Pose T_UB;                            ///< its base in the world
  Matrix3 R_UE;                         ///< before the other arm: x of E up, z level towards the other base

  /// @return the type's joints at the beginning, which choose the branch
  [[nodiscard]] AxisVector usual_joints() const;
  /// @return E in the world
  [[nodiscard]] Pose at(const AxisVector& joints) const { return T_UB * robot->forward(joints) * T_WE; }
};
/// @throws ConfigError
[[nodiscard]] BelievedArm read_arm(const Config& config, std::size_t arm);

/// Joints of a pose.
struct Reach {
  AxisVector joints;  ///< [rad], track [m]; meaningful when there is nothing to be said
  std::string why;    ///< what is wrong with them; empty: the arm reaches the pose
};
/// @param T_UE  of E in the world @param near  joints that choose the branch, and the place of a track
[[nodiscard]] Reach reach(const BelievedArm& arm, const Pose& T_UE, const AxisVector& near);

}  // namespace mrroc::calibrate_cell
