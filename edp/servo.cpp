#include "edp/servo.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::edp {
namespace {

/// A set position that moves less than this in a step stands [increments]: rounding of the kinematics.
constexpr double kStanding = 1e-6;

}  // namespace

Servo::Servo(const Robot& robot) noexcept : robot_(&robot) {
  for (int k = 0; k < robot.axes(); ++k)
    regulators_[static_cast<std::size_t>(k)] = IncrementalRegulator(robot.axis(k).regulator);
}

void Servo::reset() noexcept {
  for (IncrementalRegulator& regulator : regulators_) regulator.reset();
  unseen_.fill(0);
}

void Servo::braked(const AxisVector& measured_increment) noexcept {
  for (int k = 0; k < robot_->axes(); ++k) unseen_[static_cast<std::size_t>(k)] += measured_increment[k];
}

double Servo::seen(std::size_t motor, double set_increment, double measured_increment) noexcept {
  double& unseen = unseen_[motor];
  unseen += measured_increment;
  const double play = std::abs(set_increment) < kStanding ? kPlay : 0;
  const double kept = std::clamp(unseen, -play, play);
  const double told = unseen - kept;
  unseen = kept;
  return told;
}

std::array<double, kMaxAxes> Servo::step(const AxisVector& set_increment,
                                         const AxisVector& measured_increment) noexcept {
  std::array<double, kMaxAxes> pwm{};
  for (int k = 0; k < robot_->axes(); ++k) {
    const auto motor = static_cast<std::size_t>(k);
    const double set = set_increment[k] * robot_->axis(k).increments_per_rad;
    pwm[motor] = regulators_[motor].step(set, seen(motor, set, measured_increment[k]));
  }
  return pwm;
}

}  // namespace mrroc::edp
