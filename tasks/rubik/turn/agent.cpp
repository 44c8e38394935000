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

/// A way begins with its point 0.
ArmMemory begin_way(const X& x) {
  ArmMemory c = x.c;
  c.way = {};
  return c;
}

/// Points come in their order; one that has been taken is sent again until the coordinator knows.
ArmMemory take_point(const X& x) {
  ArmMemory c = x.c;
  const auto& point = x.T.arm.pose;
  const bool sound = std::ranges::all_of(point, [](double q) { return std::isfinite(q); }) &&
                     point[kSpeedOfLine] > 0 && point[kSpeedOfLine] <= 1;
  if (x.T.m == kTakeWay && x.T.variant == c.way.count && sound) c.way.add(point);
  c.way.jaws = x.T.arm.gripper;
  return c;
}

ArmMemory plan_path(const X& x) {
  ArmMemory c = x.c;
  c.path = {};
  if (c.way.count == 0) return c;
  const Eigen::Index axes = c.limits.velocity.size();
  const auto motors_of = [axes](const auto& numbers) {
    return ecp::Coordinates(Eigen::Map<const Eigen::VectorXd>(numbers.data(), axes));
  };
  std::vector<ecp::ViaPoint> list;
  for (int k = 0; k < c.way.count; ++k) {
    const PoseNumbers& point = c.way.points[static_cast<std::size_t>(k)];
    list.push_back({.pose = motors_of(point),
                    .velocity = point[kSpeedOfLine],
                    .acceleration = 1,
                    .pass = k + 1 < c.way.count});
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
  if (x.c.way.jaws > 0) command.arm.gripper = std::clamp(x.c.way.jaws, kClosest, kWidest);
  return command;
}

/// The arm stands, its jaws begin already: an empty hand's come off the cube even if they do not open any farther.
EffectorCommand stand(const X& x) {
  return x.c.way.jaws > 0 ? with_jaws(x, ecp::move_arm(kStill, kPacing)) : ecp::rest();
}

EffectorCommand follow(const X& x) {
  return with_jaws(x, x.c.path.macrosteps() > 0 ? ecp::follow_path(x) : ecp::move_arm(kStill, kPacing));
}

EffectorCommand weigh(const X& x) {
  const auto& n = x.T.arm.pose;
  return may_weigh(x) ? ecp::change_force_tool(n[0], {n[1], n[2], n[3]}) : ecp::rest();
}

// --- coordinator -----------------------------------------------------------------------------------------------

bool arrived(const X& x) {
  const bool jaws = x.T.variant != kActs || x.c.way.jaws <= 0 || x.e.blocked ||
                    std::abs(x.e.gripper - x.c.way.jaws) < kJawsThere;
  return jaws && ecp::path_ends(x);
}
bool weighed(const X& x) { return x.c.weighed != 0 && x.i >= x.c.weighed + ecp::kAnswerDelay; }
bool never(const X&) { return false; }

template <int m, bool (*done)(const X&)>
Report tell(const X& x) {
  Report r = ecp::report_of(x, m);
  r.sensor = x.c.way.count;
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
  { kTakeWay, "take the way", begin_way,   take_point, stand,   kNoSensor, tell<kTakeWay, never>,   other_order<kTakeWay>, "the coordinator orders something else"},
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
