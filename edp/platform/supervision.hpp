// Supervises the wheels of a platform: detects what must stop it at once.
#pragma once
#include <array>
#include <optional>

#include "edp/platform/platform.hpp"

namespace mrroc::edp {

/// Judges each wheel once in an iteration. Real-time safe.
class WheelSupervision {
 public:
  /// A wheel stands for too long when a larger torque [N m] is to turn it and it does not for so many iterations, or for the
  /// time in which it was to turn by so much [rad]: a tracker that sees a wheel stand drives all four as much as it may. If it
  /// seems to be the encoder, that time is enough with any torque that does not brake it.
  static constexpr double kTorque = 6;
  static constexpr int kBlocked = 15;
  static constexpr double kMissed = 0.25;
  /// Then it is blocked, if the other one of its side turns by less than this share of what it is to in most iterations, or if the platform began
  /// to turn to that side by more than so much beyond the way [rad/s^2] as it did: a blocked wheel drags its side, with nominal
  /// friction four times as much. Else it is the encoder that stands. On slippery ground the two look alike.
  static constexpr double kFollows = 0.8;
  static constexpr double kDrags = 1.5;
  /// Below the first speed a wheel stands, above the second it is to turn [rad/s]: a wheel of 0.15 m rolls at 0.05 m/s with 0.33.
  static constexpr double kStands = 0.05;
  static constexpr double kTurns = 0.3;
  /// An encoder is wrong, too, when it stands although no torque holds its wheel and the other one of its side turns, or when
  /// it differs from the estimate by more than kResidual [rad/s], sixteen of its standard deviations, for so many iterations.
  static constexpr int kWrong = 10;
  static constexpr double kResidual = 0.8;

  /// @param platform  lives longer than this object
  explicit WheelSupervision(const PlatformProperties& platform) noexcept : platform_(&platform) {}

  /// @param stage     measured, with the torques since the stage before
  /// @param estimate  of that stage
  /// @param wanted    point of the reference that the platform followed since the stage before; v = w = 0 when it did not
  /// @return wheel_blocked or encoder_fault with the wheel as axis, or nothing
  [[nodiscard]] std::optional<Fault> step(const StageReading& stage, const PlatformEstimate& estimate,
                                          const PathPoint& wanted) noexcept;
  /// The drives brake: what was seen before means nothing.
  void forget() noexcept {
    blocked_ = wrong_ = {};
    missed_ = {};
    stood_ = dragged_ = {};
    follows_ = {};
  }

 private:
  struct Wheel;
  [[nodiscard]] Wheel seen(std::size_t k, const StageReading& stage, const PathPoint& wanted) const noexcept;
  [[nodiscard]] bool is_dragged(std::size_t k, const Wheel& wheel) noexcept;
  [[nodiscard]] bool side_follows(std::size_t k, const Wheel& wheel) noexcept;
  [[nodiscard]] std::optional<Fault> stands_too_long(std::size_t k, const Wheel& wheel) noexcept;
  [[nodiscard]] std::optional<Fault> contradicts(std::size_t k, const Wheel& wheel,
                                                 double estimated) noexcept;

  const PlatformProperties* platform_;
  std::array<int, kWheels> blocked_{};     // iterations
  PerWheel missed_{};                      // [rad]
  std::array<bool, kWheels> stood_{};      // an iteration before
  std::array<bool, kWheels> dragged_{};    // its side, when it began to stand
  std::array<PerWheel, 2> side_before_{};  // its Wheel::side an iteration before, and two [rad/s]
  std::array<int, kWheels> follows_{};     // iterations in which its side did, less those in which it did not
  std::array<int, kWheels> wrong_{};
};

}  // namespace mrroc::edp
