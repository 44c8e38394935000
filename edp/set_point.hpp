// The set point of an arm: the set pose T_c, the axes' positions and the velocity that belong to it.
#pragma once
#include "base/axes.hpp"
#include "base/pose.hpp"
#include "base/spatial.hpp"

namespace mrroc::edp {

/// Positions of all axes. Trivial storage, no allocation.
struct AxisPositions {
  AxisVector joints;  ///< [rad], track: [m]
  AxisVector motors;  ///< [rad] of the shafts
};

/// The set point of one step. It is what the next motion begins from, never the measured pose: following
/// error and sag would accumulate otherwise (edp.md 3).
struct SetPoint {
  Pose T_0E;                   ///< T_c, end effector in the base
  AxisPositions axes;          ///< set positions that realise T_c
  AxisVector motor_increment;  ///< motion of the set motor positions in the last step [rad]
  Twist v_0W;                  ///< 0_W v_c: velocity of the wrist computed last, in the orientation of the
                               ///< base, at W because the tool E may change [m/s], [rad/s]. It is the law's
                               ///< memory and outlives a passive step, in which the set point stands
};

/// @return velocity with which E went to the set point, in E; zero after a passive step. Real-time safe
/// @param T_EW inverse of the tool that T_0E belongs to
[[nodiscard]] inline Twist velocity_of_E(const SetPoint& set, const Pose& T_EW) noexcept {
  if (set.motor_increment.isZero(0)) return {};
  return xi_V(T_EW, xi_star((set.T_0E.R * T_EW.R).transpose(), set.v_0W));
}

}  // namespace mrroc::edp
