// Supervises the wheels of a platform: detects what must stop it at once.
#pragma once
#include <array>
#include <optional>

#include "edp/platform/platform.hpp"

namespace mrroc::edp {

/// Judges each wheel once in an iteration. Real-time safe.
class WheelSupervision {
 public:
  /// A wheel is blocked when it stands under a larger torque [N m], although it is to turn, for so many iterations.
  static constexpr double kTorque = 6;
  static constexpr int kBlocked = 15;
  /// Below the first speed a wheel stands, above the second it is to turn [rad/s]: a wheel of 0.15 m rolls at 0.05 m/s with 0.33.
  static constexpr double kStands = 0.05;
  static constexpr double kTurns = 0.3;
  /// An encoder is wrong when it stands although its wheel is to turn and the other one of its side does, or when it
  /// differs from the estimate by more than kResidual [rad/s], sixteen of its standard deviations, for so many iterations.
  static constexpr int kWrong = 10;
  static constexpr double kResidual = 0.8;
  /// No wheel turns faster, as a multiple of PlatformProperties::max_wheel_speed.
  static constexpr double kOverSpeed = 1.5;

  /// @param platform  lives longer than this object
  explicit WheelSupervision(const PlatformProperties& platform) noexcept : platform_(&platform) {}

  /// @param stage     measured, with the torques since the stage before
  /// @param estimate  of that stage
  /// @param wanted    point of the reference that the platform followed since the stage before; v = w = 0 when it did not
  /// @return wheel_blocked or encoder_fault with the wheel as axis, or nothing
  [[nodiscard]] std::optional<Fault> step(const StageReading& stage, const PlatformEstimate& estimate,
                                          const PathPoint& wanted) noexcept;
  /// The drives brake: what was seen before means nothing.
  void forget() noexcept { blocked_ = wrong_ = {}; }

 private:
  const PlatformProperties* platform_;
  std::array<int, kWheels> blocked_{};  // iterations
  std::array<int, kWheels> wrong_{};
};

}  // namespace mrroc::edp
