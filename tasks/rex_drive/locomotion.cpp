#include "tasks/rex_drive/locomotion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/latency.hpp"

namespace mrroc::rex_drive {
namespace {

using X = Locomotion::X;

// --- lists of REX --------------------------------------------------------------------------------------------

using List = std::vector<Trajectory>;

bool list_is_empty(const List& list) { return list.empty(); }
const Trajectory& list_get_data(const List& list) { return list.front(); }
List list_del_first(const List& list) { return {list.begin() + 1, list.end()}; }
List list_add_last(const List& list, const Trajectory& data) {
  List longer = list;
  longer.push_back(data);
  return longer;
}
List list_add_last_del_first(const List& list, const Trajectory& data) {
  return list_add_last(list_del_first(list), data);
}

// --- parts of the functions ----------------------------------------------------------------------------------

/// Whether the platform does not know where it is. It does again when it is clearly better, so that it does not stop and go
/// in turns.
bool position_lost(const X& x) {
  constexpr double kFound = 0.8;
  return uncertainty(x.e.estimate) > (x.c.lost ? kFound : 1) * x.c.k.lost;
}

/// A camera hangs, or the platform is held back: e_x and r_x meet in c_1 alone, so that it is found here.
StillPictures still_pictures(const X& x) { return seen(x.c.still, x.V, x.c.wheels); }
bool pictures_stand(const X& x) { return still_pictures(x).against_wheels; }

/// Memory that goes on: the pace follows the operator's pause, and the platform waits while it does not know where it is. The
/// driver goes to it evenly; told its end at once, the tracker sees the standstill come.
Memory go_on(const X& x) {
  Memory c = x.c;
  c.lost = position_lost(x);
  c.wheels = watched(std::move(c.wheels), x.e.estimate);
  c.still = still_pictures(x);
  c.pace = x.T.variant == kPaused || c.lost ? 0 : 1;
  return c;
}

/// @return whether a fragment that is planned from now on comes before the last one has ended
bool comes_in_time(const X& x) {
  constexpr std::int64_t kStarts = 1, kReserve = 10;
  const std::int64_t needed =
      x.c.k.planner.planning + kStarts + latency::kMessage + latency::kCommandToReply + kReserve;
  return x.e.remaining > needed;
}

/// Where the first fragment of a plan begins: the end of the last one, or the platform when there is none. An end at speed
/// that will have passed by then is a place at which the platform is held.
PathPoint beginning(const X& x) {
  if (x.c.handed == 0) return {x.e.estimate.p};
  if (comes_in_time(x)) return x.c.end;
  return {x.c.end.p};
}

/// Limits of a plan: on slippery ground curves are slower, and possible whatever is estimated.
RouteLimits route_limits(const X& x) {
  constexpr double kGravity = 9.81, kLeastFriction = 0.01;
  RouteLimits limits = x.c.k.planner.route;
  const double friction = std::max(kLeastFriction, x.e.slip.mu_y * (1 - std::abs(x.e.slip.split)));
  limits.lateral = std::min(limits.lateral, x.c.k.grip * kGravity * friction);
  return limits;
}

/// A fragment begins at rest though the one before ends at speed: only when that one has come to its end.
bool waits_for_rest(const X& x) {
  return std::abs(x.c.end.v) > 0 && list_get_data(x.c.traj).knot.front().v == 0 && x.e.remaining > 0;
}
bool hands_over(const X& x) { return is_ready(x) && !list_is_empty(x.c.traj) && !waits_for_rest(x); }

Trajgen start_next(Memory& c) {
  if (c.plan.empty()) return trajgen_stop(c.trajgen);
  const Trajgen started = trajgen_start(c.trajgen, c.plan.front());
  c.plan.erase(c.plan.begin());
  return started;
}

// --- f_ce ----------------------------------------------------------------------------------------------------

/// c_1 passes the map's position on, and the odometry where the wheels do not contradict it.
PlatformCommand route(const X& x) {
  PlatformCommand y;
  y.pace = x.c.pace;
  y.map = x.T.map.pose;
  if (!pictures_stand(x)) y.odometry = x.V;
  return y;
}

// --- f_cT ----------------------------------------------------------------------------------------------------

/// Number of the plan's point that the platform is on its way to, from 1; 0: it is not known.
int point_under_way(const X& x) {
  const std::int64_t k = x.e.executing - x.c.before_plan - 1;
  if (k < 0 || k >= static_cast<std::int64_t>(x.c.points.size())) return 0;
  return x.c.points[static_cast<std::size_t>(k)] + 1;
}
bool stands(const X& x) { return x.e.notified == x.c.handed && x.e.remaining == 0 && x.e.at_rest; }

/// Whether the odometry measures; its last reading stays when it falls silent.
bool sees_motion(const X& x) { return x.V.valid && x.e.step - x.V.step <= x.c.k.stale && !pictures_stand(x); }

/// What the platform is and does, and where.
Said tell_all(const X& x, int m) {
  Said said;
  Report& r = said;
  r.m = m;
  r.driver_state = x.e.state;
  r.ready = x.e.position_known;
  r.position_known = x.e.position_known;
  // Not every fault is an answer: a silence, or a motion that fails when its command has long been executed.
  r.verdict = x.e.fault && x.e.verdict == Verdict::none ? Verdict::failed : x.e.verdict;
  r.fault = x.e.fault;
  const PlanarPose& p = x.e.estimate.p;
  r.T_0E = {p.x, p.y, 0, 0, 0, p.phi};
  r.sensor = (x.T.map.pose.valid ? kMapSeen : 0) + (sees_motion(x) ? kOdometrySeen : 0) +
             (stands(x) ? kStands : 0) + (position_lost(x) ? kPositionLost : 0) +
             kPointUnit * point_under_way(x) + (pictures_stand(x) ? kPicturesStand : 0);
  if (x.e.position_known) said.estimate = x.e.estimate;
  return said;
}
template <int m>
Said tell(const X& x) {
  return tell_all(x, m);
}
Said give_up(const X& x) {
  Said said = tell_all(x, kGiveUp.m);
  said.verdict = Verdict::failed;
  said.fault.code = FaultCode::path_not_found;
  return said;
}

// --- f_tau ---------------------------------------------------------------------------------------------------

bool started(const X& x) { return x.T.m > 0 || x.T.finished; }
bool new_plan(const X& x) { return x.c.new_plan || x.T.finished; }
bool one_iteration(const X& x) { return x.i > x.i_0 || x.T.finished; }
bool never(const X&) { return false; }

Memory retain(const X& x) { return x.c; }
None no_sensor(const X&) { return {}; }

}  // namespace

// clang-format off
const std::array<Motion<Locomotion>, 3> kBehaviours{{
  // m  name                entry   memory              effector  odometry   other agents   f_tau
  { 1, "wait for a plan",   retain, take_plan,          route,    no_sensor, take_back_ack, new_plan,            "a plan comes" },
  { 2, "execute the plan",  retain, plan_and_hand_over, fragment, no_sensor, tell<2>,       plan_is_handed_over, "its last fragment is handed over" },
  { 3, "acknowledge",       retain, go_on,              route,    no_sensor, acknowledge,   one_iteration,       "one iteration has passed" },
}};
const Motion<Locomotion> kWaitForStart{ 0, "wait for start", retain, go_on, route,       no_sensor, tell<0>, started, "start given" };
const Motion<Locomotion> kGiveUp      { 4, "give up",        retain, go_on, route,       no_sensor, give_up, never };
// clang-format on

double uncertainty(const PlatformEstimate& estimate) {
  return std::sqrt(std::max(0.0, estimate.covariance[0] + estimate.covariance[4]));
}

bool is_new(const X& x) { return x.T.desired.number > x.c.taken; }

bool is_ready(const X& x) { return x.e.notified == x.c.handed; }

bool plan_is_handed_over(const X& x) {
  const bool idle = !x.c.trajgen.busy && x.c.plan.empty() && list_is_empty(x.c.traj) && !x.c.new_plan;
  return idle || in_vain(x) || x.T.finished;
}

bool in_vain(const X& x) { return x.c.trajgen.failed; }

Memory take_plan(const X& x) {
  Memory c = go_on(x);
  if (!is_new(x)) return c;
  const PathPoint from = beginning(x);
  c.plan = proc(x.T.desired, from, route_limits(x));
  c.traj.clear();
  c.trajgen = trajgen_init(c.trajgen, from);
  c.new_plan = true;
  c.taken = x.T.desired.number;
  c.before_plan = c.handed;
  c.points.clear();
  return c;
}

Said take_back_ack(const X& x) {
  Said said = tell_all(x, 1);
  said.event = is_new(x) ? 0 : static_cast<int>(x.c.taken);
  return said;
}

Memory plan_and_hand_over(const X& x) {
  Memory c = go_on(x);
  const bool planned = trajgen_is_ready(c.trajgen);
  if (hands_over(x)) {
    ++c.handed;
    c.end = list_get_data(c.traj).knot.back();
    c.points.push_back(list_get_data(c.traj).index);
    c.traj = planned ? list_add_last_del_first(c.traj, trajgen_get_traj(c.trajgen)) : list_del_first(c.traj);
  } else if (planned) {
    c.traj = list_add_last(c.traj, trajgen_get_traj(c.trajgen));
  }
  if (c.new_plan) {
    c.new_plan = false;
    c.trajgen = start_next(c);
  } else if (planned) {
    c.trajgen = start_next(c);
  } else {
    c.trajgen = trajgen_get_stat(c.trajgen);
  }
  return c;
}

PlatformCommand fragment(const X& x) {
  PlatformCommand y = route(x);
  if (!hands_over(x)) return y;
  const Trajectory& first = list_get_data(x.c.traj);
  y.instruction = Instruction::set;
  y.fragment.number = x.c.handed + 1;
  y.fragment.steps = traj_to_steps(first);
  y.fragment.notify = traj_to_notify(first, x.c.k.planner.lead);
  y.fragment.knot = first.knot;
  return y;
}

Said acknowledge(const X& x) {
  Said said = tell_all(x, 3);
  said.event = static_cast<int>(x.c.taken);
  return said;
}

Memory begin(const Parameters& k) {
  Memory c;
  c.k = k;
  c.trajgen.k = k.planner;
  return c;
}

}  // namespace mrroc::rex_drive
