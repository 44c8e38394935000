// Which messages of mobile platforms have numbers that can be used.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/covariance.hpp"
#include "base/msg/convert_platform.hpp"
#include "base/msg/finite.hpp"
#include "base/msg/pose_rows.hpp"

namespace mrroc {
namespace {

/// Largest step that is believed: 63 years. Nothing overflows that is computed from it.
constexpr std::int64_t kLargestStep = 1'000'000'000'000;

template <std::size_t N>
std::array<double, N> numbers(const double (&field)[N]) noexcept {
  std::array<double, N> values{};
  std::ranges::copy(field, values.begin());
  return values;
}

bool is_step(std::int64_t step) noexcept { return step >= 0 && step <= kLargestStep; }

bool is_proper(const state_estimate_t& m) noexcept {
  return is_step(m.step) && finite(m.p) && finite(m.v) && finite(m.theta) && finite(m.theta_dot) &&
         finite(m.covariance) && m.covariance[0] >= 0 && m.covariance[4] >= 0 && m.covariance[8] >= 0;
}

bool is_proper(const map_pose_t& m) noexcept {
  return m.valid == 0 || (is_step(m.step) && finite(m.p) && is_covariance<3>(numbers(m.covariance)));
}

bool is_proper(const relative_motion_t& m) noexcept {
  return m.valid == 0 || (is_step(m.step_before) && is_step(m.step) && m.step_before < m.step &&
                          is_proper(pose_from_rows(m.A)) && is_covariance<6>(numbers(m.covariance)));
}

bool is_proper(const odometry_support_t& m) noexcept {
  return m.finding >= 0 && m.finding < kOdometryFindings && m.features >= 0 && m.matches >= 0 &&
         m.inliers >= 0 && m.cells >= 0 && m.rms_px >= 0 && std::isfinite(m.rms_px);
}

}  // namespace

bool is_proper(const platform_reply_t& m) noexcept {
  const auto counted = [](auto... counts) { return ((counts >= 0) && ...); };
  return is_step(m.step) && m.verdict >= 0 && m.verdict <= static_cast<int>(Verdict::failed) &&
         m.state >= 0 && m.state < static_cast<int>(kDriverStates) &&
         counted(m.accepted, m.notified, m.executing, m.iteration, m.remaining, m.late_odometry, m.late_map,
                 m.rejected, m.solver_failures) &&
         is_proper(m.estimate) && finite(m.slip) && finite(m.slip_sd) && finite(m.torque) && finite(m.load);
}

bool is_proper(const platform_telemetry_t& m) noexcept {
  return is_step(m.step) && finite(m.reference) && finite(m.horizon) && finite(m.torque) &&
         m.tracker_iterations >= 0 && m.estimator_iterations >= 0;
}

bool is_proper(const platform_drive_t& m) noexcept { return finite(m.torque); }

bool is_proper(const odometry_reading_t& m) noexcept { return is_proper(m.motion) && is_proper(m.support); }

bool is_proper(const motion_capture_t& m) noexcept { return is_step(m.step) && (m.seen == 0 || finite(m.p)); }

bool is_proper(const map_report_t& m) noexcept { return m.rejected >= 0 && is_proper(m.pose); }

bool is_proper(const platform_estimate_t& m) noexcept { return is_proper(m.estimate); }

bool is_proper(const plan_t& m) noexcept {
  const bool none = m.number == 0 && m.n == 0;
  const bool one = m.number > 0 && m.n > 0 && m.ahead >= 0 && m.ahead <= static_cast<int>(kPlanAhead) &&
                   m.n <= static_cast<int>(kPlanPoints) - m.ahead && m.speed > 0;
  return (none || one) && finite(m.point) && std::isfinite(m.speed);
}

bool is_proper(const fragment_order_t& m) noexcept {
  const fragment_t& f = m.fragment;
  const bool one = f.number > 0 && f.steps >= 1 && f.steps <= kMaxFragmentSteps && f.notify < f.steps &&
                   f.notify >= -kMaxFragmentSteps;
  return (f.number == 0 || one) && finite(f.knot);
}

bool is_proper(const box_truth_t& m) noexcept { return finite(m.p) && finite(m.speed) && finite(m.push); }

bool is_proper(const platform_truth_t& m) noexcept {
  return finite(m.p) && finite(m.v) && finite(m.wheel_speed) && finite(m.slip_speed) && finite(m.friction) &&
         finite(m.load) && finite(m.torque);
}

}  // namespace mrroc
