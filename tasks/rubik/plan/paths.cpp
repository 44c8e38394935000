#include "tasks/rubik/plan/paths.hpp"

#include <algorithm>
#include <cmath>

#include "base/representation.hpp"
#include "ecp/generators/polyline.hpp"
#include "ecp/generators/trajectory.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kSpacing =
    0.01;  // of the states that are checked, as the displacement of the farthest point [m]
// Lever arms of the joints, counted from the last one [m].
constexpr std::array<double, 7> kLevers{0.1, 0.4, 0.4, 1.0, 1.4, 1.4, 1.0};
constexpr int kRandomPoints = 150;
constexpr double kWide = 0.7;  // standard deviation of random points [rad]; on the track: as metres of it
constexpr double kTrackWide = 0.2;
constexpr int kSamples = 8;  // of the speed of E on a line
constexpr double kMacrostep = ecp::Pacing{}.macrostep_s();
constexpr double kTimeSpacing = 0.01;  // of the states of two arms that are checked [s]
constexpr int kLags = 2;               // that are checked, ahead and behind

double length(const AxisVector& displacement) {
  double metres = 0;
  for (Eigen::Index k = 0; k < displacement.size(); ++k)
    metres = std::max(
        metres, std::abs(displacement[k]) * kLevers[static_cast<std::size_t>(displacement.size() - 1 - k)]);
  return metres;
}

/// @return share of the motors' speed on a line with which E keeps to its own limits
double share_of_speed(const PlanCell& cell, Hand hand, const AxisVector& from, const AxisVector& to) {
  const SpeedLimits& limits = cell.limits(hand);
  const AxisVector displacement = to - from;
  const double seconds = displacement.cwiseAbs().cwiseQuotient(limits.motors.velocity).maxCoeff();
  if (seconds <= 0) return 1;
  const double part = seconds / kSamples;
  double share = 1;
  Pose before = cell.forward(hand, cell.joints(hand, from));
  for (int k = 1; k <= kSamples; ++k) {
    const Pose now =
        cell.forward(hand, cell.joints(hand, from + displacement * (static_cast<double>(k) / kSamples)));
    const double metres = (now.p - before.p).norm();
    const double angle = angle_axis_from_pose({before.R.transpose() * now.R, Vector3::Zero()}).norm();
    if (metres > 0) share = std::min(share, limits.linear * part / metres);
    if (angle > 0) share = std::min(share, limits.angular * part / angle);
    before = now;
  }
  return share;
}

ecp::Polyline curve_through(const std::vector<Waypoint>& points, const ecp::MotionLimits& motors) {
  std::vector<ecp::ViaPoint> list;
  for (std::size_t k = 1; k < points.size(); ++k)
    list.push_back({points[k].motors, points[k].speed, 1, k + 1 < points.size()});
  return {points.front().motors, list, motors, kMacrostep};
}

}  // namespace

std::vector<Waypoint> path_through(const PlanCell& cell, Hand hand, const std::vector<AxisVector>& joints) {
  std::vector<Waypoint> points;
  for (const AxisVector& q : joints) {
    Waypoint point{q, cell.motors(hand, q)};
    if (!points.empty()) point.speed = share_of_speed(cell, hand, points.back().motors, point.motors);
    points.push_back(point);
  }
  return points;
}

double seconds_along(const std::vector<Waypoint>& points, const ecp::MotionLimits& motors) {
  if (points.size() < 2) return 0;
  return std::ceil(curve_through(points, motors).duration() / kMacrostep) * kMacrostep;
}

double seconds_along(const PlanCell& cell, Hand hand, const std::vector<AxisVector>& joints) {
  return seconds_along(path_through(cell, hand, joints), cell.limits(hand).motors);
}

bool Paths::is_free(Hand hand, const AxisVector& from, const AxisVector& to, CellState state) const {
  const int parts = std::max(1, static_cast<int>(std::ceil(length(to - from) / kSpacing)));
  const AxisVector start = cell_.motors(hand, from), displacement = cell_.motors(hand, to) - start;
  // The middle first: what collides there is found soonest.
  const auto free_at = [&](int k) {
    AxisVector& joints = state.joints[index(hand)];
    joints = cell_.joints(hand, start + displacement * (static_cast<double>(k) / parts));
    return cell_.joint_limit_margin(hand, joints) > 0 && cell_.is_free(state);
  };
  for (int stride = 8; stride >= 1; stride /= 2)
    for (int k = 0; k <= parts; k += stride)
      if ((stride == 8 || k % (2 * stride) != 0) && !free_at(k)) return false;
  return free_at(parts);
}

bool Paths::is_free(Hand hand, const std::vector<AxisVector>& points, const CellState& state) const {
  for (std::size_t k = 1; k < points.size(); ++k)
    if (!is_free(hand, points[k - 1], points[k], state)) return false;
  return true;
}

bool Paths::are_free(const FreeMotion& first, const FreeMotion& second, double delay, CellState state) const {
  const ecp::Polyline one = curve_through(first.points, cell_.limits(first.hand).motors);
  const ecp::Polyline two = curve_through(second.points, cell_.limits(second.hand).motors);
  const double end = std::max(one.duration(), delay + two.duration()) + kLag;
  const auto free_at = [&](double t, double lag) {
    state.joints[index(first.hand)] = cell_.joints(first.hand, one.at(t + lag));
    state.joints[index(second.hand)] = cell_.joints(second.hand, two.at(t - delay));
    return cell_.is_free(state);
  };
  for (double t = 0; t <= end; t += kTimeSpacing)
    for (int k = -kLags; k <= kLags; ++k)
      if (!free_at(t, k * kLag / kLags)) return false;
  return true;
}

std::optional<AxisVector> Paths::drawn_back(Hand hand, const AxisVector& joints, double distance) const {
  auto back =
      cell_.inverse(hand, cell_.forward(hand, joints) * Pose{Matrix3::Identity(), {0, 0, -distance}}, joints);
  if (!back || cell_.joint_limit_margin(hand, *back) <= 0) return {};
  return back;
}

std::optional<std::vector<AxisVector>> Paths::find(Hand hand, const AxisVector& from, const AxisVector& to,
                                                   const CellState& state) const {
  if (is_free(hand, from, to, state)) return std::vector{from, to};

  std::optional<std::vector<AxisVector>> best;
  double seconds = 1e9;
  const auto consider = [&](const std::vector<AxisVector>& points) {
    const double s = seconds_along(cell_, hand, points);
    if (s >= seconds || !is_free(hand, points, state)) return;
    best = points;
    seconds = s;
  };
  const std::array distances{0.0, 0.1, 0.2, 0.3};
  for (const double first : distances)
    for (const double last : distances) {
      std::vector<AxisVector> points{from};
      if (const auto p = drawn_back(hand, from, first); p && first > 0) points.push_back(*p);
      if (const auto p = drawn_back(hand, to, last); p && last > 0) points.push_back(*p);
      points.push_back(to);
      consider(points);
    }
  if (best) return best;

  std::mt19937_64 random(1);
  const auto uniform = [&] { return 2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1; };
  for (int k = 0; k < kRandomPoints; ++k) {
    AxisVector via = (from + to) / 2;
    for (Eigen::Index j = 0; j < via.size(); ++j)
      via[j] += (via.size() > 6 && j == 0 ? kTrackWide : kWide) * (uniform() + uniform());
    if (cell_.joint_limit_margin(hand, via) > 0) consider({from, via, to});
  }
  return best;
}

}  // namespace mrroc::rubik
