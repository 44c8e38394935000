#include "edp/servo.hpp"

namespace mrroc::edp {

Servo::Servo(const Robot& robot) noexcept : robot_(&robot) {
  for (int k = 0; k < robot.axes(); ++k)
    regulators_[static_cast<std::size_t>(k)] = IncrementalRegulator(robot.axis(k).regulator);
}

void Servo::reset() noexcept {
  for (IncrementalRegulator& regulator : regulators_) regulator.reset();
}

std::array<double, kMaxAxes> Servo::step(const AxisVector& set_increment,
                                         const AxisVector& measured_increment) noexcept {
  std::array<double, kMaxAxes> pwm{};
  for (int k = 0; k < robot_->axes(); ++k) {
    const auto motor = static_cast<std::size_t>(k);
    pwm[motor] =
        regulators_[motor].step(set_increment[k] * robot_->axis(k).increments_per_rad, measured_increment[k]);
  }
  return pwm;
}

}  // namespace mrroc::edp
