#include "base/msg/convert_platform.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/msg/convert.hpp"
#include "base/msg/copy.hpp"
#include "base/msg/finite.hpp"

namespace mrroc {
namespace {

using mrroc::copy;  // beside these
void copy(const PlanarPose& p, double (&numbers)[3]) { copy(std::array{p.x, p.y, p.phi}, numbers); }
void copy(const PlanarVelocity& v, double (&numbers)[3]) { copy(std::array{v.vx, v.vy, v.w}, numbers); }
void copy(const Slip& s, double (&numbers)[3]) { copy(std::array{s.mu_x, s.mu_y, s.split}, numbers); }

template <class Value>
Value three(const double (&numbers)[3]) {
  return {numbers[0], numbers[1], numbers[2]};
}

template <class Rows, std::size_t N, std::size_t M>
void copy_rows(const Rows& from, double (&to)[N][M]) {
  for (std::size_t k = 0; k < N; ++k) copy(from[k], to[k]);
}
template <std::size_t N, std::size_t M>
void copy_rows(const double (&from)[N][M], std::array<std::array<double, M>, N>& to) {
  for (std::size_t k = 0; k < N; ++k) copy(from[k], to[k]);
}
template <std::size_t N>
void copy_rows(const double (&from)[N][3], std::array<PlanarPose, N>& to) {
  for (std::size_t k = 0; k < N; ++k) to[k] = three<PlanarPose>(from[k]);
}

relative_motion_t motion_of(const OdometryReading& r) {
  relative_motion_t m{};
  m.step_before = r.step_before;
  m.step = r.step;
  m.valid = r.valid;
  copy(r.A, m.A);
  copy(r.covariance, m.covariance);
  return m;
}

OdometryReading odometry_of(const relative_motion_t& m) {
  OdometryReading r;
  r.step_before = m.step_before;
  r.step = m.step;
  r.valid = m.valid != 0;
  copy(m.A, r.A);
  copy(m.covariance, r.covariance);
  return r;
}

state_estimate_t state_of(const PlatformEstimate& e) {
  state_estimate_t m{};
  m.step = e.step;
  copy(e.p, m.p);
  copy(e.v, m.v);
  copy(e.theta, m.theta);
  copy(e.theta_dot, m.theta_dot);
  copy(e.covariance, m.covariance);
  return m;
}

PlatformEstimate estimate_of(const state_estimate_t& m) {
  PlatformEstimate e;
  e.step = m.step;
  e.p = three<PlanarPose>(m.p);
  e.v = three<PlanarVelocity>(m.v);
  copy(m.theta, e.theta);
  copy(m.theta_dot, e.theta_dot);
  copy(m.covariance, e.covariance);
  return e;
}

}  // namespace

fragment_t to_message(const Fragment& f) {
  fragment_t m{};
  static_assert(std::size(decltype(m.knot){}) == kFragmentKnots);
  m.number = f.number;
  m.steps = f.steps;
  m.notify = f.notify;
  for (std::size_t k = 0; k < f.knot.size(); ++k) {
    const PathPoint& from = f.knot[k];
    copy(std::array{from.p.x, from.p.y, from.p.phi, from.v, from.w}, m.knot[k]);
  }
  return m;
}

Fragment from_message(const fragment_t& m) {
  Fragment f;
  f.number = m.number;
  f.steps = m.steps;
  f.notify = m.notify;
  for (std::size_t k = 0; k < f.knot.size(); ++k) {
    const auto& from = m.knot[k];
    f.knot[k] = {{from[0], from[1], from[2]}, from[3], from[4]};
  }
  return f;
}

map_pose_t to_message(const MapPose& p) {
  map_pose_t m{};
  m.step = p.step;
  m.valid = p.valid;
  copy(p.p, m.p);
  copy(p.covariance, m.covariance);
  return m;
}

MapPose from_message(const map_pose_t& m) {
  MapPose p;
  p.step = m.step;
  p.valid = m.valid != 0;
  p.p = three<PlanarPose>(m.p);
  copy(m.covariance, p.covariance);
  return p;
}

platform_command_t to_message(const PlatformCommand& c) {
  platform_command_t m{};
  m.session = c.session;
  m.number = c.number;
  m.instruction = static_cast<std::int8_t>(c.instruction);
  m.queried = c.queried;
  m.fragment = to_message(c.fragment);
  m.pace = c.pace;
  m.odometry = motion_of(c.odometry);
  m.map = to_message(c.map);
  return m;
}

PlatformCommand from_message(const platform_command_t& m) {
  PlatformCommand c;
  c.session = m.session;
  c.number = m.number;
  c.macrostep = m.header.stamp;
  c.instruction = static_cast<Instruction>(m.instruction);
  c.queried = m.queried;
  c.fragment = from_message(m.fragment);
  c.pace = m.pace;
  c.odometry = odometry_of(m.odometry);
  c.map = from_message(m.map);
  return c;
}

platform_reply_t to_message(const PlatformReply& r) {
  platform_reply_t m{};
  m.session = r.session;
  m.number = r.number;
  m.step = r.step;
  m.expected = r.expected;
  m.verdict = static_cast<std::int8_t>(r.verdict);
  m.fault = to_message(r.fault);
  m.state = static_cast<std::int8_t>(r.state);
  m.accepted = r.accepted;
  m.notified = r.notified;
  m.executing = r.executing;
  m.iteration = r.iteration;
  m.remaining = r.remaining;
  m.estimate = state_of(r.estimate);
  copy(r.slip, m.slip);
  copy(r.slip_sd, m.slip_sd);
  copy(r.torque, m.torque);
  copy(r.load, m.load);
  m.adapting = r.adapting;
  m.position_known = r.position_known;
  m.at_rest = r.at_rest;
  m.late_odometry = r.late_odometry;
  m.late_map = r.late_map;
  m.rejected = r.rejected;
  m.solver_failures = r.solver_failures;
  return m;
}

PlatformReply from_message(const platform_reply_t& m) {
  PlatformReply r;
  r.session = m.session;
  r.number = m.number;
  r.macrostep = m.header.stamp;
  r.step = m.step;
  r.expected = m.expected;
  r.verdict = static_cast<Verdict>(m.verdict);
  r.fault = from_message(m.fault);
  r.state = static_cast<DriverState>(m.state);
  r.accepted = m.accepted;
  r.notified = m.notified;
  r.executing = m.executing;
  r.iteration = m.iteration;
  r.remaining = m.remaining;
  r.estimate = estimate_of(m.estimate);
  r.slip = three<Slip>(m.slip);
  r.slip_sd = three<Slip>(m.slip_sd);
  copy(m.torque, r.torque);
  copy(m.load, r.load);
  r.adapting = m.adapting != 0;
  r.position_known = m.position_known != 0;
  r.at_rest = m.at_rest != 0;
  r.late_odometry = m.late_odometry;
  r.late_map = m.late_map;
  r.rejected = m.rejected;
  r.solver_failures = m.solver_failures;
  return r;
}

platform_telemetry_t to_message(const PlatformTelemetry& t) {
  platform_telemetry_t m{};
  m.step = t.step;
  copy_rows(t.reference, m.reference);
  copy_rows(t.horizon, m.horizon);
  copy_rows(t.torque, m.torque);
  m.tracker_iterations = t.tracker_iterations;
  m.estimator_iterations = t.estimator_iterations;
  return m;
}

PlatformTelemetry from_message(const platform_telemetry_t& m) {
  PlatformTelemetry t;
  t.step = m.step;
  copy_rows(m.reference, t.reference);
  copy_rows(m.horizon, t.horizon);
  copy_rows(m.torque, t.torque);
  t.tracker_iterations = m.tracker_iterations;
  t.estimator_iterations = m.estimator_iterations;
  return t;
}

platform_reading_t to_message(const PlatformReading& r) {
  platform_reading_t m{};
  copy(r.encoder, m.encoder);
  m.yaw = r.yaw;
  m.yaw_rate = r.yaw_rate;
  m.imu_valid = r.imu_valid;
  copy(r.load, m.load);
  m.load_valid = r.load_valid;
  copy(r.current, m.current);
  return m;
}

PlatformReading from_message(const platform_reading_t& m) {
  PlatformReading r;
  r.step = m.header.stamp;
  copy(m.encoder, r.encoder);
  r.imu_valid = m.imu_valid != 0 && std::isfinite(m.yaw) && std::isfinite(m.yaw_rate);
  if (r.imu_valid) {
    r.yaw = m.yaw;
    r.yaw_rate = m.yaw_rate;
  }
  r.load_valid = m.load_valid != 0 && finite(m.load);
  if (r.load_valid) copy(m.load, r.load);
  std::ranges::transform(m.current, r.current.begin(), [](double i) { return std::isfinite(i) ? i : 0.0; });
  return r;
}

platform_drive_t to_message(const PlatformDrive& d) {
  platform_drive_t m{};
  copy(d.torque, m.torque);
  m.enabled = d.enabled;
  m.imu_reset = d.imu_reset;
  m.macrostep = d.macrostep;
  return m;
}

PlatformDrive from_message(const platform_drive_t& m) {
  PlatformDrive d;
  d.step = m.header.stamp;
  copy(m.torque, d.torque);
  d.enabled = m.enabled != 0;
  d.imu_reset = m.imu_reset != 0;
  d.macrostep = m.macrostep;
  return d;
}

odometry_reading_t to_message(const OdometryReading& r, const OdometrySupport& support) {
  odometry_reading_t m{};
  m.motion = motion_of(r);
  m.support.finding = static_cast<std::int32_t>(support.finding);
  m.support.features = support.features;
  m.support.matches = support.matches;
  m.support.inliers = support.inliers;
  m.support.cells = support.cells;
  m.support.rms_px = support.rms_px;
  return m;
}

odometry_reading_t to_message(const OdometryReading& r) { return to_message(r, {}); }

OdometrySupport support_of(const odometry_reading_t& m) {
  return {.frame = m.header.stamp,
          .finding = static_cast<OdometryFinding>(m.support.finding),
          .features = m.support.features,
          .matches = m.support.matches,
          .inliers = m.support.inliers,
          .cells = m.support.cells,
          .rms_px = m.support.rms_px};
}

OdometryReading from_message(const odometry_reading_t& m) { return odometry_of(m.motion); }

motion_capture_t to_message(const MotionCapture& c) {
  motion_capture_t m{};
  m.step = c.step;
  m.seen = c.seen;
  copy(c.p, m.p);
  return m;
}

MotionCapture from_message(const motion_capture_t& m) {
  return {m.step, m.seen != 0, three<PlanarPose>(m.p)};
}

map_report_t to_message(const MapReport& r) {
  map_report_t m{};
  m.pose = to_message(r.pose);
  m.rejected = r.rejected;
  return m;
}

MapReport from_message(const map_report_t& m) { return {from_message(m.pose), m.rejected}; }

platform_estimate_t to_message(const PlatformEstimate& e) {
  platform_estimate_t m{};
  m.estimate = state_of(e);
  return m;
}

PlatformEstimate from_message(const platform_estimate_t& m) { return estimate_of(m.estimate); }

plan_t to_message(const Plan& p) {
  plan_t m{};
  m.number = p.number;
  m.n = p.n;
  copy_rows(p.point, m.point);
  m.speed = p.speed;
  m.ahead = p.ahead;
  return m;
}

Plan from_message(const plan_t& m) {
  Plan p;
  p.number = m.number;
  p.n = m.n;
  copy_rows(m.point, p.point);
  p.speed = m.speed;
  p.ahead = m.ahead;
  return p;
}

fragment_order_t to_message(const FragmentOrder& o) {
  fragment_order_t m{};
  m.fragment = to_message(o.fragment);
  return m;
}

FragmentOrder from_message(const fragment_order_t& m) { return {from_message(m.fragment)}; }

box_truth_t to_message(const BoxTruth& t) {
  box_truth_t m{};
  copy(t.p, m.p);
  copy(t.speed, m.speed);
  copy(t.push, m.push);
  return m;
}

BoxTruth from_message(const box_truth_t& m) {
  BoxTruth t;
  t.p = three<PlanarPose>(m.p);
  copy(m.speed, t.speed);
  copy(m.push, t.push);
  return t;
}

platform_truth_t to_message(const PlatformTruth& t) {
  platform_truth_t m{};
  copy(t.p, m.p);
  copy(t.v, m.v);
  copy(t.wheel_speed, m.wheel_speed);
  copy_rows(t.slip_speed, m.slip_speed);
  copy_rows(t.friction, m.friction);
  copy(t.load, m.load);
  copy(t.torque, m.torque);
  return m;
}

PlatformTruth from_message(const platform_truth_t& m) {
  PlatformTruth t;
  t.p = three<PlanarPose>(m.p);
  t.v = three<PlanarVelocity>(m.v);
  copy(m.wheel_speed, t.wheel_speed);
  copy_rows(m.slip_speed, t.slip_speed);
  copy_rows(m.friction, t.friction);
  copy(m.load, t.load);
  copy(m.torque, t.torque);
  return t;
}

}  // namespace mrroc
