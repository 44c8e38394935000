// Pace of a fragment's time: how a pause and a stop slow the reference down without leaving its path.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/platform_command.hpp"

namespace mrroc::edp {

/// Goes from its present value to its target at a constant rate; time is counted in iterations. Real-time safe.
class Pace {
 public:
  /// As kPaceChange, when the platform is stopped.
  static constexpr double kStop = 1. / 15;

  /// @param v  planned speed [m/s]  @param most  kPaceChange or kStop  @return change of the pace in an iteration
  [[nodiscard]] static double rate(double v, double most) noexcept {
    return std::min(most, kPaceAcceleration * kPlatformPeriod / std::max(std::abs(v), 1e-3));
  }

  /// @param target  pace to go to, 0 stands .. 1 as planned  @param rate  change in an iteration, > 0
  void go_to(double target, double rate = kPaceChange) noexcept {
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
  double rate_{kPaceChange};
};

}  // namespace mrroc::edp
