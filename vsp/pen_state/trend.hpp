// Removes the tremor of a hand from a signal.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mrroc::vsp {

/// The mean over a time T, taken twice: y = M M x with (M x)(t) = 1/T integral of x over the last T. A swing of
/// frequency f passes with the factor (sin(pi f T) / (pi f T))^2: none of it at multiples of 1/T, at most 5 % above 1/T.
/// The delay is T, whatever the signal. Real-time safe.
class Trend {
 public:
  /// Longest T, in samples.
  static constexpr std::size_t kMost = 250;

  /// @param samples  of T, 1..kMost
  explicit Trend(std::size_t samples) : n_(std::clamp<std::size_t>(samples, 1, kMost)) {}

  /// Forgets everything; the signal has always been x.
  void begin(double x) {
    x_.fill(x);
    mean_.fill(x);
    sum_ = sum_of_means_ = x * static_cast<double>(n_);
    rise_ = 0;
    k_ = 0;
  }
  /// Takes the next sample.
  void add(double x) {
    sum_ += x - x_[k_];
    x_[k_] = x;
    const double mean = sum_ / static_cast<double>(n_);
    rise_ = mean - mean_[k_];
    sum_of_means_ += rise_;
    mean_[k_] = mean;
    k_ = (k_ + 1) % n_;
  }
  /// @return y, as it was a time T ago
  [[nodiscard]] double value() const { return sum_of_means_ / static_cast<double>(n_); }
  /// @return change of y in one sample
  [[nodiscard]] double rate() const { return rise_ / static_cast<double>(n_); }

 private:
  std::size_t n_;
  std::size_t k_{};  // of the oldest sample
  std::array<double, kMost> x_{}, mean_{};
  double sum_{}, sum_of_means_{};
  double rise_{};  // of the mean since T ago
};

}  // namespace mrroc::vsp
