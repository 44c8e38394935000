#include "edp/servo.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::edp {
namespace {

/// A set position that moves less than this in a step stands [increments]: rounding of the kinematics.
constexpr double kStanding = 1e-6;

constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

}  // namespace

Servo::Servo(const Robot& robot, double dt) : robot_(&robot) {
  for (int k = 0; k < robot.axes(); ++k) {
    const AxisProperties& axis = robot.axis(k);
    Motor& motor = motors_[index(k)];
    motor.choice = axis.servo.standard;
    motor.increments_per_rad = axis.increments_per_rad;
    for (std::size_t set = 0; set < kServoSets; ++set) {
      motor.incremental[set] = IncrementalRegulator(axis.servo.incremental[set]);
      motor.compensating[set] =
          CompensatingRegulator(axis.servo.compensating[set], axis.servo.drive, axis.increments_per_rad, dt);
    }
  }
}

bool Servo::select(int motor, int algorithm_no, int parameter_set_no) noexcept {
  if (motor < 0 || motor >= robot_->axes() || !known(algorithm_no, parameter_set_no)) return false;
  Motor& m = motors_[index(motor)];
  const ServoChoice choice{algorithm_no, parameter_set_no};
  if (choice == m.choice) return true;
  if (!m.driven) {  // every regulator is as new
    m.choice = choice;
    return true;
  }
  CompensatingRegulator& compensating = m.compensating[index(parameter_set_no)];
  if (algorithm_no == 0)
    m.incremental[index(parameter_set_no)].resume(m.error, m.last_set - m.last_seen, m.pwm);
  else if (m.choice.algorithm_no == algorithm_no)
    compensating.resume(m.compensating[index(m.choice.parameter_set_no)], m.pwm);
  else
    compensating.resume(m.last_set, m.error, m.pwm);
  m.choice = choice;
  return true;
}

std::array<bool, kMaxAxes> Servo::at_limit() const noexcept {
  std::array<bool, kMaxAxes> limited{};
  for (int k = 0; k < robot_->axes(); ++k) {
    const Motor& m = motors_[index(k)];
    limited[index(k)] =
        m.choice.algorithm_no == 1 && m.compensating[index(m.choice.parameter_set_no)].at_limit();
  }
  return limited;
}

void Servo::reset() noexcept {
  for (Motor& m : motors_) {
    for (IncrementalRegulator& regulator : m.incremental) regulator.reset();
    for (CompensatingRegulator& regulator : m.compensating) regulator.reset();
    m.error = m.unseen = m.last_set = m.last_seen = m.pwm = 0;
    m.driven = false;
  }
}

void Servo::braked(const AxisVector& measured_increment) noexcept {
  for (int k = 0; k < robot_->axes(); ++k) {
    Motor& m = motors_[index(k)];
    m.unseen += measured_increment[k];
    m.last_set = 0;
    for (CompensatingRegulator& regulator : m.compensating) regulator.restart();
  }
}

double Servo::Motor::see(double set_increment, double measured_increment) noexcept {
  unseen += measured_increment;
  const double play = choice.algorithm_no == 0 && std::abs(set_increment) < kStanding ? kPlay : 0;
  const double kept = std::clamp(unseen, -play, play);
  const double told = unseen - kept;
  unseen = kept;
  return told;
}

double Servo::Motor::step(double set_increment, double measured_increment,
                          double gravity_feed_forward) noexcept {
  last_seen = see(set_increment, measured_increment);
  const std::size_t set = index(choice.parameter_set_no);
  const double behind = error - last_seen;
  pwm = choice.algorithm_no == 0 ? incremental[set].step(set_increment, last_seen)
                                 : compensating[set].step(set_increment, behind, gravity_feed_forward);
  error = behind + set_increment;
  last_set = set_increment;
  driven = true;
  return pwm;
}

std::array<double, kMaxAxes> Servo::step(const AxisVector& set_increment,
                                         const AxisVector& measured_increment,
                                         const AxisVector& gravity_feed_forward) noexcept {
  std::array<double, kMaxAxes> pwm{};
  const int axes = robot_->axes();
  for (int k = 0; k < axes; ++k) {
    Motor& m = motors_[index(k)];
    pwm[index(k)] =
        m.step(set_increment[k] * m.increments_per_rad, measured_increment[k], gravity_feed_forward[k]);
  }
  return pwm;
}

}  // namespace mrroc::edp
