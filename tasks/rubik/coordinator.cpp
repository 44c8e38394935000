// Transition functions and terminal conditions of a_0.
#include "tasks/rubik/coordinator.hpp"

#include <cmath>

#include "base/latency.hpp"
#include "base/representation.hpp"
#include "tasks/rubik/plan/plan.hpp"
#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {
namespace {

using X = Coordinator::X;
using Memory0 = Coordinator::Memory;
using Orders = std::array<ArmOrder, kArms>;

/// Until an order shows in a report, and none of an earlier behaviour is left.
using latency::kLoop;

constexpr std::int64_t kStillBeforeLook = 25;  // macrosteps until the arms have come to rest
// A face that makes its progress in more macrosteps is slow, in fewer it is fast; F_d per macrostep, and per progress.
constexpr std::int64_t kSlow = 8;
constexpr std::int64_t kFast = 3;
constexpr double kHarder = 1.02;
constexpr double kSofter = 0.9;
constexpr std::int64_t kLongestLook = 100;  // macrosteps after which what there is must do

/// @return the hand that acts in behaviour m of the cycle
Hand actor(const Cycle& cycle, int m) {
  if (m <= 4) return cycle.comes;
  return m == 5 ? Hand::track : cycle.leaves;
}

const ArmReport& report(const X& x, Hand hand) { return x.T.agent[index(hand)]; }

bool empty(const X& x, Hand hand) { return report(x, hand).ready && report(x, hand).gripper < x.c.k.held; }

// --- memory ----------------------------------------------------------------------------------------------------

Memory0 retain(const X& x) { return x.c; }

template <int m>
Memory0 begin(const X& x) {
  Memory0 c = x.c;
  c.begun = pose_of(report(x, actor(c.cycle, m)));
  c.angle = c.last_angle = 0;
  c.last_progress = x.i;
  return c;
}

/// @return whether a hand that must hold the cube in behaviour m holds nothing
bool lost(const X& x, const Cycle& cycle, int m) {
  if (m == 6) return empty(x, other(cycle.leaves));
  return empty(x, cycle.holds) || (m == 5 && empty(x, cycle.comes));
}

/// @param took  macrosteps since the face made progress @param now  it makes some
/// @return F_d about the face's axis: more while it is slow, less again once it is fast [N m]
double torque_for(double torque, std::int64_t took, bool now, const Parameters& k) {
  if (torque == 0) return torque;  // a re-grasp turns nothing
  if (now && took < kFast) return std::copysign(std::max(kSofter * std::abs(torque), k.torque), torque);
  if (!now && took >= kSlow)
    return std::copysign(std::min(kHarder * std::abs(torque), std::max(k.most_torque, k.torque)), torque);
  return torque;
}

template <int m>
FailureReason watch(const X& x, const Memory0& c) {
  const Parameters& k = x.c.k;
  const bool late = ecp::age(x) >= k.timeout;
  if (lost(x, c.cycle, m)) return FailureReason::dropped;
  if (m == 1 && (late || c.travelled > kApproachDistance + k.slip)) return FailureReason::no_contact;
  if ((m == 3 || m == 4) && (late || empty(x, c.cycle.comes))) return FailureReason::missed;
  if (m == 5 && x.i - c.last_progress >= k.stall) return FailureReason::jammed;
  if (m == 6 && late) return FailureReason::not_released;
  return FailureReason::none;
}

/// (63), and whether all is well.
template <int m>
Memory0 coordinate_arms(const X& x) {
  Memory0 c = x.c;
  c.coordination = coordinate(c.coordination, x.T.agent);
  const Pose now = pose_of(report(x, actor(c.cycle, m)));
  if (m == 1) c.travelled = (c.begun.R.transpose() * (now.p - c.begun.p)).z();
  if (m == 5) {
    c.angle = angle_about_z(c.begun, now, c.angle);
    const bool progress = std::abs(c.angle - c.last_angle) >= c.k.progress;
    c.cycle.turn.torque = torque_for(c.cycle.turn.torque, x.i - c.last_progress, progress, c.k);
    if (progress) {
      c.last_angle = c.angle;
      c.last_progress = x.i;
    }
  }
  c.failure = watch<m>(x, c);
  if (m == 1 && c.coordination.m > 1 && std::abs(c.travelled - kApproachDistance) > c.k.slip)
    c.failure = FailureReason::elsewhere;
  return c;
}

Memory0 first_point(const X& x) {
  Memory0 c = x.c;
  c.next = {};
  return c;
}

/// Point after point; what has been lost is sent again when all others have been.
Memory0 next_point(const X& x) {
  Memory0 c = x.c;
  for (const Hand hand : kHands) {
    const JointPath& path = c.joint_paths[index(hand)];
    int& next = c.next[index(hand)];
    if (++next >= path.count) next = std::clamp(report(x, hand).cube.points, 0, std::max(0, path.count - 1));
  }
  return c;
}

Memory0 watch_cube(const X& x) {
  Memory0 c = x.c;
  for (const Hand hand : kHands)
    if (c.loaded[index(hand)] && empty(x, hand)) c.failure = FailureReason::dropped;
  return c;
}

// --- orders ----------------------------------------------------------------------------------------------------

template <int m>
Orders both(const X&) {
  Orders orders;
  for (ArmOrder& o : orders) o.m = m;
  return orders;
}

template <int m>
Orders cycle(const X& x) {
  Orders orders;
  for (const Hand hand : kHands) {
    ArmOrder& o = orders[index(hand)];
    o = order(x.c.coordination);
    o.variant = actor(x.c.cycle, m) == hand ? kActs : kStands;
    o.cube.turn = x.c.cycle.turn;
    o.cube.jaw_step = m == 6 ? x.c.k.opening_step : m == 4 ? x.c.k.grip_step : x.c.k.jaw_step;
  }
  return orders;
}

Orders send_points(const X& x) {
  Orders orders = both<kWait>(x);
  for (const Hand hand : kHands) {
    const JointPath& path = x.c.joint_paths[index(hand)];
    if (path.empty()) continue;
    const int next = x.c.next[index(hand)];
    ArmOrder& o = orders[index(hand)];
    o.m = kTakePath;
    o.variant = path.count > 0 ? next : -1;  // no point: the jaws alone
    if (path.count > 0) o.cube.point = path.points[static_cast<std::size_t>(next)];
    o.cube.jaws = path.jaws;
  }
  return orders;
}

Orders go(const X& x) {
  Orders orders = both<kWait>(x);
  for (const Hand hand : kHands)
    if (const int at = x.c.goes_at[index(hand)]; at >= 0 && ecp::age(x) >= at) {
      orders[index(hand)].m = kGo;
      orders[index(hand)].variant = x.c.jaws_too ? kActs : kStands;
    }
  return orders;
}

Orders weigh(const X& x) {
  Orders orders;
  for (const Hand hand : kHands) {
    ArmOrder& o = orders[index(hand)];
    const Load& load = x.c.k.load[index(hand)][x.c.loaded[index(hand)] ? 1 : 0];
    o.m = kWeigh;
    o.cube.weight = load.weight;
    std::ranges::copy(load.mass_centre, o.cube.mass_centre.begin());
  }
  return orders;
}

// --- terminal conditions ---------------------------------------------------------------------------------------

bool may_start(const X& x) { return x.T.h.started && x.T.agent[0].ready && x.T.agent[1].ready; }
/// A picture that was taken when the arms had been at rest for a while, and shows the face well; or the last of some.
bool has_seen(const X& x) {
  const CubeFaceReading& r = x.V.reading;
  if (!x.V.there || r.step < (x.i_0 + kStillBeforeLook) * kPacing.n_s) return false;
  return r.valid || ecp::age(x) >= kLongestLook;
}
bool has_thought(const X& x) { return ecp::age(x) >= kThinking; }
bool goes_on(const X& x) { return !x.t.paused; }

template <int m>
bool ended(const X& x) {
  return x.c.coordination.m != m || x.c.failure != FailureReason::none;
}

bool paths_known(const X& x) {
  const auto knows = [&x](Hand hand) {
    const JointPath& path = x.c.joint_paths[index(hand)];
    return path.empty() || report(x, hand).cube.points >= path.count;
  };
  return ecp::age(x) >= kLoop && knows(Hand::postument) && knows(Hand::track);
}
bool arrived(const X& x) {
  const auto there = [&x](Hand hand) {
    const int at = x.c.goes_at[index(hand)];
    return at < 0 || (ecp::age(x) >= at + kLoop && report(x, hand).event == kGo);
  };
  return x.c.failure != FailureReason::none || (there(Hand::postument) && there(Hand::track));
}
bool weighed(const X& x) {
  return ecp::age(x) >= kLoop && x.T.agent[0].event == kWeigh && x.T.agent[1].event == kWeigh;
}
bool resting(const X& x) {
  const auto rests = [](const Report& r) {
    return r.driver_state == DriverState::holding || r.driver_state == DriverState::ready;
  };
  return ecp::age(x) >= kLoop && rests(x.T.agent[0]) && rests(x.T.agent[1]);
}

None nothing(const X&) { return {}; }
CubeFaceSetting anything(const X&) { return {}; }
CubeFaceSetting shown(const X& x) { return x.c.shown; }

template <int m>
constexpr Motion<Coordinator> row(const char* name, const char* until) {
  return {m, name, begin<m>, coordinate_arms<m>, nothing, anything, cycle<m>, ended<m>, until};
}

}  // namespace

const std::array<Motion<Coordinator>, 6> kCycle{
    row<1>("approach", "the worker presses, or it has failed"),
    row<2>("settle", "the force has settled, or it has failed"),
    row<3>("close y", "the worker's jaws are about to touch, or it has failed"),
    row<4>("close xy", "the worker's jaws are blocked, or it has failed"),
    row<5>("turn", "the angle is reached, or it has failed"),
    row<6>("open", "the jaws have opened, or it has failed")};

// clang-format off
// m                                      name               entry        memory      effector sensors orders           terminal condition, in words
const Motion<Coordinator> kWaitForStart{ 0, "wait for start", retain,      retain,     nothing, anything, both<kWait>,     may_start, "both arms are ready and start was given"};
const Motion<Coordinator> kSendPath    { kTakePath, "tell the way", first_point, next_point, nothing, anything, send_points, paths_known, "the arms know their ways"};
const Motion<Coordinator> kMoveAlong   { kGo, "go",           retain,      watch_cube, nothing, anything, go,              arrived, "the arms have arrived"};
const Motion<Coordinator> kWeighBoth   { kWeigh, "weigh",     retain,      retain,     nothing, anything, weigh,           weighed, "both hands are weighed"};
const Motion<Coordinator> kStopBoth    { kWait, "break off",     retain,      retain,     nothing, anything, both<kWait>, resting, "both arms are at rest"};
const Motion<Coordinator> kThink       { 12, "think",         retain,      retain,     nothing, anything, both<kWait>,     has_thought, "the time to think is over"};
const Motion<Coordinator> kLook        { 13, "look",          retain,      retain,     nothing, shown,    both<kWait>,     has_seen, "there is a picture of the face"};
const Motion<Coordinator> kResume      { 11, "pause",         retain,      retain,     nothing, anything, both<kWait>,     goes_on, "the operator lets it go on"};
// clang-format on

const char* to_string(FailureReason failure) {
  switch (failure) {
    case FailureReason::none:
      return "none";
    case FailureReason::no_contact:
      return "the worker does not meet the cube";
    case FailureReason::elsewhere:
      return "the cube is not where the worker comes to it";
    case FailureReason::missed:
      return "the jaws close on nothing";
    case FailureReason::jammed:
      return "the face does not turn";
    case FailureReason::not_released:
      return "the jaws do not open";
    case FailureReason::dropped:
      return "the cube has been dropped";
  }
  return "?";
}

}  // namespace mrroc::rubik
