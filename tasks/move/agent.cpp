#include "tasks/move/agent.hpp"

#include <algorithm>

#include "ecp/generators/trapezoid.hpp"

namespace mrroc::any_motion {
namespace {

using X = Arm::X;
using ecp::age;

/// Shares of the joints' speeds on the way to the start, the quickest first. The last one keeps the tip below the driver's
/// 0.5 m/s in every posture.
constexpr std::array kStartShares{0.4, 0.2, 0.1};
// What the others have to keep, with something to spare to the driver's limits.
constexpr double kStartMotor = 200;      // [rad/s]
constexpr double kStartTip = 0.4;        // [m/s]
constexpr double kStartTurn = 1.5;       // [rad/s]
constexpr std::int64_t kMostRest = 250;  // macrosteps that an arm may need to come to rest

ecp::Coordinates measured_joints(const X& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.e.joints.data(), x.c.plan->start.size());
}

const PlannedMotion& motion(const X& x) { return x.c.plan->motions[x.c.motion]; }

bool slow_enough(const ecp::Trajectory& path, const Body& body) {
  const double T = kPacing.macrostep_s();
  for (std::int64_t k = 0; k < path.macrosteps(); ++k) {
    const ecp::Coordinates from = path.set_position(k), to = path.set_position(k + 1);
    const Pose a = body.pose(from), b = body.pose(to);
    if ((body.motors(to) - body.motors(from)).cwiseAbs().maxCoeff() > kStartMotor * T ||
        (b.p - a.p).norm() > kStartTip * T ||
        angle_axis_from_rotation(a.R.transpose() * b.R).norm() > kStartTurn * T)
      return false;
  }
  return true;
}

Memory way_to_start(const X& x) {
  Memory c = x.c;
  if (!c.plan) return c;
  const ecp::Coordinates& start = c.plan->start;
  const auto axes = static_cast<int>(start.size());
  for (const double share : kStartShares) {
    const ecp::ViaPoint to{start, share, share / 2};
    const ecp::MotionLimits limits = ecp::default_limits(Representation::joints, axes);
    c.path = ecp::Trajectory(
        std::make_shared<ecp::Trapezoid>(measured_joints(x), std::vector{to}, limits, kPacing.macrostep_s()),
        {}, kPacing);
    if (c.body && slow_enough(c.path, *c.body)) break;
  }
  return c;
}

bool has_motion(const X& x) { return x.c.plan && x.c.motion < x.c.plan->motions.size(); }

EffectorCommand to_start(const X& x) {
  return x.c.path.macrosteps() == 0 ? ecp::rest() : ecp::follow_path(x);
}
EffectorCommand follow(const X& x) {
  return has_motion(x) && motion(x).path.macrosteps() > 0 ? ecp::move_arm(motion(x).command(age(x)))
                                                          : ecp::rest();
}

/// For the coordinator: the arm is ready for its motion, or executes it.
Report number_of_motion(const X& x) {
  Report r = ecp::report_of(x, 0);
  r.event = static_cast<int>(x.c.motion) + 1;
  return r;
}

bool rests(const X& x) { return age(x) > latency::kCommandToReply && (x.e.at_rest || age(x) >= kMostRest); }
bool all_ready(const X& x) { return x.T.variant > static_cast<int>(x.c.motion); }
bool arrived(const X& x) { return !has_motion(x) || age(x) >= motion(x).path.macrosteps(); }

}  // namespace

// clang-format off
const std::array<Motion<Arm>, 4> kMove{{
  // m  name               entry             memory            command            sensors              agents            terminal condition
  {  1, "go to the start", way_to_start,     ecp::retain<Arm>, to_start,          ecp::no_sensor<Arm>, ecp::tell<Arm>,   ecp::path_ends<X>, "the arm is at its start"},
  {  2, "come to rest",    ecp::retain<Arm>, ecp::retain<Arm>, ecp::at_rest<Arm>, ecp::no_sensor<Arm>, ecp::tell<Arm>,   rests,             "the arm stands"},
  {  3, "wait for others", ecp::retain<Arm>, ecp::retain<Arm>, ecp::at_rest<Arm>, ecp::no_sensor<Arm>, number_of_motion, all_ready,         "all arms are ready for the motion"},
  {  4, "move",            ecp::retain<Arm>, ecp::retain<Arm>, follow,            ecp::no_sensor<Arm>, number_of_motion, arrived,           "the motion has been commanded to its end"},
}};
// clang-format on

void coordinate(std::span<const Report> agents, std::span<Order> orders) {
  int ready = kWorkDone;
  for (const Report& r : agents) ready = std::min(ready, r.event);
  for (Order& o : orders) o.variant = ready;
}

}  // namespace mrroc::any_motion
