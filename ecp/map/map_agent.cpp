#include "ecp/map/map_agent.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace mrroc::ecp {
namespace {

using X = MapAgent::X;
using Matrix3 = Eigen::Matrix3d;

Matrix3 matrix_of(const PlanarCovariance& c) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(c.data());
}
double squared(double value) { return value * value; }

double seconds(std::int64_t steps) { return static_cast<double>(steps) * kPlatformPeriod / kPlatformSteps; }

/// @return where a pose comes with these speeds in some steps
PlanarPose carried_on(const PlanarPose& p, const PlanarVelocity& v, std::int64_t steps) {
  const double t = seconds(steps);
  const double middle = p.phi + v.w * t / 2, cs = std::cos(middle), sn = std::sin(middle);
  return {p.x + t * (cs * v.vx - sn * v.vy), p.y + t * (sn * v.vx + cs * v.vy), wrap_angle(p.phi + t * v.w)};
}

/// @return squared Mahalanobis distance with a covariance
double distance(const PlanarPose& a, const PlanarPose& b, const Matrix3& S) {
  const Eigen::Vector3d e(a.x - b.x, a.y - b.y, wrap_angle(a.phi - b.phi));
  return e.dot(S.ldlt().solve(e));
}

PlanarCovariance covariance_of(const MapParameters& k) {
  const double position = squared(k.position_sd);
  return {position, 0, 0, 0, position, 0, 0, 0, squared(k.heading_sd)};
}

/// @return whether the reading goes on from the newest one that was believed, not long ago
bool goes_on(const MotionCapture& reading, const MapMemory& c) {
  return reading.step - c.believed.step <= kCarried * c.k.capture.period &&
         distance(reading, c.believed, c) <= kGate;
}

/// @return whether the reading agrees with the newest one that was rejected; two that cannot be compared agree
bool agrees(const MotionCapture& reading, const MapMemory& c) {
  const double d = distance(reading, c.rejected, c);
  return c.rejected.seen && (d <= kGate || std::isinf(d));
}

/// @return whether the reading may be passed on: it fits the estimate, there is none, or it goes on from readings that were
///         believed, or from as many as open the gate
bool is_plausible(const MotionCapture& reading, const MapMemory& c) {
  const PlatformEstimate estimate = estimate_at(c, reading.step);
  return estimate.step == 0 || distance(reading, estimate, c.k) <= kGate || goes_on(reading, c) ||
         (c.rejected_in_a_row >= c.k.rejections && agrees(reading, c));
}

void reject(const MotionCapture& reading, MapMemory& c) {
  c.rejected_in_a_row = agrees(reading, c) ? c.rejected_in_a_row + 1 : 1;
  c.rejected = reading;
  ++c.report.rejected;
}

/// Examines a reading that has not been examined yet.
void examine(const MotionCapture& reading, std::int64_t i, MapMemory& c) {
  c.looked_at = reading.step;
  if (!reading.seen) return;
  if (!is_plausible(reading, c)) return reject(reading, c);
  c.rejected_in_a_row = 0;
  c.rejected = {};
  c.believed = reading;
  c.plausible_in = i;
  c.report.pose = {reading.step, true, reading.p, covariance_of(c.k)};
}

void remember(const PlatformEstimate& estimate, MapMemory& c) {
  if (estimate.step <= c.estimate.front().step) return;
  std::rotate(c.estimate.begin(), c.estimate.end() - 1, c.estimate.end());
  c.estimate.front() = estimate;
}

bool lost(const MapMemory& c, std::int64_t i) { return i - c.plausible_in > c.k.timeout; }

// --- f ---------------------------------------------------------------------------------------------------------

MapMemory retain(const X& x) { return x.c; }
MapMemory look(const X& x) {
  MapMemory c = x.c;
  remember(x.T.estimate, c);
  if (x.V.step > c.looked_at) examine(x.V, x.i, c);
  if (lost(c, x.i)) c.report.pose.valid = false;
  return c;
}

/// A reading is told in the macrostep in which it is seen.
template <int m>
MapSaid tell(const X& x) {
  const MapReport report = look(x).report;
  MapSaid said;
  said.m = m;
  said.ready = true;
  said.driver_state = DriverState::ready;
  said.sensor = report.pose.valid ? kMapSeen : 0;
  said.position_known = report.pose.valid;
  const PlanarPose& p = report.pose.p;
  said.T_0E = {p.x, p.y, 0, 0, 0, p.phi};
  said.map = report;
  return said;
}

bool is_lost(const X& x) { return lost(x.c, x.i) || x.T.finished; }
bool is_found(const X& x) { return !lost(x.c, x.i) || x.T.finished; }

None nothing(const X&) { return {}; }

}  // namespace

PlatformEstimate estimate_at(const MapMemory& c, std::int64_t step) {
  const auto away = [step](const PlatformEstimate& e) { return std::abs(e.step - step); };
  PlatformEstimate nearest = c.estimate.front();
  for (const PlatformEstimate& e : c.estimate)
    if (e.step > 0 && away(e) < away(nearest)) nearest = e;
  if (nearest.step == 0) return {};
  nearest.p = carried_on(nearest.p, nearest.v, step - nearest.step);
  return nearest;
}

double distance(const MotionCapture& reading, const PlatformEstimate& estimate, const MapParameters& k) {
  Matrix3 S = squared(k.trust) * matrix_of(estimate.covariance) + matrix_of(covariance_of(k));
  S.diagonal() +=
      Eigen::Vector3d(squared(k.drift_position), squared(k.drift_position), squared(k.drift_heading));
  return distance(reading.p, estimate.p, S);
}

double distance(const MotionCapture& reading, const MotionCapture& before, const MapMemory& c) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::int64_t age = reading.step - before.step;
  if (!before.seen || age <= 0) return kFar;
  PlanarPose p = before.p;
  std::int64_t at = before.step;
  for (auto e = c.estimate.rbegin(); e != c.estimate.rend() && at < reading.step; ++e) {
    const auto next = e + 1;
    const std::int64_t until = next == c.estimate.rend() ? reading.step : std::min(next->step, reading.step);
    if (e->step == 0 || until <= at) continue;
    if (e->step > at) return kFar;
    p = carried_on(p, e->v, until - at);
    at = until;
  }
  if (at < reading.step) return kFar;
  const double t = seconds(age);
  Matrix3 S = 2 * matrix_of(covariance_of(c.k));
  const double position = squared(t * c.k.drift_speed), heading = squared(t * c.k.drift_rate);
  S.diagonal() += Eigen::Vector3d(position, position, heading);
  return distance(reading.p, p, S);
}

// clang-format off
const Motion<MapAgent> kLocate      { 1, "locate",        retain, look, nothing, nothing, tell<1>, is_lost,  "nothing plausible is seen"};
const Motion<MapAgent> kPositionGone{ 2, "position lost", retain, look, nothing, nothing, tell<2>, is_found, "a plausible reading comes"};
// clang-format on

}  // namespace mrroc::ecp
