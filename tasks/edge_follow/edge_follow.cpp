#include "tasks/edge_follow/edge_follow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/representation.hpp"
#include "ecp/preparation.hpp"

namespace mrroc::edge_follow {
namespace {

using X = Arm::X;
using std::numbers::pi;

constexpr double kFullRound = 2 * pi - 0.3;  // [rad] of turning, before the way back to the beginning counts
constexpr double kLeft = 0.010;              // [m] the place of contact has been left
constexpr double kBack = 0.002;              // [m] ... and is reached again

Pose turned(const Pose& T_WE, double angle) {
  return T_WE * Pose{rotation_from_angle_axis({0, 0, angle}), Vector3::Zero()};
}

/// Angle of the task frame about z when x_ce was measured; the one nearest to the commanded angle.
double measured_angle(const X& x) {
  const Matrix3 R = x.c.T_0E.R.transpose() * pose_of(x.e).R;
  const double angle = std::atan2(R(1, 0), R(0, 0));
  return angle + 2 * pi * std::round((x.c.angle - angle) / (2 * pi));
}

double distance(const X& x) { return (pose_of(x.e).p - x.c.T_0E.p).head<2>().norm(); }

/// At which the approach settles [N].
double touching_force(const X& x) { return x.c.rule.force / 2; }

// --- f_cc ---------------------------------------------------------------------------------------------------

Memory count_contact(const X& x) {
  Memory c = x.c;
  c.pushing = ecp::in_contact(c.pushing, x.e.F_a[Axis::x], touching_force(x));
  c.impact = std::max(c.impact, x.e.F_a[Axis::x]);
  return c;
}

Memory note_contact(const X& x) {
  Memory c = x.c;
  c.T_0E = pose_of(x.e);
  c.rule = ecp::slowed(c.rule, ecp::share_after_impact(c.impact, touching_force(x)));
  c.angle = 0;
  c.farthest = 0;
  return c;
}

ecp::EdgeStep edge_step(const X& x) {
  return ecp::follow_edge(x.c.rule, measured_angle(x), x.e.F_a, x.c.angle);
}

Memory turn(const X& x) {
  Memory c = x.c;
  c.angle = edge_step(x).angle;
  c.farthest = std::max(c.farthest, distance(x));
  return c;
}

// --- f_ce ---------------------------------------------------------------------------------------------------

EffectorCommand to_the_edge(const X& x) {
  return ecp::move_arm(ecp::approach(Axis::x, 0.01, touching_force(x), x.c.rule.I), kPacing);
}

EffectorCommand along_the_edge(const X& x) {
  const ecp::EdgeStep step = edge_step(x);
  return ecp::with_tool(ecp::move_arm(step.frame, kPacing), turned(x.c.T_WE, step.angle));
}

EffectorCommand away(const X&) { return ecp::move_arm({.x = u(-0.02)}, kPacing); }

// --- f_tau --------------------------------------------------------------------------------------------------

bool pushing(const X& x) { return x.c.pushing > 10; }
bool round_done(const X& x) {
  return std::abs(x.c.angle) > kFullRound && x.c.farthest > kLeft && distance(x) < kBack;
}

}  // namespace

// clang-format off
const std::array<Motion<Arm>, 3> kEdgeFollow{{
  // m  name                entry             memory         command         sensors              coordinator 
  //    terminal condition
  {  1, "to the edge",      ecp::retain<Arm>, count_contact, to_the_edge,    ecp::no_sensor<Arm>, ecp::tell<Arm>, pushing, "the finger pushes on the edge"},
  {  2, "along the edge",   note_contact,     turn,          along_the_edge, ecp::no_sensor<Arm>, ecp::tell<Arm>, round_done, "once around the plate"},
  {  3, "away",             ecp::retain<Arm>, ecp::retain<Arm>, away,        ecp::no_sensor<Arm>, ecp::tell<Arm>, ecp::after<Arm, 60>, "the arm has drawn back"},
}};
// clang-format on

ecp::EdgeRule read_rule(const Config& config) {
  ecp::EdgeRule rule;
  const Config task = config.section("task");
  rule.force = task.number("force", rule.force, {1, 20}, "N");
  rule.speed_per_force = task.number("speed_per_force", rule.speed_per_force, {-0.01, 0.01}, "m/s/N");
  rule.turn_per_force = task.number("turn_per_force", rule.turn_per_force, {0, 1}, "rad/N");
  return rule;
}

Memory read_memory(const Config& config, const std::string& arm) {
  Memory c;
  c.rule = read_rule(config);
  const RobotModel model = ecp::read_tool_model(config, arm);
  c.T_WE = pose_from_numbers(model.tool_representation, model.tool).value_or(Pose{});
  return c;
}

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config& config) {
  std::vector<double> rms, mean, peak, time;
  const double desired = read_rule(config).force;
  for (const mp::ArmTrace& trace : arms) {
    double square = 0, sum = 0, largest = 0, begin = 0, end = 0;  // NaN in the end where no row counts
    int rows = 0;
    for (const mp::ArmRow& row : trace) {
      if (row.m != 2) continue;
      const double force = std::hypot(row.F[Axis::x], row.F[Axis::y]);
      if (rows++ == 0) begin = row.t;
      end = row.t;
      sum += force;
      square += (force - desired) * (force - desired);
      largest = std::max(largest, force);
    }
    rms.push_back(std::sqrt(square / rows));
    mean.push_back(sum / rows);
    peak.push_back(rows > 0 ? largest : NAN);
    time.push_back(rows > 0 ? end - begin : NAN);
  }
  return {{{.key = "edge_follow_rms_N",
            .words = "error of the force along the edge",
            .unit = "N rms",
            .high = 0.5},
           rms},
          {{"edge_follow_mean_N", "force along the edge, mean", "N"}, mean},
          {{"edge_follow_peak_N", "  largest", "N"}, peak},
          {{"edge_follow_s", "time for one round", "s"}, time}};
}

}  // namespace mrroc::edge_follow
