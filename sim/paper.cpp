#include "sim/paper.hpp"

#include <cmath>

namespace mrroc::sim {

Ink::Ink(const PaperParameters& parameters) : parameters_(parameters), T_P0_(parameters.T_0P.inverse()) {
  constexpr std::size_t kSamplesOfTwoMinutes = 60'000;
  points_.reserve(kSamplesOfTwoMinutes);
}

void Ink::step(const Vector3& tip, double force, double t) {
  const Vector3 at = T_P0_ * tip;
  if (at.z() > parameters_.new_stroke_height) lifted_ = true;
  if (force <= 0 || at.head<2>().cwiseAbs().maxCoeff() > parameters_.size / 2) return;
  if (lifted_) ++stroke_;
  lifted_ = false;
  points_.push_back({stroke_, t, 1e3 * at.x(), 1e3 * at.y(), force});
}

void Ink::clear() {
  points_.clear();
  stroke_ = -1;
  lifted_ = true;
}

}  // namespace mrroc::sim
