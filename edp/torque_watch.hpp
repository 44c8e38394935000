// Detects that a motion asks a motor for more torque than it may give (MG 5: a non-fatal error).
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "base/axes.hpp"
#include "base/hardware.hpp"
#include "edp/guard.hpp"
#include "edp/robot.hpp"
#include "edp/supervision.hpp"

namespace mrroc::edp {

/// Counts the steps in succession in which a motor gives all the torque that its drive, or its regulator, allows, and gains
/// no speed by it: one that does is only being accelerated. Real-time safe.
class TorqueWatch {
 public:
  /// @param steps  that are allowed, >= 1
  explicit TorqueWatch(int steps) noexcept : allowed_(steps) {}

  /// One step in which the arm is moved.
  /// @param reading  of the step: what the drives tell of the one before
  /// @param asked    by motor: whether its regulator would have asked for more current than it may in the step before
  /// @param increment  of the encoders since the reading before  @param time  since then [s]
  /// @return excessive_torque with axis, current and limit [A] as figures, in the step after the last one allowed
  [[nodiscard]] std::optional<Fault> step(const Robot& robot, const HardwareReading& reading,
                                          const std::array<bool, kMaxAxes>& asked,
                                          const AxisVector& increment, double time) noexcept {
    for (int k = 0; k < robot.axes(); ++k) {
      const auto motor = static_cast<std::size_t>(k);
      const bool limited =
          (reading.switches[motor] & static_cast<unsigned>(AxisSwitch::current_limited)) != 0;
      count_[motor] = limited || asked[motor] ? count_[motor] + 1 : 0;
      if (count_[motor] == 0) continue;
      const AxisProperties& axis = robot.axis(k);
      const double speed = motor_speed(axis, increment[k], time);
      const double gained = (speed - speed_[motor]) * (reading.current[motor] < 0 ? -1 : 1);
      if (count_[motor] > allowed_ && gained > kGain * axis.max_motor_speed) count_[motor] = 1;
      if (count_[motor] == 1) speed_[motor] = speed;
      if (count_[motor] <= allowed_) continue;
      forget();
      return make_fault(FaultCode::excessive_torque, axis.name, k, std::abs(reading.current[motor]),
                        axis.servo.drive.current_limit);
    }
    return {};
  }
  /// The arm is not moved: nothing counts.
  void forget() noexcept { count_ = {}; }

 private:
  static constexpr double kGain = 0.05;  // of the largest speed, in the allowed steps

  int allowed_;
  std::array<int, kMaxAxes> count_{};
  std::array<double, kMaxAxes> speed_{};  // when the count began [rad/s]
};

}  // namespace mrroc::edp
