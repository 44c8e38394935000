// Contact in the time domain: law (28) as the driver calls it, a servo integrated finely, a spring that only
// pushes. What the predictions of edp/stability.hpp are held against.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include "edp/control_law.hpp"
#include "edp/stability.hpp"

namespace mrroc::edp::test {

/// How a contact develops after a small push.
class ContactSimulation {
 public:
  /// @param loop with a LagServo, or a drive, whose regulator is the real one
  ContactSimulation(const ContactLoop& loop, double stiffness) : l_(loop), K_(stiffness) {
    // It rests with the desired force, but for a hundredth of it.
    r_ = x_ = last_x_ = y_ = 1.01 * kForce / K_;
    const double omega = 2 * std::numbers::pi * l_.gears.frequency;
    spring_ = l_.gears.mass * omega * omega;
    damper_ = 2 * l_.gears.damping * l_.gears.mass * omega;
    if (spring_ > 0) r_ = x_ = last_x_ = y_ + 1.01 * kForce / spring_;
    if (const auto* drive = std::get_if<CompensatedDrive>(&loop.servo)) {
      const DriveModel& m = drive->model;
      const double constant = m.torque_constant * m.torque_constant;
      motor_ = RegulatedDrive{{},
                              drive->increments_per_rad,
                              m.speed_per_pwm(),
                              m.resistance * drive->inertia / constant,
                              drive->inertia,
                              drive->lever};
      compensating_.emplace(drive->regulator, m, drive->increments_per_rad, loop.dt);
    } else if (const auto* original = std::get_if<RegulatedDrive>(&loop.servo)) {
      motor_ = *original;
      incremental_ = IncrementalRegulator(original->regulator);
      const double holding =
          kForce * motor_->lever / motor_->inertia * motor_->time_constant / motor_->speed_gain;
      incremental_.resume(0, 0, holding);
    } else {
      servo_ = std::get<LagServo>(loop.servo);
    }
    if (motor_ && spring_ > 0) {
      const double rotor = motor_->inertia - l_.gears.mass * motor_->lever * motor_->lever;
      motor_->time_constant *= rotor / motor_->inertia;
      motor_->inertia = rotor;
    }
    readings_.assign(static_cast<std::size_t>(l_.delay + l_.average), 1.01 * kForce);
    filtered_ = 1.01 * kForce;
    reading_ = 1.01 * kForce;
  }

  /// @return whether what is left of the push grows, or has grown until the contact breaks
  [[nodiscard]] bool unstable(int steps = 4000) {
    double early = 0, late = 0;
    for (int k = 0; k < steps; ++k) {
      const double off = step() - kForce;
      if (k >= steps / 4 && k < steps / 2) early += off * off;
      if (k >= 3 * steps / 4) late += off * off;
    }
    const double pushed = steps / 4. * 1e-4 * kForce * kForce;
    return late > std::max(early, 1e-20) || late > pushed;
  }

  /// @param steps of a third of the time that is looked at: the first one lets the fast modes die away
  /// @return factor of what is left of the push from step to step
  [[nodiscard]] double decay(double steps) {
    const int third = static_cast<int>(std::ceil(std::min(steps, 6e4)));
    std::array<double, 3> squares{};
    for (double& sum : squares)
      for (int k = 0; k < third; ++k) {
        const double off = step() - kForce;
        sum += off * off;
      }
    return std::pow(squares[2] / squares[1], 0.5 / third);
  }

 private:
  static constexpr double kForce = 10;  // [N]
  static constexpr int kSubsteps = 40;

  double step() {
    readings_.push_front(reading_);
    readings_.pop_back();
    double mean = 0;
    for (int k = 0; k < l_.average; ++k) mean += readings_[static_cast<std::size_t>(l_.delay + k)];
    mean /= l_.average;
    const double keep = l_.low_pass > 0 ? std::exp(-2 * std::numbers::pi * l_.low_pass * l_.dt) : 0;
    filtered_ = keep * filtered_ + (1 - keep) * mean;
    v_ = axis_velocity(c(kForce, l_.inertia, l_.mobility), filtered_, v_, l_.dt);
    if (motor_) regulate();
    const double h = l_.dt / kSubsteps;
    double sum = 0;
    const double before_step = s_;
    for (int k = 0; k < kSubsteps; ++k) {
      const double before = push();
      if (spring_ > 0) {
        s_ += h * (load() - push()) / l_.gears.mass;
        y_ += h * s_;
      }
      move(h);
      sum += (before + push()) / 2;
    }
    reading_ = l_.mean_of_step ? sum / kSubsteps : push();
    if (spring_ > 0)
      reading_ +=
          l_.gears.tool * (l_.mean_of_step ? (s_ - before_step) / l_.dt : (load() - push()) / l_.gears.mass);
    return push();
  }

  [[nodiscard]] double push() const {
    const bool rigid = spring_ == 0;
    return std::max(0.0, K_ * (rigid ? x_ : y_) + K_ * l_.contact_damping * (rigid ? w_ : s_));
  }
  /// @return force of the tip on what moves it: the surroundings', or that of the gears' spring
  [[nodiscard]] double load() const {
    return spring_ > 0 ? spring_ * (x_ - y_) + damper_ * (w_ - s_) : push();
  }

  /// The compensating regulator is told the load of the desired force.
  void regulate() {
    const double increments = motor_->increments_per_rad / motor_->lever;
    const double wanted = v_ * l_.dt * increments;
    if (set_ == 0) set_ = x_;
    pwm_ = compensating_ ? compensating_->step(wanted, (set_ - x_) * increments, kForce * motor_->lever)
                         : incremental_.step(wanted, (x_ - last_x_) * increments);
    set_ += v_ * l_.dt;
    last_x_ = x_;
  }

  void drive(double h) {
    const double x = x_, w = w_;
    const double middle = w + acceleration() * h / 2;
    x_ += w * h / 2;
    w_ = middle;
    w_ = w + acceleration() * h;
    x_ = x + middle * h;
  }
  /// @return of the tip, with its present position and speed
  [[nodiscard]] double acceleration() const {
    const RegulatedDrive& m = *motor_;
    return (m.speed_gain * pwm_ * m.lever - w_) / m.time_constant - load() * m.lever * m.lever / m.inertia;
  }

  /// Midpoint rule.
  void move(double h) {
    if (motor_) return drive(h);
    const double r = r_ + v_ * h / 2;
    if (servo_.order == 1) {
      const double omega = 2 * std::numbers::pi * servo_.bandwidth;
      const double x = x_ + omega * (r_ - x_) * h / 2;
      w_ = omega * (r - x);
      x_ += w_ * h;
      w_ = omega * (r_ + v_ * h - x_);
    } else {
      const double x = x_ + w_ * h / 2, w = w_ + pull(r_, x_, w_) * h / 2;
      x_ += w * h;
      w_ += pull(r, x, w) * h;
    }
    r_ += v_ * h;
  }
  [[nodiscard]] double pull(double r, double x, double w) const {
    const double omega = 2 * std::numbers::pi * servo_.bandwidth;
    return omega * omega * (r - x) + 2 * servo_.damping * omega * (servo_.feed_forward * v_ - w);
  }

  ContactLoop l_;
  LagServo servo_;
  std::optional<RegulatedDrive> motor_;
  std::optional<CompensatingRegulator> compensating_;
  IncrementalRegulator incremental_;
  double set_{}, pwm_{}, last_x_{};
  double K_;
  double spring_{}, damper_{};  // of the gears, 0: rigid
  double r_{}, x_{}, w_{}, v_{};
  double y_{}, s_{};  // the links' place and speed where gears give way; then x and w are the rotor's
  double reading_{}, filtered_{};
  std::deque<double> readings_;
};

/// @param unstable whether contact of that stiffness is; false at low, true at high
/// @return the stiffness between, by bisection
template <class Unstable>
double limit_between(double low, double high, double precision, Unstable unstable) {
  while (high / low > 1 + precision) {
    const double middle = std::sqrt(low * high);
    (unstable(middle) ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

/// Where a contact stiffer than the first unstable one may be stable again.
/// @return the smallest unstable stiffness from low on, high when there is none
template <class Unstable>
double first_limit(double low, double high, double precision, Unstable unstable) {
  constexpr double kStride = 1.05;
  while (low < high && !unstable(low)) low *= kStride;
  return low < high ? limit_between(low / kStride, low, precision, unstable) : high;
}

/// @return a loop as tasks might have it
template <class Random>
ContactLoop random_loop(Random& random) {
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>(0, 1)(random));
  };
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution<>(low, high)(random); };
  ContactLoop l;
  l.inertia = between(1, 50);
  l.mobility = between(5e-4, 0.02);
  l.dt = between(5e-4, 5e-3);
  l.delay = whole(0, 2);
  l.average = whole(1, 4);
  l.low_pass = whole(0, 3) == 0 ? between(20, 100) : 0;
  l.mean_of_step = whole(0, 3) > 0;
  l.contact_damping = whole(0, 1) * between(1e-4, 2e-3);
  l.servo = LagServo{between(5, 50), whole(1, 2), between(0.4, 1.2), between(1e-3, 1)};
  return l;
}

/// @return such a loop with the drive that an arm's table has: regulator and model as they are, another inertia
template <class Random>
ContactLoop random_loop(Random& random, CompensatedDrive drive) {
  ContactLoop l = random_loop(random);
  drive.inertia *= std::uniform_real_distribution<>(0.7, 1.4)(random);
  drive.model.friction = 0;
  drive.model.current_limit = drive.model.max_current = std::numeric_limits<double>::infinity();
  l.servo = drive;
  return l;
}

/// @return such a loop with gears whose mode is that of arms of this class, with servo or drive as it is
template <class Random>
ContactLoop elastic(Random& random, ContactLoop l) {
  l.gears.frequency = std::uniform_real_distribution<>(8, 15)(random);
  l.gears.damping = std::uniform_real_distribution<>(0.01, 0.1)(random);
  l.gears.tool = std::uniform_real_distribution<>(0, 2)(random);
  l.gears.mass = std::uniform_real_distribution<>(5, 20)(random);
  const double share =
      std::uniform_real_distribution<>(0.2, 0.7)(random);  // of the links in a drive's inertia
  if (const auto* drive = std::get_if<CompensatedDrive>(&l.servo))
    l.gears.mass = share * drive->inertia / (drive->lever * drive->lever);
  return l;
}

/// @return such a loop with the original's regulator: its drive as it is, other coefficients
template <class Random>
ContactLoop random_loop(Random& random, RegulatedDrive drive) {
  ContactLoop l = random_loop(random);
  const auto about = [&](double value) {
    return value * std::uniform_real_distribution<>(0.8, 1.25)(random);
  };
  const double zero = drive.regulator.b1 / drive.regulator.b0;
  drive.regulator.epsilon = std::uniform_real_distribution<>(0, 0.03)(random);
  drive.regulator.a = about(drive.regulator.a);
  drive.regulator.b0 = about(drive.regulator.b0);
  drive.regulator.b1 = drive.regulator.b0 * zero;
  l.dt = 0.002;  // which the coefficients are for
  l.servo = drive;
  return l;
}

}  // namespace mrroc::edp::test
