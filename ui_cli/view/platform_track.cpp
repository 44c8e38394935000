#include "ui_cli/view/platform_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <span>

#include "base/msg/convert_platform.hpp"
#include "ui_cli/view/samples.hpp"

namespace mrroc::view {
namespace {

constexpr double kStep = kPlatformPeriod / kPlatformSteps;  // of the effector drivers [s]

/// A row that is filled from the left.
template <std::size_t N>
class Row {
 public:
  /// What is no number becomes 0.
  template <class T>
  requires std::integral<T> || std::floating_point<T> Row& put(T number) {
    const auto x = static_cast<double>(number);
    row_[next_++] = std::isnan(x) ? 0 : drawn(x);
    return *this;
  }
  Row& put(const PlanarPose& p) { return put(p.x).put(p.y).put(p.phi); }
  Row& put(const PlanarVelocity& v) { return put(v.vx).put(v.vy).put(v.w); }
  Row& put(const Slip& s) { return put(s.mu_x).put(s.mu_y).put(s.split); }
  template <class T, std::size_t M>
  Row& put(const std::array<T, M>& many) {
    for (const T& one : many) put(one);
    return *this;
  }
  [[nodiscard]] std::span<const float> numbers() const { return row_; }

 private:
  std::array<float, N> row_{};
  std::size_t next_{};
};

/// @return the slip coefficients that say of the wheels together what stands below each
Slip ground_below(const PlatformTruth& truth) {
  Slip slip{0, 0, 0};
  double left = 0;
  double right = 0;
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    const auto& [along, across] = truth.friction[wheel];
    slip.mu_x += along / kWheels;
    slip.mu_y += across / kWheels;
    (wheel % 2 == 0 ? left : right) += along;
  }
  if (left + right > 0) slip.split = (left - right) / (left + right);
  return slip;
}

/// @param told  by platform: the number told last, which that number becomes
/// @return whether it is another one. A damaged number that is too large hides none of those that follow
bool is_another(std::map<std::string, std::int64_t>& told, const std::string& name, std::int64_t number) {
  std::int64_t& last = told[name];
  if (number <= 0 || number == last) return false;
  last = number;
  return true;
}

}  // namespace

void PlatformTracks::take(const std::string& name, const platform_reply_t& m, int behaviour) {
  if (!is_proper(m) || m.position_known == 0) return;
  const PlatformReply r = from_message(m);
  const PlanarCovariance& c = r.estimate.covariance;
  Row<kPlatformColumns.size()> row;
  row.put(static_cast<double>(r.estimate.step) * kStep).put(behaviour);
  row.put(static_cast<double>(r.step) * kStep).put(r.estimate.p).put(r.estimate.v).put(r.estimate.theta);
  row.put(c[0]).put(c[1]).put(c[4]).put(r.slip).put(r.slip_sd).put(r.torque);
  row.put(r.executing).put(r.iteration).put(r.remaining);
  record_.add("platform:" + name, row.numbers());
}

void PlatformTracks::take(const std::string& name, const platform_telemetry_t& m) {
  if (!is_proper(m)) return;
  const PlatformTelemetry t = from_message(m);
  static_assert(kTelemetryColumns == 1 + 6 * kHorizonPoints);
  Row<kTelemetryColumns> row;
  row.put(static_cast<double>(t.step) * kStep).put(t.reference).put(t.horizon);
  record_.add("telemetry:" + name, row.numbers());
}

void PlatformTracks::take(const std::string& name, const platform_truth_t& m) {
  if (!is_proper(m)) return;
  const PlatformTruth t = from_message(m);
  Row<kTruthColumns> row;
  row.put(static_cast<double>(m.header.stamp) * kPlatformPeriod).put(t.p).put(ground_below(t));
  record_.add("truth:" + name, row.numbers());
}

void PlatformTracks::take(const std::string& name, const box_truth_t& m) {
  if (!std::ranges::all_of(m.p, [](double x) { return std::isfinite(x); })) return;
  Row<kBoxColumns> row;
  row.put(static_cast<double>(m.header.stamp) * kPlatformPeriod).put(m.p[0]).put(m.p[1]).put(m.p[2]);
  record_.add("box:" + name, row.numbers());
}

void PlatformTracks::take(const std::string& name, const plan_t& m, double t) {
  if (!is_proper(m) || !is_another(plans_, name, m.number)) return;
  for (std::int32_t k = 0; k < m.n; ++k) {
    Row<kPlanColumns> row;
    row.put(t).put(m.number).put(m.point[k][0]).put(m.point[k][1]);
    record_.add("plan:" + name, row.numbers());
  }
}

void PlatformTracks::take(const std::string& name, const platform_command_t& m) {
  const PlatformCommand c = from_message(m);
  const Fragment& f = c.fragment;
  const bool finite = std::ranges::all_of(f.knot, [](const PathPoint& k) {
    return std::isfinite(k.p.x) && std::isfinite(k.p.y) && std::isfinite(k.p.phi);
  });
  if (c.instruction != Instruction::set || !finite || !is_another(fragments_, name, f.number)) return;
  static_assert(kFragmentColumns == 4 + 3 * kFragmentKnots);
  Row<kFragmentColumns> row;
  row.put(static_cast<double>(c.macrostep) * kPlatformPeriod).put(f.number).put(f.steps).put(f.notify);
  for (const PathPoint& knot : f.knot) row.put(knot.p);
  record_.add("fragment:" + name, row.numbers());
}

}  // namespace mrroc::view
