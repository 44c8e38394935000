#include "edp/platform/fragment_queue.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::edp {
namespace {

/// Rounding of times [iterations].
constexpr double kRounding = 1e-9;

PathPoint standing(const PlanarPose& p) { return {p, 0, 0}; }

}  // namespace

void FragmentQueue::push(const Fragment& fragment) noexcept {
  if (full()) return;
  constexpr double kTurn = 2 * std::numbers::pi;
  const double away = end().p.phi - fragment.knot.front().p.phi;
  Fragment& last = ring_[(first_ + count_) % kCapacity];
  last = fragment;
  for (PathPoint& knot : last.knot) knot.p.phi += kTurn * std::round(away / kTurn);
  if (empty()) time_ = 0;
  ++count_;
  accepted_ = fragment.number;
  note();
}

void FragmentQueue::note() noexcept {
  double begun = time_;  // iterations since the beginning of the fragment, negative before it
  for (std::size_t k = 0; k < count_ && (k == 0 || !full()); ++k) {
    if (begun < fragment(k).notify - kRounding) return;
    notified_ = std::max(notified_, fragment(k).number);
    begun -= fragment(k).steps;
  }
}

void FragmentQueue::advance(double iterations) noexcept {
  time_ += iterations;
  while (!empty()) {
    note();
    const double steps = front().steps;
    if (time_ < steps - kRounding) return;
    time_ = std::max(0., time_ - steps);
    held_ = front().knot.back().p;
    first_ = (first_ + 1) % kCapacity;
    --count_;
  }
}

void FragmentQueue::drop() noexcept {
  held_ = at(0).p;
  count_ = 0;
}

PathPoint FragmentQueue::at(double ahead) const noexcept {
  double time = time_ + ahead;
  for (std::size_t k = 0; k < count_; ++k) {
    const double steps = fragment(k).steps;
    if (time < steps) return point_at(fragment(k), time / steps);
    time -= steps;
  }
  return standing(end().p);
}

PathPoint FragmentQueue::end() const noexcept {
  return empty() ? standing(held_) : fragment(count_ - 1).knot.back();
}

std::int32_t FragmentQueue::iteration() const noexcept {
  return empty() ? 0 : static_cast<std::int32_t>(std::floor(time_ + kRounding));
}

std::int32_t FragmentQueue::remaining() const noexcept {
  double left = empty() ? 0 : -time_;
  for (std::size_t k = 0; k < count_; ++k) left += fragment(k).steps;
  return static_cast<std::int32_t>(std::ceil(left - kRounding));
}

}  // namespace mrroc::edp
