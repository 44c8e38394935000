#include "edp/platform/guard.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/covariance.hpp"
#include "base/pose.hpp"

namespace mrroc::edp {
namespace {

/// Numbers of a point, and of the axes in faults.
constexpr int kX = 0, kY = 1, kPhi = 2, kV = 3, kW = 4;

/// Whole turns are no reason to count on for ever: 150 of them.
constexpr double kMostTurned = 1000;  // [rad]
/// Farthest point of a map [m].
constexpr double kFarthest = 1e5;
/// Longest way between two pictures [m].
constexpr double kLongestWay = 1;
/// Rounding of speeds at the knots, as a share.
constexpr double kRounding = 1e-9;
/// Between the knots the polynomials may be so much quicker than the planner's way, as a share.
constexpr double kBetween = 0.02;
/// Pieces of an interval between knots that are looked at.
constexpr int kPieces = 4;

Fault bad(std::string_view text, int axis, double value, double limit = 0) {
  return make_fault(FaultCode::bad_fragment, text, axis, value, limit);
}

std::array<double, 5> numbers(const PathPoint& point) {
  return {point.p.x, point.p.y, point.p.phi, point.v, point.w};
}

ValidationError check_numbers(const PathPoint& point) {
  const std::array<double, 5> all = numbers(point);
  for (int axis = kX; axis <= kW; ++axis)
    if (const double value = all[static_cast<std::size_t>(axis)]; !std::isfinite(value))
      return bad("knots must be finite", axis, value);
  for (const int axis : {kX, kY})
    if (const double value = all[static_cast<std::size_t>(axis)]; std::abs(value) > kFarthest)
      return bad("position [m]", axis, value, kFarthest);
  if (std::abs(point.p.phi) > kMostTurned)
    return bad("unwrapped heading [rad]", kPhi, point.p.phi, kMostTurned);
  return {};
}

/// @param share  by which the speeds may be larger
ValidationError check_speeds(double v, double w, const PlatformProperties& platform, double share) {
  const double allowed = 1 + share;
  if (!(std::abs(v) <= platform.max_speed * allowed)) return bad("speed [m/s]", kV, v, platform.max_speed);
  if (!(std::abs(w) <= platform.max_turn_rate * allowed))
    return bad("turn rate [rad/s]", kW, w, platform.max_turn_rate);
  if (!(std::abs(v * w) <= platform.max_lateral_acceleration * allowed))
    return bad("lateral acceleration v w [m/s^2]", kW, v * w, platform.max_lateral_acceleration);
  return {};
}

/// Speeds of the curve itself, which the planner's numbers need not have anything to do with.
ValidationError check_between(const Fragment& fragment, const PlatformProperties& platform) {
  constexpr int kAll = kPieces * static_cast<int>(kFragmentKnots - 1);
  const double time = fragment.steps * kPlatformPeriod / kAll;
  PathPoint before = point_at(fragment, 0);
  for (int k = 1; k <= kAll; ++k) {
    const PathPoint point = point_at(fragment, static_cast<double>(k) / kAll);
    const double v = std::hypot(point.p.x - before.p.x, point.p.y - before.p.y) / time;
    const double w = (point.p.phi - before.p.phi) / time;
    if (ValidationError wrong = check_speeds(v, w, platform, kBetween)) return wrong;
    before = point;
  }
  return {};
}

}  // namespace

ValidationError check_instruction(const PlatformCommand& command) noexcept {
  switch (command.instruction) {
    case Instruction::set:
    case Instruction::synchro:
    case Instruction::query:
    case Instruction::reset:
    case Instruction::keep:
    case Instruction::release:
      return {};
    case Instruction::get:
    case Instruction::set_get:
      break;
  }
  return make_fault(FaultCode::unknown_enum, "a platform has SET, SYNCHRO, QUERY and reset", -1,
                    static_cast<double>(command.instruction));
}

ValidationError check_fragment(const Fragment& fragment, const PlatformProperties& platform) noexcept {
  if (fragment.steps < 1 || fragment.steps > kMaxFragmentSteps)
    return bad("steps, from 1", -1, fragment.steps, kMaxFragmentSteps);
  if (fragment.notify < -kMaxFragmentSteps)
    return bad("notify, from", -1, fragment.notify, -kMaxFragmentSteps);
  if (fragment.notify >= fragment.steps)
    return bad("notify, to steps - 1", -1, fragment.notify, fragment.steps - 1);
  for (const PathPoint& knot : fragment.knot) {
    if (ValidationError wrong = check_numbers(knot)) return wrong;
    if (ValidationError wrong = check_speeds(knot.v, knot.w, platform, kRounding)) return wrong;
  }
  return check_between(fragment, platform);
}

ValidationError check_join(const Fragment& fragment, std::int64_t next, const FragmentQueue& queue) noexcept {
  if (fragment.number != next)
    return bad("number of the fragment", -1, static_cast<double>(fragment.number), static_cast<double>(next));
  if (queue.full())
    return bad("fragments that wait, with this one", -1, FragmentQueue::kCapacity + 1,
               FragmentQueue::kCapacity);
  const JoinTolerance& most = queue.empty() ? kStart : kJoin;
  const PathPoint end = queue.end();
  const PathPoint& begin = fragment.knot.front();
  const std::array<std::pair<double, double>, 5> jumps{{{begin.p.x - end.p.x, most.position},
                                                        {begin.p.y - end.p.y, most.position},
                                                        {wrap_angle(begin.p.phi - end.p.phi), most.heading},
                                                        {begin.v - end.v, most.speed},
                                                        {begin.w - end.w, most.turn_rate}}};
  for (int axis = kX; axis <= kW; ++axis)
    if (const auto [jump, limit] = jumps[static_cast<std::size_t>(axis)]; !(std::abs(jump) <= limit))
      return bad("jump at its beginning", axis, jump, limit);
  return {};
}

bool is_usable(const MapPose& pose, std::int64_t now) noexcept {
  const auto near = [](double x) { return std::abs(x) <= kFarthest; };
  return pose.step >= 0 && pose.step <= now && near(pose.p.x) && near(pose.p.y) &&
         std::isfinite(pose.p.phi) && is_covariance<3>(pose.covariance);
}

bool is_usable(const OdometryReading& odometry, std::int64_t now) noexcept {
  const std::array<double, 12>& A = odometry.A;
  Pose moved;
  moved.R << A[0], A[1], A[2], A[4], A[5], A[6], A[8], A[9], A[10];
  moved.p << A[3], A[7], A[11];
  return odometry.step_before >= 0 && odometry.step_before < odometry.step && odometry.step <= now &&
         is_proper(moved) && moved.p.norm() <= kLongestWay && is_covariance<6>(odometry.covariance);
}

}  // namespace mrroc::edp
