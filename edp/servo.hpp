// EDP_SERVO: the position regulators of all motors.
#pragma once
#include <array>

#include "base/hardware.hpp"
#include "edp/regulator.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// One regulator per motor, in encoder increments as real numbers: the fractions of a slow motion are not
/// lost. While a set position stands, its regulator does not see the shaft move within kPlay: it would answer
/// every edge of the encoder with a jolt, and the arm would never be at rest. Real-time safe.
class Servo {
 public:
  explicit Servo(const Robot& robot) noexcept;

  /// Forgets the past: the motors are where they are set to be.
  void reset() noexcept;

  /// One step. @param set_increment       motion of the set positions in this step [rad]
  /// @param measured_increment  motion of the shafts in the step before [encoder increments]
  /// @return duty cycles [1/255 of the supply]; zero beyond the robot's axes
  [[nodiscard]] std::array<double, kMaxAxes> step(const AxisVector& set_increment,
                                                  const AxisVector& measured_increment) noexcept;

  /// One step in which the brakes hold the shafts: the regulators wait, and hear later how far the shafts
  /// moved.
  void braked(const AxisVector& measured_increment) noexcept;

  /// Motion of a shaft about its place that a standing regulator does not see, to either side [increments].
  static constexpr double kPlay = 1;

 private:
  [[nodiscard]] double seen(std::size_t motor, double set_increment, double measured_increment) noexcept;

  const Robot* robot_;
  std::array<IncrementalRegulator, kMaxAxes> regulators_;
  std::array<double, kMaxAxes> unseen_{};  // motion that the regulators have not been told [increments]
};

}  // namespace mrroc::edp
