#include "tasks/rex_drive/map_agent.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mrroc::rex_drive {
namespace {

using X = MapAgent::X;
using Matrix3 = Eigen::Matrix3d;

Matrix3 matrix_of(const PlanarCovariance& c) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(c.data());
}
double squared(double value) { return value * value; }

PlanarCovariance covariance_of(const MapParameters& k) {
  const double position = squared(k.position_sd);
  return {position, 0, 0, 0, position, 0, 0, 0, squared(k.heading_sd)};
}

/// @return whether the reading may be passed on: it fits the estimate, there is none, or the gate is open
bool is_plausible(const MapMemory& c, const MotionCapture& reading) {
  const PlatformEstimate estimate = estimate_at(c, reading.step);
  return estimate.step == 0 || c.rejected_in_a_row >= c.k.rejections ||
         distance(reading, estimate, c.k) <= kGate;
}

/// Examines a reading that has not been examined yet.
void examine(const MotionCapture& reading, std::int64_t i, MapMemory& c) {
  c.looked_at = reading.step;
  if (!reading.seen) return;
  if (!is_plausible(c, reading)) {
    ++c.rejected_in_a_row;
    ++c.report.rejected;
    return;
  }
  c.rejected_in_a_row = 0;
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
  const double t = static_cast<double>(step - nearest.step) * kPlatformPeriod / kPlatformSteps;
  const double middle = nearest.p.phi + nearest.v.w * t / 2, cs = std::cos(middle), sn = std::sin(middle);
  nearest.p.x += t * (cs * nearest.v.vx - sn * nearest.v.vy);
  nearest.p.y += t * (sn * nearest.v.vx + cs * nearest.v.vy);
  nearest.p.phi = wrap_angle(nearest.p.phi + t * nearest.v.w);
  return nearest;
}

double distance(const MotionCapture& reading, const PlatformEstimate& estimate, const MapParameters& k) {
  const Eigen::Vector3d e(reading.p.x - estimate.p.x, reading.p.y - estimate.p.y,
                          wrap_angle(reading.p.phi - estimate.p.phi));
  Matrix3 S = squared(k.trust) * matrix_of(estimate.covariance) + matrix_of(covariance_of(k));
  S.diagonal() +=
      Eigen::Vector3d(squared(k.drift_position), squared(k.drift_position), squared(k.drift_heading));
  return e.dot(S.ldlt().solve(e));
}

// clang-format off
const Motion<MapAgent> kLocate      { 1, "locate",        retain, look, nothing, nothing, tell<1>, is_lost,  "nothing plausible is seen"};
const Motion<MapAgent> kPositionGone{ 2, "position lost", retain, look, nothing, nothing, tell<2>, is_found, "a plausible reading comes"};
// clang-format on

}  // namespace mrroc::rex_drive
