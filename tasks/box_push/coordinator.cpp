#include "tasks/box_push/coordinator.hpp"

#include <algorithm>
#include <cmath>

#include "base/latency.hpp"
#include "tasks/box_push/observation.hpp"

namespace mrroc::box_push {
namespace {

using X = Coordinator::X;

/// Macrosteps after which a box that is not pushed any more has come to rest, and pushes by platforms are what they remain.
constexpr std::int64_t kSettles = 50;

// --- what the agents tell ----------------------------------------------------------------------------------------

const Report& platform(const X& x, std::size_t k) { return x.T.agent[k]; }
PlanarPose pose_told(const Report& r) { return {r.T_0E[0], r.T_0E[1], r.T_0E[5]}; }
int remaining(const Report& r) { return r.sensor / kIterationUnit; }
bool lost(const X& x) {
  return (platform(x, 0).sensor & kPositionLost) != 0 || (platform(x, 1).sensor & kPositionLost) != 0;
}

/// The driver wants the next fragment: it has notified of the one that was sent last.
bool is_ready(const Track& track, const Report& r) { return r.event == track.sent.number; }
bool is_done(const Track& track, const Report& r) {
  return track.waiting.empty() && is_ready(track, r) && (r.sensor & kStands) != 0;
}
/// Platforms that press against the box tremble: they have arrived, and do not come to rest.
bool all_arrived(const X& x) {
  const auto arrived = [](const Track& track, const Report& r) {
    return is_ready(track, r) && remaining(r) == 0;
  };
  return arrived(x.c.track[0], platform(x, 0)) && arrived(x.c.track[1], platform(x, 1));
}
bool all_done(const X& x) {
  return is_done(x.c.track[0], platform(x, 0)) && is_done(x.c.track[1], platform(x, 1));
}
bool all_ready(const X& x) {
  return is_ready(x.c.track[0], platform(x, 0)) && is_ready(x.c.track[1], platform(x, 1));
}

// --- tracks ------------------------------------------------------------------------------------------------------

void append(Track& track, const std::vector<Fragment>& more) {
  if (more.empty()) return;
  track.waiting.insert(track.waiting.end(), more.begin(), more.end());
  track.end = more.back().knot.back().p;
}
void send_next(Track& track) {
  if (track.waiting.empty()) return;
  const std::int64_t number = track.sent.number + 1;
  track.sent = track.waiting.front();
  track.sent.number = number;
  track.waiting.erase(track.waiting.begin());
}

// --- looking -----------------------------------------------------------------------------------------------------

/// Macrosteps before this one at which the newest reading was measured.
double age(const X& x) {
  return static_cast<double>(x.i - 1) - static_cast<double>(x.V.box.step) / x.c.k.n_s;
}
bool is_new(const X& x) { return x.V.box.seen && x.V.box.step > x.c.looked_at; }

/// What is remembered in every macrostep.
CoordinatorMemory watch(const X& x) {
  CoordinatorMemory c = x.c;
  c.looked_at = std::max(c.looked_at, x.V.box.step);
  if (!lost(x)) c.lost_in = 0;
  if (lost(x) && c.lost_in == 0) c.lost_in = x.i;
  return c;
}

/// Platforms are where they were told to be; before they are told anything, where they say.
CoordinatorMemory begin_look(const X& x) {
  CoordinatorMemory c = x.c;
  c.look = {};
  for (std::size_t k = 0; k < kPlatforms; ++k)
    if (c.track[k].sent.number == 0) c.track[k].end = pose_told(platform(x, k));
  return c;
}
CoordinatorMemory look(const X& x) {
  CoordinatorMemory c = watch(x);
  const bool settled = static_cast<double>(x.i - x.i_0) - age(x) >= 1;
  if (is_new(x) && settled && all_done(x)) c.look.push_back(x.V.box.p);
  if (!c.look.empty()) c.box = pose_of(c.look);
  return c;
}
bool has_looked(const X& x) { return x.c.look.size() >= kReadings || position_gone(x); }

// --- coming behind the box -----------------------------------------------------------------------------------------

double seconds_of(const std::array<std::vector<Fragment>, kPlatforms>& way) {
  double steps = 0;
  for (const auto& each : way)
    for (const Fragment& f : each) steps += f.steps;
  return steps * kPlatformPeriod;
}

/// Platforms come behind the box as they do this time, and its way is pushed at full speed but for its beginning and its end.
Outlook outlook_of(const CoordinatorMemory& c, const Pushes& pushes) {
  constexpr double kBesides = 15;  // looking, closing the gap, slowing down, settling, going back [s]
  double way = 0;
  PlanarPose from = c.box;
  for (const Push& push : pushes) {
    way += distance(from, push.to);
    from = push.to;
  }
  const auto n = static_cast<double>(pushes.size());
  return {static_cast<int>(pushes.size()),
          n * (seconds_of(c.approach.way) + kBesides) + way / c.k.speeds.pushing};
}

CoordinatorMemory begin_approach(const X& x) {
  CoordinatorMemory c = x.c;
  c.dead_end = DeadEnd::for_box;
  const auto pushes = plan_pushes(c.k.hall, c.box, c.k.goal);
  if (!pushes) return c;
  c.dead_end = DeadEnd::for_platform;
  const auto approach =
      plan_approach(c.k.hall, pushes->front(), c.box, {c.track[0].end, c.track[1].end}, c.k.drive);
  if (!approach) return c;
  c.dead_end = DeadEnd::none;
  c.approach = *approach;
  c.outlook = outlook_of(c, *pushes);
  const std::size_t first = c.approach.first;
  append(c.track[first], c.approach.way[first]);
  return c;
}
/// The second platform has no way yet, or waits to be told the first part of it.
bool first_comes(const X& x) { return !x.c.approach.way[1 - x.c.approach.first].empty(); }

CoordinatorMemory approach(const X& x) {
  CoordinatorMemory c = watch(x);
  const std::size_t first = c.approach.first, second = 1 - first;
  if (first_comes(x) && is_done(c.track[first], platform(x, first))) {
    append(c.track[second], c.approach.way[second]);
    c.approach.way[second].clear();
  }
  for (std::size_t k = 0; k < kPlatforms; ++k)
    if (is_ready(c.track[k], platform(x, k))) send_next(c.track[k]);
  return c;
}
bool is_behind(const X& x) { return !goes_on(x) || (!first_comes(x) && all_done(x)); }

// --- pushing -------------------------------------------------------------------------------------------------------

CoordinatorMemory begin_to_push(const X& x) {
  CoordinatorMemory c = x.c;
  c.run = begin_push(c.approach.push, c.approach.pair, c.k.hall.formation);
  c.rests_from = 0;
  ++c.pushes;
  return c;
}

/// Both platforms get a stretch in the same macrostep, and execute it in the same one.
void push_on(CoordinatorMemory& c) {
  c.run = with_next_stretch(c.run, c.k.hall, c.k.speeds);
  for (std::size_t k = 0; k < kPlatforms; ++k) {
    const double beside = member_at(c.k.hall.formation, c.approach.place[k]).y;
    append(c.track[k], {fragment_of(c.run.stretches.back(), beside, c.k.drive)});
    send_next(c.track[k]);
  }
}

bool at_end(const PushRun& run) { return !run.stretches.empty() && end_of(run).v == 0; }
bool is_short(const X& x) { return left_of(x.c.run).x > x.c.k.short_by; }
bool has_settled(const X& x) { return x.c.rests_from > 0 && x.i - x.c.rests_from >= kSettles; }

CoordinatorMemory push(const X& x) {
  CoordinatorMemory c = watch(x);
  if (is_new(x)) {
    const double since = age(x) - static_cast<double>(latency::kMotionToReport) + 1;
    c.run = with_reading(c.run, x.V.box.p, remaining(platform(x, 0)) + since, c.k.hall.formation);
  }
  if (!at_end(c.run)) {
    if (all_ready(x)) push_on(c);
  } else if (!all_arrived(x)) {
    c.rests_from = 0;
  } else if (c.rests_from == 0) {
    c.rests_from = x.i;
  } else if (has_settled(x) && is_short(x)) {
    push_on(c);
    c.rests_from = 0;
  }
  return c;
}
bool is_pushed(const X& x) {
  return !goes_on(x) || (at_end(x.c.run) && all_arrived(x) && has_settled(x) && !is_short(x));
}

// --- going away ----------------------------------------------------------------------------------------------------

CoordinatorMemory begin_retreat(const X& x) {
  CoordinatorMemory c = x.c;
  for (Track& track : c.track) append(track, straight(track.end, -c.k.hall.formation.retreat, c.k.drive));
  return c;
}
CoordinatorMemory send(const X& x) {
  CoordinatorMemory c = watch(x);
  for (std::size_t k = 0; k < kPlatforms; ++k)
    if (is_ready(c.track[k], platform(x, k))) send_next(c.track[k]);
  return c;
}
bool is_away(const X& x) { return position_gone(x) || all_done(x); }

// --- orders --------------------------------------------------------------------------------------------------------

template <int m>
std::array<GoOrder, kAgents> order(const X& x) {
  std::array<GoOrder, kAgents> orders;
  for (std::size_t k = 0; k < kAgents; ++k) {
    orders[k].m = m;
    orders[k].variant = x.t.paused || lost(x) ? kPaused : 0;
    if (k < kPlatforms) orders[k].go.fragment = x.c.track[k].sent;
  }
  return orders;
}

bool may_start(const X& x) {
  return x.T.h.started && std::ranges::all_of(x.T.agent, [](const Report& r) { return r.ready; });
}
CoordinatorMemory retain(const X& x) { return x.c; }
None nothing(const X&) { return {}; }

}  // namespace

PlanarPose error_of(const CoordinatorMemory& c) { return seen_from(c.k.goal, c.box); }

bool at_goal(const CoordinatorMemory& c) {
  const PlanarPose e = error_of(c);
  return std::hypot(e.x, e.y) <= c.k.tolerance.position && std::abs(e.phi) <= c.k.tolerance.heading;
}

bool position_gone(const X& x) {
  return x.c.k.timeout > 0 && x.c.lost_in > 0 && x.i - x.c.lost_in >= x.c.k.timeout;
}

bool goes_on(const X& x) {
  return x.c.dead_end == DeadEnd::none && !stays_behind(x.c.run) && !position_gone(x);
}

// clang-format off
const Motion<Coordinator> kStart   { 0, "wait for start",  retain,         watch,    nothing, nothing, order<0>, may_start,  "all agents are ready and start was given"};
const Motion<Coordinator> kLook    { 1, "look at the box", begin_look,     look,     nothing, nothing, order<1>, has_looked, "the box has been seen at rest"};
const Motion<Coordinator> kApproach{ 2, "approach",        begin_approach, approach, nothing, nothing, order<2>, is_behind,  "both platforms stand behind the box"};
const Motion<Coordinator> kPush    { 3, "push",            begin_to_push,  push,     nothing, nothing, order<3>, is_pushed,  "the box has come as far as it is to come"};
const Motion<Coordinator> kRetreat { 4, "retreat",         begin_retreat,  send,     nothing, nothing, order<4>, is_away,    "both platforms are away from the box"};
// clang-format on

}  // namespace mrroc::box_push
