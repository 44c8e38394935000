#include "tasks/rubik/turn/agent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ecp/generators/polyline.hpp"

namespace mrroc::rubik {
namespace {

using X = Arm::X;

constexpr std::int64_t kStillFor = 12;  // macrosteps at rest before anything is weighed: hands swing for six
constexpr double kJawsThere = 0.0015;   // [m]

// --- memory ----------------------------------------------------------------------------------------------------

/// A path begins with its point 0.
ArmMemory begin_path(const X& x) {
  ArmMemory c = x.c;
  c.joint_path = {};
  return c;
}

/// Points come in their order; one that has been taken is sent again until the coordinator knows.
ArmMemory take_point(const X& x) {
  ArmMemory c = x.c;
  const PathPoint& point = x.T.cube.point;
  if (x.T.m == kTakePath && x.T.variant == c.joint_path.count && point.sound()) c.joint_path.add(point);
  c.joint_path.jaws = x.T.cube.jaws;
  return c;
}

ArmMemory plan_path(const X& x) {
  ArmMemory c = x.c;
  c.path = {};
  if (c.joint_path.count == 0) return c;
  const Eigen::Index axes = c.limits.velocity.size();
  const auto motors_of = [axes](const auto& numbers) {
    return ecp::Coordinates(Eigen::Map<const Eigen::VectorXd>(numbers.data(), axes));
  };
  std::vector<ecp::ViaPoint> list;
  for (int k = 0; k < c.joint_path.count; ++k) {
    const PathPoint& point = c.joint_path.points[static_cast<std::size_t>(k)];
    list.push_back({.pose = motors_of(point.motors),
                    .velocity = point.speed,
                    .acceleration = 1,
                    .pass = k + 1 < c.joint_path.count});
  }
  c.path = ecp::Trajectory(
      std::make_shared<ecp::Polyline>(motors_of(x.e.motors), list, c.limits, kPacing.macrostep_s()),
      {.space = Representation::motors}, kPacing);
  return c;
}

ArmMemory not_weighed(const X& x) {
  ArmMemory c = x.c;
  c.weighed = 0;
  return c;
}

bool may_weigh(const X& x) {
  return x.c.weighed == 0 && ecp::age(x) >= kStillFor &&
         (x.e.state == DriverState::holding || x.e.state == DriverState::ready);
}

ArmMemory weigh_once(const X& x) {
  ArmMemory c = x.c;
  if (may_weigh(x)) c.weighed = x.i;
  return c;
}

// --- effector --------------------------------------------------------------------------------------------------

EffectorCommand with_jaws(const X& x, EffectorCommand command) {
  if (x.c.joint_path.jaws > 0) command.arm.gripper = std::clamp(x.c.joint_path.jaws, kClosest, kWidest);
  return command;
}

/// The arm stands, its jaws begin already: an empty hand's come off the cube even if they do not open any farther.
EffectorCommand stand(const X& x) {
  return x.c.joint_path.jaws > 0 ? with_jaws(x, ecp::move_arm(kStill, kPacing)) : ecp::rest();
}

EffectorCommand follow(const X& x) {
  return with_jaws(x, x.c.path.macrosteps() > 0 ? ecp::follow_path(x) : ecp::move_arm(kStill, kPacing));
}

EffectorCommand weigh(const X& x) {
  const auto& P = x.T.cube.mass_centre;
  return may_weigh(x) ? ecp::change_force_tool(x.T.cube.weight, {P[0], P[1], P[2]}) : ecp::rest();
}

// --- coordinator -----------------------------------------------------------------------------------------------

bool arrived(const X& x) {
  const bool jaws = x.T.variant != kActs || x.c.joint_path.jaws <= 0 || x.e.blocked ||
                    std::abs(x.e.gripper - x.c.joint_path.jaws) < kJawsThere;
  return jaws && ecp::path_ends(x);
}
bool weighed(const X& x) { return x.c.weighed != 0 && x.i >= x.c.weighed + latency::kCommandToReply; }
bool never(const X&) { return false; }

template <int m, bool (*done)(const X&)>
ArmReport tell(const X& x) {
  ArmReport r;
  r = ecp::report_of(x, m);
  r.cube.points = x.c.joint_path.count;
  r.event = done(x) ? m : 0;
  return r;
}

// --- terminal conditions ---------------------------------------------------------------------------------------

bool order_changes(const X& x);
template <int m>
bool other_order(const X& x) {
  return x.T.m != m || x.T.finished;
}

constexpr auto kRetain = ecp::retain<Arm>;
constexpr auto kNoSensor = ecp::no_sensor<Arm>;
constexpr auto kRest = ecp::at_rest<Arm>;

}  // namespace

// clang-format off
const std::array<Motion<Arm>, 4> kBetween{{
  // m         name           entry        memory      command  sensors    event                    terminal condition, in words
  { kWait,    "wait",         kRetain,     kRetain,    kRest,   kNoSensor, tell<kWait, never>,      order_changes, "the coordinator orders something"},
  { kTakePath, "take the way", begin_path,  take_point, stand,   kNoSensor, tell<kTakePath, never>,  other_order<kTakePath>, "the coordinator orders something else"},
  { kGo,      "go",           plan_path,   kRetain,    follow,  kNoSensor, tell<kGo, arrived>,      other_order<kGo>, "the coordinator has seen the arrival"},
  { kWeigh,   "weigh",        not_weighed, weigh_once, weigh,   kNoSensor, tell<kWeigh, weighed>,   other_order<kWeigh>, "the coordinator has seen that the hand is weighed"},
}};
// clang-format on

const Motion<Arm>& select(const X& x) {
  const Motion<Arm>* row = &kBetween[0];
  if (x.T.m >= 1 && x.T.m <= 6) {
    // The worker acts in m = 1..4, the holder in 5 and 6.
    const bool worker = (x.T.m <= 4) == (x.T.variant == kActs);
    const auto& rows = worker ? kWorker : kHolder;
    row = &rows[static_cast<std::size_t>(x.T.m - 1)];
  } else if (const auto found = std::ranges::find(kBetween, x.T.m, &Motion<Arm>::m);
             found != kBetween.end()) {
    row = &*found;
  }
  return row != &kBetween[0] && row->f_tau(x) ? kBetween[0] : *row;
}

namespace {
bool order_changes(const X& x) { return x.T.finished || &select(x) != &kBetween[0]; }
}  // namespace

}  // namespace mrroc::rubik
