#include "ecp/generators/polynomials.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::ecp {
namespace {

constexpr int kSamples = 256;          // of a piece, when its extremes are looked for
constexpr double kSampleRoom = 1.001;  // an extreme between two samples is this much larger at most

}  // namespace

Polynomials::Polynomials(std::vector<double> times, std::vector<Coefficients> coefficients,
                         const Coordinates& end)
    : times_(std::move(times)), pieces_(std::move(coefficients)), end_(end) {}

Coordinates Polynomials::derivative(double t, int order) const {
  const double time = std::clamp(times_.front() + t, times_.front(), times_.back());
  const auto behind = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
  const auto piece = static_cast<std::size_t>(behind - times_.begin()) - 1;
  const double tau = time - times_[piece];
  Coordinates value = Coordinates::Zero(end_.size());
  for (int k = 5; k >= order; --k) {
    double factor = 1;
    for (int j = 0; j < order; ++j) factor *= k - j;
    value = (value * tau + factor * pieces_[piece].col(k)).eval();
  }
  return value;
}

double Polynomials::slowing(const MotionLimits& limits) const {
  double factor = 1;
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece)
    for (int k = 0; k <= kSamples; ++k) {
      const double share = static_cast<double>(k) / kSamples * (1 - 1e-12);
      const double t = times_[piece] - times_.front() + share * (times_[piece + 1] - times_[piece]);
      const Coordinates v = derivative(t, 1).cwiseAbs().cwiseQuotient(limits.velocity);
      const Coordinates a = derivative(t, 2).cwiseAbs().cwiseQuotient(limits.acceleration);
      factor = std::max(
          {factor, kSampleRoom * v.maxCoeff(), std::sqrt(kSampleRoom * std::max(0.0, a.maxCoeff()))});
    }
  return factor;
}

}  // namespace mrroc::ecp
