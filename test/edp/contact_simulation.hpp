// Contact in the time domain: law (28) as the driver calls it, a servo integrated finely, a spring that only
// pushes. What the predictions of edp/stability.hpp are held against.
#pragma once
#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <random>

#include "edp/control_law.hpp"
#include "edp/stability.hpp"

namespace mrroc::edp::test {

/// How a contact develops after a small push.
class ContactSimulation {
 public:
  /// @param loop with a LagServo
  ContactSimulation(const ContactLoop& loop, double stiffness)
      : l_(loop), servo_(std::get<LagServo>(loop.servo)), K_(stiffness) {
    // It rests with the desired force, but for a hundredth of it.
    r_ = x_ = 1.01 * kForce / K_;
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
    const double h = l_.dt / kSubsteps;
    double sum = 0;
    for (int k = 0; k < kSubsteps; ++k) {
      const double before = push();
      move(h);
      sum += (before + push()) / 2;
    }
    reading_ = l_.mean_of_step ? sum / kSubsteps : push();
    return push();
  }

  [[nodiscard]] double push() const { return std::max(0.0, K_ * x_ + K_ * l_.contact_damping * w_); }

  /// Midpoint rule.
  void move(double h) {
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
  double K_;
  double r_{}, x_{}, w_{}, v_{};
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

}  // namespace mrroc::edp::test
