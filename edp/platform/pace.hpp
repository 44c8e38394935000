// Pace of a fragment's time: how a pause and a stop slow the reference down without leaving its path.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/platform_command.hpp"

namespace mrroc::edp {

/// Goes from its present value to its target at a constant rate; time is counted in iterations. Real-time safe.
class Pace {
 public:
  /// Change of the pace in an iteration at most, when a pause begins or ends: the control subsystem says it at once.
  static constexpr double kChange = 0.1;
  /// The same when the platform is stopped.
  static constexpr double kStop = 1. / 15;
  /// What the speed changes by at most, up and down [m/s^2]: what tyres can give on slippery ground, too. Up to 0.6 m/s a stop is
  /// gentler; the platform is at rest in about 200 steps then.
  static constexpr double kAcceleration = 2;

  /// @param v  planned speed [m/s]  @param most  kChange or kStop  @return change of the pace in an iteration
  [[nodiscard]] static double rate(double v, double most) noexcept {
    return std::min(most, kAcceleration * kPlatformPeriod / std::max(std::abs(v), 1e-3));
  }

  /// @param target  pace to go to, 0 stands .. 1 as planned  @param rate  change in an iteration, > 0
  void go_to(double target, double rate = kChange) noexcept {
    target_ = target;
    rate_ = rate;
  }
  /// Has a pace at once, and keeps it.
  void set(double pace) noexcept { now_ = target_ = pace; }

  /// @return the present pace
  [[nodiscard]] double now() const noexcept { return now_; }
  /// @param n  iterations, >= 0  @return the pace after them
  [[nodiscard]] double after(double n) const noexcept {
    return now_ + std::clamp(target_ - now_, -rate_ * n, rate_ * n);
  }
  /// @param n  iterations, >= 0  @return time of the fragment that passes in them [iterations]
  [[nodiscard]] double passes(double n) const noexcept {
    const double changing = std::min(n, std::abs(target_ - now_) / rate_);
    return changing * (now_ + after(changing)) / 2 + (n - changing) * target_;
  }
  /// One iteration passes.
  void advance() noexcept { now_ = after(1); }

 private:
  double now_{};
  double target_{};
  double rate_{kChange};
};

}  // namespace mrroc::edp
