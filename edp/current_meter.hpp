// Statistics of the motor currents between two replies.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "base/effector_command.hpp"
#include "base/hardware.hpp"

namespace mrroc::edp {

/// Collects the currents of all motors step by step. Real-time safe.
class CurrentMeter {
 public:
  /// Takes the currents of one step. @param current [A]
  void add(const std::array<double, kMaxAxes>& current) noexcept {
    for (std::size_t k = 0; k < current.size(); ++k) {
      const double i = current[k];
      sum_[k] += i;
      squares_[k] += i * i;
      least_[k] = steps_ == 0 ? i : std::min(least_[k], i);
      greatest_[k] = steps_ == 0 ? i : std::max(greatest_[k], i);
    }
    ++steps_;
  }

  /// @return statistics of all steps since the last call; zeros when there were none
  CurrentStatistics take() noexcept {
    CurrentStatistics s;
    if (steps_ == 0) return s;
    for (std::size_t k = 0; k < sum_.size(); ++k) {
      s.mean[k] = sum_[k] / steps_;
      s.rms[k] = std::sqrt(squares_[k] / steps_);
    }
    s.least = least_;
    s.greatest = greatest_;
    *this = {};
    return s;
  }

 private:
  int steps_{};
  std::array<double, kMaxAxes> sum_{}, squares_{}, least_{}, greatest_{};
};

}  // namespace mrroc::edp
