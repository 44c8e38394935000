// How the drives of a platform brake while it still moves: in an emergency stop, after a fault, and after a stop that was too
// short.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "edp/platform/platform.hpp"
#include "edp/platform/wheel_meter.hpp"

namespace mrroc::edp {

/// Brakes each wheel with a torque against its own speed. A short-circuited motor does so, too, but its torque fades with the
/// speed. It needs the encoders alone, neither an estimate nor a solver, and nobody else watches them meanwhile: when they
/// cannot be true, it ends. Real-time safe.
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
  /// It ends, too, when a wheel seems to stand for so many steps in which the other one of its side has turned by so much
  /// [rad]: nothing holds a braked wheel on moving ground, so its encoder is stuck; or when one seems to turn faster than any
  /// wheel can.
  static constexpr int kStuck = 20;
  static constexpr double kMoved = 0.1;

  /// @param platform  one that brakes with no torque is never engaged  @param dt  duration of a step [s]
  WheelBrake(const PlatformProperties& platform, double dt) noexcept
      : most_(platform.braking_torque),
        most_speed_(platform.impossible_wheel_speed()),
        rad_per_increment_(2 * std::numbers::pi / platform.increments_per_turn),
        speed_per_increment_(rad_per_increment_ / dt / kMeasured) {}

  /// @param out  a wheel that does not brake, as its encoder is wrong or something blocks it; -1: none
  void begin(int out = -1) noexcept {
    out_ = out;
    left_ = most_ > 0 ? kLongest : 0;
    rest_ = 0;
    away_ = {};
    standing_ = {};
    beside_ = {};
  }
  void end() noexcept { left_ = 0; }
  /// @return whether the drives are to follow the torques
  [[nodiscard]] bool engaged() const noexcept { return left_ > 0; }

  /// One step, also of a platform that does not brake. @param wheels  with its reading
  /// @return torques [N m]; zero when it is not engaged any more
  [[nodiscard]] PerWheel step(const WheelMeter& wheels) noexcept {
    if (!engaged()) return {};
    look_for_rest(wheels.increments());
    PerWheel torque{};
    const PerWheel turned = wheels.turned(kMeasured);
    for (std::size_t k = 0; k < kWheels; ++k) {
      if (is_out(k)) continue;
      const double speed = speed_per_increment_ * turned[k];
      if (std::abs(speed) > most_speed_ || is_stuck(k, wheels.increments())) end();
      torque[k] = std::clamp(-kGain * speed, -most_, most_);
    }
    return engaged() ? torque : PerWheel{};
  }

 private:
  void look_for_rest(const PerWheel& increments) noexcept {
    for (std::size_t k = 0; k < kWheels; ++k)
      if (!is_out(k)) away_[k] += increments[k];
    const bool moved = std::ranges::any_of(away_, [](double away) { return std::abs(away) > kPlay; });
    if (moved) away_ = {};
    rest_ = moved ? 0 : rest_ + 1;
    left_ = rest_ >= kRest ? 0 : left_ - 1;
  }

  /// @return whether wheel k stands while the other one of its side turns
  bool is_stuck(std::size_t k, const PerWheel& increments) noexcept {
    const std::size_t other = (k + kWheels / 2) % kWheels;
    if (increments[k] != 0) {
      standing_[k] = 0;
      beside_[k] = 0;
    }
    ++standing_[k];
    beside_[k] += rad_per_increment_ * increments[other];
    return standing_[k] > kStuck && std::abs(beside_[k]) > kMoved && !is_out(other);
  }

  [[nodiscard]] bool is_out(std::size_t k) const noexcept { return static_cast<int>(k) == out_; }

  double most_;                          // [N m]
  double most_speed_;                    // [rad/s]
  double rad_per_increment_;             // of an encoder
  double speed_per_increment_;           // [rad/s] of kMeasured steps
  PerWheel away_{};                      // from where the wheels stood when one moved last [increments]
  std::array<int, kWheels> standing_{};  // steps since each has turned
  PerWheel beside_{};                    // turned by the other one of its side in them [rad]
  int out_{-1};                          // wheel that does not brake
  int left_{};                           // steps
  int rest_{};                           // steps at rest
};

}  // namespace mrroc::edp
