// Brings the set point to rest at the goal of a motion that no command follows (docs/timing.md, "Arriving").
#pragma once

#include "base/pose.hpp"
#include "edp/deceleration.hpp"
#include "edp/set_point.hpp"

namespace mrroc::edp {

/// Steps that a macrostep gets besides its own when it cannot make up in time for the way that is left before it.
inline constexpr int kCatchUp = 20;

/// The position that a motion is to end at.
struct Goal {
  Pose T_0W;           ///< wrist in the base; means nothing while the positions of the motors are not known
  AxisPositions axes;  ///< of the wrist there; joints mean nothing while the positions are not known
};

/// Speeds up to which a motion from rest is slow: it keeps its speed up to its goal, which a command that follows may
/// want, and otherwise passes the goal by at most 0.35 mm in a stop of kShortStop steps, and returns.
inline constexpr double kSlow = 0.07;     ///< of E [m/s]
inline constexpr double kSlowTurn = 0.2;  ///< of E [rad/s]
inline constexpr double kSlowMotor = 50;  ///< of each motor, while nobody knows where E is [rad/s]
inline constexpr int kShortStop = 6;      ///< steps of that stop

/// The way of a macrostep that begins at rest and brakes before its goal: m steps at constant speed, then a stop of n
/// steps. With the way (n - 1)/2 of that stop, in steps of its initial speed, the goal is reached when
///
///     u (m + (n - 1)/2) = n_s,    m = ceil(n_s - (n - 1)/2),
///
/// where u <= 1 is the speed of these m steps over that of the constant-speed macrostep, way / n_s. The goal is
/// reached in step m + n - 1: n/2 steps after n_s, rounded down. The speed is never above the commanded one.
class Approach {
 public:
  /// @param n_s  steps of the macrostep  @param n  steps of the stop, 1..2 n_s
  constexpr Approach(int n_s, int n) noexcept : n_s_(n_s), n_(n) {
    const double way = stopping_way(n);
    while (m_ < n_s - way) ++m_;
    u_ = n_s / (m_ + way);
  }
  /// @return steps after which the goal is reached: m + n - 1, which is n_s + n/2, rounded down
  [[nodiscard]] constexpr int steps() const noexcept { return m_ + n_ - 1; }
  /// @param k  step 0..steps()  @return part of the way that is done after it, 0..1. Real-time safe
  [[nodiscard]] constexpr double part(int k) const noexcept {
    if (k >= steps()) return 1;
    return u_ * (k <= m_ ? k : m_ + way_of_stop(k - m_, n_)) / n_s_;
  }
  /// @param k  step 1..steps()  @return speed in that step over the constant speed, 0..1. Real-time safe
  [[nodiscard]] constexpr double speed(int k) const noexcept {
    return k <= m_ ? u_ : u_ * remaining_speed(k - m_, n_);
  }
  /// @return way that is left after step k, in steps of the speed of step k; 0 at the goal. Real-time safe
  [[nodiscard]] constexpr double remaining(int k) const noexcept {
    return k < steps() ? (1 - part(k)) * n_s_ / speed(k) : 0;
  }

 private:
  int n_s_;
  int n_;
  int m_{};
  double u_{};
};

/// Steps in which a set point that has stopped beyond its goal returns to it: about as hard as the stop was.
/// @param n  steps of the stop
constexpr int return_steps(int n) noexcept { return n + (n + 3) / 4; }

/// Part of a way from rest to rest with the least jerk, 10 tau^3 - 15 tau^4 + 6 tau^5, tau = k/n.
/// @param k step 0..n  @return 0..1. Real-time safe
constexpr double minimum_jerk(int k, int n) noexcept {
  const double tau = static_cast<double>(k) / n;
  return tau * tau * tau * (10 + tau * (6 * tau - 15));
}

}  // namespace mrroc::edp
