#include "robots/rex/window_states.hpp"

#include <algorithm>

namespace mrroc::rex {

void WindowStates::shift() noexcept {
  std::move(z_.begin() + 1, z_.end(), z_.begin());
  std::move(transitions_.begin() + 1, transitions_.end(), transitions_.begin());
  linearised_ = std::max(linearised_ - 1, 0);
}

void WindowStates::linearise(const StageWindow& window) noexcept {
  for (int k = 0; k < kWindowStages; ++k)
    residuals_[static_cast<std::size_t>(k)] = window.residuals_at(k, (*this)[k]);
  for (; linearised_ < kWindowStages - 1; ++linearised_)
    transitions_[static_cast<std::size_t>(linearised_)] =
        window.transition_from(linearised_, (*this)[linearised_]);
}

// Clones have no noise: their gaps are no part of it.
double WindowStates::cost(const StageBelief& arrival, const StageMatrix& arrival_root) const noexcept {
  const StageVector error = difference(z_[0], arrival.z);
  double sum = arrival_root.triangularView<Eigen::Lower>().solve(error).squaredNorm();
  for (std::size_t k = 0; k < kStages; ++k) {
    sum += residuals_[k].r.head(residuals_[k].count).squaredNorm();
    if (k + 1 == kStages) break;
    const StageVector gap = difference(z_[k + 1], transitions_[k].z);
    for (int i = 0; i < kStageNoises; ++i)
      if (const double deviation = transitions_[k].deviation[i]; deviation > 0)
        sum += gap[i] * gap[i] / (deviation * deviation);
  }
  return sum;
}

int WindowStates::take(const Change& step, const StageWindow& window, const StageBelief& arrival,
                       const StageMatrix& arrival_root) noexcept {
  const double before = cost(arrival, arrival_root);
  const std::array<StageVector, kStages> from = z_;
  double share = 1;
  for (int halvings = 0;; ++halvings, share /= 2) {
    for (std::size_t k = 0; k < kStages; ++k) z_[k] = contained(from[k] + share * step[k]);
    renew(0);
    linearise(window);
    if (halvings == kHalvings || cost(arrival, arrival_root) <= before) return halvings;
  }
}

}  // namespace mrroc::rex
