// EDP_SERVO: the position regulators of all motors.
#pragma once
#include <array>

#include "base/hardware.hpp"
#include "edp/regulator.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// One regulator per motor, in encoder increments as real numbers: the fractions of a slow motion are not
/// lost. Real-time safe.
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

 private:
  const Robot* robot_;
  std::array<IncrementalRegulator, kMaxAxes> regulators_;
};

}  // namespace mrroc::edp
