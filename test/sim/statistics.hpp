// Mean, deviation and extremes of a series.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace mrroc::sim {

class Statistics {
 public:
  void add(double x) {
    ++n_;
    sum_ += x;
    squares_ += x * x;
    least_ = std::min(least_, x);
    most_ = std::max(most_, x);
  }
  [[nodiscard]] double mean() const { return sum_ / n_; }
  [[nodiscard]] double deviation() const { return std::sqrt(std::max(0.0, squares_ / n_ - mean() * mean())); }
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double most() const { return most_; }

 private:
  int n_{};
  double sum_{}, squares_{};
  double least_{std::numeric_limits<double>::infinity()}, most_{-std::numeric_limits<double>::infinity()};
};

}  // namespace mrroc::sim
