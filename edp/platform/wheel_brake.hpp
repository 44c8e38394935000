// How the drives of a platform brake while it still moves: in an emergency stop, and after a stop that was too short.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "edp/platform/platform.hpp"

namespace mrroc::edp {

/// Brakes each wheel with a torque against its own speed. A short-circuited motor does so, too, but its torque fades with the
/// speed. It needs the encoders alone: neither an estimate nor a solver. Real-time safe.
class WheelBrake {
 public:
  /// Torque against a speed, up to the most that the platform brakes with [N m s/rad]. With more, wheels without load shake.
  static constexpr double kGain = 8;
  /// Steps over which a speed is measured: what it lags behind counts for more than how finely it is known.
  static constexpr std::size_t kMeasured = 5;
  /// It ends when no wheel has turned by more than some increments for so many steps, or after a second. The motors are
  /// short-circuited then.
  static constexpr double kPlay = 2;
  static constexpr int kRest = 50;
  static constexpr int kLongest = 500;

  /// @param platform  one that brakes with no torque is never engaged  @param dt  duration of a step [s]
  WheelBrake(const PlatformProperties& platform, double dt) noexcept
      : most_(platform.braking_torque),
        speed_per_increment_(2 * std::numbers::pi / platform.increments_per_turn / dt / kMeasured) {}

  void begin() noexcept {
    left_ = most_ > 0 ? kLongest : 0;
    rest_ = 0;
    away_ = {};
  }
  void end() noexcept { left_ = 0; }
  /// @return whether the drives are to follow the torques
  [[nodiscard]] bool engaged() const noexcept { return left_ > 0; }

  /// One step, also of a platform that does not brake. @param increments  that the wheels have turned by since the step before
  /// @return torques [N m]; zero when it is not engaged any more
  [[nodiscard]] PerWheel step(const PerWheel& increments) noexcept {
    newest_ = (newest_ + 1) % kMeasured;
    last_[newest_] = increments;
    if (!engaged()) return {};
    look_for_rest(increments);
    PerWheel torque{};
    for (std::size_t k = 0; engaged() && k < kWheels; ++k) {
      double turned = 0;
      for (const PerWheel& each : last_) turned += each[k];
      torque[k] = std::clamp(-kGain * speed_per_increment_ * turned, -most_, most_);
    }
    return torque;
  }

 private:
  void look_for_rest(const PerWheel& increments) noexcept {
    for (std::size_t k = 0; k < kWheels; ++k) away_[k] += increments[k];
    const bool moved = std::ranges::any_of(away_, [](double away) { return std::abs(away) > kPlay; });
    if (moved) away_ = {};
    rest_ = moved ? 0 : rest_ + 1;
    left_ = rest_ >= kRest ? 0 : left_ - 1;
  }

  double most_;                 // [N m]
  double speed_per_increment_;  // [rad/s] of kMeasured steps
  std::array<PerWheel, kMeasured> last_{};
  std::size_t newest_{};
  PerWheel away_{};  // from where the wheels stood when one moved last [increments]
  int left_{};       // steps
  int rest_{};       // steps at rest
};

}  // namespace mrroc::edp
