#include "edp/oscillation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "edp/control_law.hpp"
#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

constexpr double kNoise = 1. / 6;    // hysteresis over the swing that matters
constexpr double kRinging = 1. / 3;  // hysteresis over the last swing
constexpr double kRegular = 0.7;     // least factor between neighbouring swings
constexpr double kNear = 0.3;        // of the gears' mode, which contact and servo shift
constexpr double kUneven = 2;        // longest over shortest period
constexpr double kJump = 0.2;        // of a period, half of it that is shorter is a jump
constexpr double kTouching = 0.25;   // force of a contact that is kept, over the swing that matters

}  // namespace

bool is_usable(const OscillationParameters& p) noexcept {
  return p.force > 0 && p.torque > 0 && p.growth >= 1 && p.sustained > 0 && p.periods >= 2 &&
         p.periods <= kMostPeriods && p.lowest > 0 && p.highest > p.lowest && p.softest > 0 &&
         p.softest <= 1 && p.gears >= 0 && p.gears <= 100;
}

AxisSet force_axes(const TaskFrameCommand& rows) noexcept {
  AxisSet set;
  for (const Axis a : kAxes) set[static_cast<std::size_t>(a)] = behaving(rows[a]).mobility > 0;
  return set;
}

Fault with_law(const Fault& swings, const TaskFrameCommand& rows) noexcept {
  const AxisCommand& row = rows[static_cast<Axis>(swings.axis)];
  std::array<char, 160> text{};
  const std::string_view told = swings.text.view();
  std::snprintf(text.data(), text.size(), "%.*s; I = %g, B = %g", static_cast<int>(told.size()), told.data(),
                row.inertia, row.mobility);
  Fault fault = swings;
  fault.text = std::string_view(text.data());
  return fault;
}

AxisSet OscillationObserver::swinging(const Wrench& F_a, AxisSet watched) noexcept {
  forget(~watched);
  AxisSet found;
  for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
    History& h = axes_[axis];
    if (!watched[axis] || !turned(h, F_a.v[axis], least(axis))) continue;
    if (h.count < static_cast<std::size_t>(2 * p_.periods)) continue;
    // After a trough the effector is about to press.
    const bool at_peak = std::abs(h.extremum) > std::abs(h.best);
    const double needed = period(h, 0).swing < 2 * least(axis) ? p_.growth : p_.sustained;
    found[axis] = at_peak && regular(h, least(axis)) && factor(h) >= needed;
  }
  return found;
}

std::optional<Fault> OscillationObserver::step(const Wrench& F_a, AxisSet watched) noexcept {
  const AxisSet found = swinging(F_a, watched);
  for (std::size_t axis = 0; axis < axes_.size(); ++axis)
    if (found[axis] && !jumps(axes_[axis], least(axis))) return told(axis);
  return {};
}

void OscillationObserver::forget(AxisSet axes) noexcept {
  for (std::size_t axis = 0; axis < axes_.size(); ++axis)
    if (axes[axis] && axes_[axis].begun) axes_[axis] = {};
}

bool OscillationObserver::turned(History& h, double force, double least) const noexcept {
  if (!h.begun) {
    h.begun = true;
    h.extremum = h.best = force;
    return false;
  }
  ++h.since_extremum;
  ++h.since_best;
  if (h.rising ? force >= h.best : force <= h.best) {
    h.best = force;
    h.since_best = 0;
    return false;
  }
  double hysteresis = kNoise * least;
  if (h.count > 0 && h.since_extremum * dt_ * p_.lowest < 1)
    hysteresis = std::max(hysteresis, kRinging * h.half[(h.count - 1) % kMostHalves].swing);
  if (std::abs(force - h.best) < hysteresis) return false;
  const bool same_sign = h.best * h.extremum > 0;
  const Half half{std::abs(h.best - h.extremum), h.since_extremum - h.since_best,
                  same_sign ? std::min(std::abs(h.best), std::abs(h.extremum)) : 0};
  if (h.certain) h.half[h.count++ % kMostHalves] = half;
  h.certain = true;
  h.extremum = h.best;
  h.since_extremum = h.since_best;
  h.best = force;
  h.since_best = 0;
  h.rising = !h.rising;
  return true;
}

OscillationObserver::Period OscillationObserver::period(const History& h, int back) const noexcept {
  const std::size_t last = h.count - 1 - 2 * static_cast<std::size_t>(back);
  const Half& a = h.half[last % kMostHalves];
  const Half& b = h.half[(last - 1) % kMostHalves];
  return {(a.swing + b.swing) / 2, (a.steps + b.steps) * dt_};
}

double OscillationObserver::factor(const History& h) const noexcept {
  return std::pow(period(h, 0).swing / period(h, p_.periods - 1).swing, 1. / (p_.periods - 1));
}

bool OscillationObserver::jumps(const History& h, double least) const noexcept {
  int found = 0;
  for (int back = 0; back < p_.periods; ++back) {
    const std::size_t last = h.count - 1 - 2 * static_cast<std::size_t>(back);
    const Half& a = h.half[last % kMostHalves];
    const Half& b = h.half[(last - 1) % kMostHalves];
    const bool kept = std::min(a.least, b.least) > kTouching * least;
    found += kept && std::min(a.steps, b.steps) < kJump * (a.steps + b.steps) ? 1 : 0;
  }
  return 2 * found >= p_.periods;
}

bool OscillationObserver::regular(const History& h, double least) const noexcept {
  double shortest = 1 / p_.lowest, longest = 1 / p_.highest;
  for (int back = 0; back < p_.periods; ++back) {
    const Period now = period(h, back);
    if (now.swing < least || now.time > 1 / p_.lowest || now.time < 1 / p_.highest) return false;
    shortest = std::min(shortest, now.time);
    longest = std::max(longest, now.time);
    if (back > 0 && period(h, back - 1).swing < kRegular * now.swing) return false;
  }
  return longest <= kUneven * shortest;
}

Fault OscillationObserver::told(std::size_t axis) const noexcept {
  const History& h = axes_[axis];
  double time = 0;
  for (int back = 0; back < p_.periods; ++back) time += period(h, back).time;
  constexpr std::array kNames{"x", "y", "z", "ax", "ay", "az"};
  const double frequency = p_.periods / time;
  const bool of_gears = std::abs(frequency - p_.gears) < kNear * p_.gears;
  std::array<char, 120> text{};
  std::snprintf(text.data(), text.size(), "along %s of E at %.1f Hz, %.2f times larger with each period%s",
                kNames[axis], frequency, factor(h), of_gears ? "; the gears give way there" : "");
  return make_fault(FaultCode::contact_unstable, text.data(), static_cast<int>(axis), period(h, 0).swing,
                    least(axis));
}

}  // namespace mrroc::edp
