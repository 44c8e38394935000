// Mean, standard deviation and extremes of a series.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace mrroc {

/// Statistics of all numbers that were added. Real-time safe.
class Statistics {
 public:
  /// Takes one more.
  void add(double x) {
    ++n_;
    sum_ += x;
    squares_ += x * x;
    least_ = std::min(least_, x);
    most_ = std::max(most_, x);
  }
  /// @return NaN when there are none
  [[nodiscard]] double mean() const { return sum_ / n_; }
  /// @return of these numbers, not of what they were drawn from; 0 when there are none
  [[nodiscard]] double deviation() const { return std::sqrt(std::max(0.0, squares_ / n_ - mean() * mean())); }
  /// @return infinity when there are none
  [[nodiscard]] double least() const { return least_; }
  /// @return minus infinity when there are none
  [[nodiscard]] double most() const { return most_; }

 private:
  int n_{};
  double sum_{}, squares_{};
  double least_{std::numeric_limits<double>::infinity()}, most_{-std::numeric_limits<double>::infinity()};
};

}  // namespace mrroc
