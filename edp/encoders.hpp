// Converts encoder counts to motor positions.
#pragma once
#include "base/hardware.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// Incremental encoders of all motors: motor = (count - count_0) / increments_per_rad + motor_0. They mean
/// nothing before synchronise(). Real-time safe.
class Encoders {
 public:
  /// @param robot  its numbers of increments are copied
  explicit Encoders(const Robot& robot) noexcept
      : increments_per_rad_(robot.axes()), motors_at_zero_(AxisVector::Zero(robot.axes())) {
    for (int k = 0; k < robot.axes(); ++k) increments_per_rad_[k] = robot.axis(k).increments_per_rad;
  }

  /// Says that the motors stand at these positions now.
  /// @param reading counts of now  @param motors positions [rad]
  void synchronise(const HardwareReading& reading, const AxisVector& motors) noexcept {
    zero_ = reading.encoder;
    motors_at_zero_ = motors;
  }

  /// Says where one motor stands at a count of its encoder. @param position [rad]
  void set_zero(int motor, std::int32_t count, double position) noexcept {
    zero_[static_cast<std::size_t>(motor)] = count;
    motors_at_zero_[motor] = position;
  }

  /// @return motor positions [rad]
  [[nodiscard]] AxisVector motors(const HardwareReading& reading) const noexcept {
    AxisVector m = motors_at_zero_;
    for (int k = 0; k < m.size(); ++k) m[k] += difference(reading, zero_, k) / increments_per_rad_[k];
    return m;
  }

  /// Counts of one motor since others were read; right even when the counter of 32 bits has wrapped around.
  /// @return [encoder increments]
  [[nodiscard]] static double difference(const HardwareReading& now,
                                         const std::array<std::int32_t, kMaxAxes>& before,
                                         int motor) noexcept {
    const auto k = static_cast<std::size_t>(motor);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(now.encoder[k]) -
                                     static_cast<std::uint32_t>(before[k]));
  }

 private:
  AxisVector increments_per_rad_;
  std::array<std::int32_t, kMaxAxes> zero_{};
  AxisVector motors_at_zero_;
};

}  // namespace mrroc::edp
