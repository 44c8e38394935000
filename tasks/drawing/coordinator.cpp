// The coordinator's transition functions and terminal conditions (MS 8.2). Numbers in comments are the
// paper's.
#include <algorithm>
#include <cmath>

#include "tasks/drawing/playback.hpp"
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

using X = Coordinator::X;
using Memory = Coordinator::Memory;
using Orders = std::vector<Order>;

PenState pen(const X& x, std::size_t arm) { return static_cast<PenState>(x.T.agent[arm].sensor); }
bool on_paper(const X& x, std::size_t arm) { return pen(x, arm) == PenState::paper_surface; }
bool both_on_paper(const X& x) { return on_paper(x, 0) && on_paper(x, 1); }
Pose pose_of_arm_1(const X& x) { return pose_of(x.T.agent[0]); }
double macrostep_s(const Parameters& k) { return k.dt * k.n_s; }

// --- task time
// -----------------------------------------------------------------------------------------------------

/// y of E of the belt [m]: E is upright, as that of the arms, so its y is that of the base turned round.
double belt_position(const X& x) { return -x.T.agent[kConveyor].T_0E[1]; }

/// What is known of the belt one macrostep later.
BeltTrack track_belt(const X& x) {
  return x.has_conveyor() && x.c.k.belt_runs ? seen_at(x.c.belt, belt_position(x)) : x.c.belt;
}

/// The same, with the arms following.
BeltTrack follow_belt(const X& x) {
  const BeltTrack track = track_belt(x);
  return x.c.k.belt_runs ? follow(track, horizon(x.c.k.n_s) + x.c.k.belt_lag) : track;
}

/// Memory one macrostep later, nothing else changed.
Memory in_time(const X& x) {
  Memory c = x.c;
  c.belt = track_belt(x);
  std::shift_left(c.paces.begin(), c.paces.end(), 1);
  c.paces.back() = x.t.pace;
  return c;
}

// --- memory at entry
// -----------------------------------------------------------------------------------------------

Memory retain(const X& x) { return x.c; }

Memory begin_recording(const X& x) {  // (37)
  Memory c = x.c;
  c.recording = Recording(macrostep_s(c.k));
  c.p = 0;
  c.T_previous = pose_of_arm_1(x);
  return c;
}

Memory note_pose_and_trigger(const X& x) {  // the first node begins where the pen has touched
  Memory c = x.c;
  c.T_previous = c.T_seen = pose_of_arm_1(x);
  c.share = c.way = 0;
  c.lifted = false;
  c.trigger = x.T.h.trigger;
  return c;
}

Memory note_trigger(const X& x) {
  Memory c = x.c;
  c.trigger = x.T.h.trigger;
  return c;
}

Memory not_touched(const X& x) {
  Memory c = x.c;
  c.touched = false;
  c.held = {};
  c.begun = x.t.time;
  return c;
}

Memory note_instant(const X& x) {  // (49), i = i_0
  Memory c = x.c;
  c.instant = x.t.time;
  return c;
}

// --- memory
// --------------------------------------------------------------------------------------------------------

Memory follow_pose(const X& x) {  // (37): c[5] while the pen is led to the paper
  Memory c = in_time(x);
  c.T_previous = pose_of_arm_1(x);
  return c;
}

PenState pen_of_last_node(const Memory& c) {  // the first one begins on the paper
  return c.recording.empty() ? PenState::paper_surface : c.recording[c.recording.size() - 1].pen;
}

/// Adds the node in which E of arm 1 comes to T_end. A lift-off that no node has told of comes before all else: without
/// it the stroke would seem to go over into what follows.
void append_node(Memory& c, const Pose& T_end, PenState pen) {
  const AngleAxisPose v = angle_axis_from_pose(c.T_previous.inverse() * T_end) / macrostep_s(c.k);
  const bool left = c.lifted && pen_of_last_node(c) == PenState::paper_surface;
  c.recording =
      c.recording.appended({Twist::from(v.head<3>(), v.tail<3>()), left ? PenState::lift_off : pen});
  c.T_previous = T_end;
}

/// How many nodes one macrostep of teach-in is: one at full pace. At a lower pace it is as little as the pace, but not so
/// little that the pen would have to go its way much faster than a hand that does not slow down with task time, nor
/// that it jumps to where the hand has gone during a pause.
/// @param way  of E of arm 1 since task time went on last [m]
double nodes_of_macrostep(const Memory& c, double pace, double way) {
  constexpr double kHaste = 1.1;     // a node may be so much faster than the hand was at full pace
  constexpr double kJoining = 0.05;  // of the pen on a way that the hand went in a pause [m/s]
  constexpr double kNoWay = 1e-9;    // [m]
  if (pace == 1) return 1;
  const double as_the_hand = way / std::max(kHaste * c.way, kNoWay);
  const double joining = way / std::max(c.way, kJoining * macrostep_s(c.k));
  return std::max({pace, std::min(1.0, as_the_hand), joining});
}

/// A node is recorded for every macrostep of task time, in shares where task time goes slowly, as it is executed
/// (playback.hpp). In a pause task time stands still, and whatever the hand does leaves no node; what it has gone
/// meanwhile is joined straight, without ink if the pen was off the paper.
Memory record(const X& x) {           // (39), (40)
  constexpr double kRounding = 1e-9;  // of sums of shares
  Memory c = in_time(x);
  const double pace = c.paces.front();
  const bool off = pen(x, 0) == PenState::lift_off || pen(x, 0) == PenState::above_paper;
  if (pace == 0) {
    c.lifted = c.lifted || off;
    return c;
  }
  const Pose T = pose_of_arm_1(x);
  const AngleAxisPose way = angle_axis_from_pose(c.T_seen.inverse() * T);
  const double nodes = nodes_of_macrostep(c, pace, way.head<3>().norm());
  const double until = c.share + nodes + kRounding;  // of the node that this macrostep goes on with
  // Several nodes are the way that the hand has gone in a pause; where the pen is now is told by the next one.
  const bool joins = until >= 2;
  const PenState joining = c.lifted ? PenState::lift_off : pen_of_last_node(c);
  for (double n = 1; n <= until; ++n) {
    const double part = (n - c.share) / nodes;
    append_node(c, part > 1 - kRounding ? T : c.T_seen * pose_from_angle_axis(part * way),
                joins ? joining : pen(x, 0));
  }
  if (until >= 1) c.lifted = false;
  if (until < 1 || joins) c.lifted = c.lifted || off;
  c.share = std::max(0.0, c.share + nodes - std::floor(until));
  c.T_seen = T;
  if (pace == 1) c.way = way.head<3>().norm();
  return c;
}

/// The same while the arms follow a belt that runs by itself.
Memory following(const X& x) {
  Memory c = in_time(x);
  c.belt = follow_belt(x);
  return c;
}

/// Force with which each pen presses, however slowly task time goes.
std::array<ecp::HeldShares, kArms> held(const X& x) {
  std::array<ecp::HeldShares, kArms> shares;
  for (std::size_t arm = 0; arm < kArms; ++arm)
    shares[arm] = ecp::held_shares(kLowering, x.T.agent[arm].F_a, x.c.held[arm], x.t.pace);
  return shares;
}

Memory watch_contact(const X& x) {
  Memory c = following(x);
  if (both_on_paper(x) && !c.touched) c.instant = x.t.time + x.t.pace;
  c.touched = both_on_paper(x);
  c.held = held(x);
  return c;
}

/// Where the pens settled before the first stroke: later touches may be none.
Memory meet_sheets(const X& x) {
  Memory c = retain(x);
  for (std::size_t arm = 0; arm < kArms; ++arm)
    if (!c.met[arm]) c.met[arm] = pose_of(x.T.agent[arm]).p;
  return c;
}

template <bool paper>
Memory reproduce(const X& x) {  // (47), (51)
  Memory c = following(x);
  c.p = advance(x.c.recording, x.c.p, x.t.pace, paper).p;
  return c;
}

// --- orders to the arms (33)
// ---------------------------------------------------------------------------------------

Order order(const X& x, int m, const TaskFrameCommand& frame, const ecp::HeldShares& shares = {}) {
  Order o;
  o.m = m;
  o.arm.mu = Interpolation::tcim_velocity;
  o.arm.frame = ecp::at_pace(frame, x.t.pace, shares);
  o.arm.n_s = static_cast<std::uint16_t>(x.c.k.n_s);
  o.arm.n_Q = static_cast<std::uint16_t>(x.c.k.n_s - 1);
  return o;
}

/// The conveyor's order behind those of the arms, in a run that has one. One that moves for the arms takes over their y
/// (MS 8.3): it shifts the sheets by -v_y. One that runs by itself does not read its command.
Orders with_conveyor(const X& x, int m, Orders arms) {
  if (!x.has_conveyor()) return arms;
  Order belt = order(x, m, kBlocked);
  if (!x.c.k.belt_runs)
    for (Order& arm : arms) {
      if (arm.arm.frame.y.b != Behaviour::unguarded) continue;  // a hand leads it
      belt.arm.frame.y.velocity = -arm.arm.frame.y.velocity;
      arm.arm.frame.y.velocity = 0;
    }
  arms.push_back(belt);
  return arms;
}

/// Orders of a behaviour in which the arms follow a belt that runs by itself. It does so in a pause, too, so its velocity is
/// not slowed down.
Orders following_belt(const X& x, int m, Orders arms) {
  if (x.has_conveyor() && x.c.k.belt_runs) {
    const double v = (follow_belt(x).followed - x.c.belt.followed) / macrostep_s(x.c.k);
    for (Order& arm : arms) arm.arm.frame.y.velocity += v;
  }
  return with_conveyor(x, m, std::move(arms));
}

template <int m>
Orders teach(const X& x) {  // tabs 1 and 2
  TaskFrameCommand led = kCompliant;
  if (m == 2 && on_paper(x, 0)) led.z.force = x.c.k.teach_force;
  return with_conveyor(x, m, {order(x, m, led), order(x, m, kBlocked)});
}

template <int m, const TaskFrameCommand& frame>
Orders both(const X& x) {
  return with_conveyor(x, m, {order(x, m, frame), order(x, m, frame)});
}

Orders lift(const X& x) {  // tab. 3(b)
  return following_belt(x, 6, {order(x, 6, kLiftOff), order(x, 6, kLiftOff)});
}

Orders lower(const X& x) {  // tab. 3(a)
  const auto shares = held(x);
  return following_belt(x, 4, {order(x, 4, kLowering, shares[0]), order(x, 4, kLowering, shares[1])});
}

template <int m, bool paper>
Orders replay(const X& x) {  // (46), tab. 4
  TaskFrameCommand frame = paper ? kOnPaper : kAbovePaper;
  if (paper) frame.z.force = x.c.k.draw_force;
  const Advance a = advance(x.c.recording, x.c.p, x.t.pace, paper);
  Order o = order(x, m, frame);
  o.arm.frame.x.velocity = a.vx;  // the pace is in it already
  o.arm.frame.y.velocity = a.vy;
  return following_belt(x, m, {o, o});
}

// --- terminal conditions
// -------------------------------------------------------------------------------------------

bool may_start(const X& x) { return x.T.h.started && std::ranges::all_of(x.T.agent, &Report::ready); }
bool touched_paper(const X& x) { return on_paper(x, 0); }           // (38)
bool triggered(const X& x) { return x.T.h.trigger > x.c.trigger; }  // (41), (43)
bool settled(const X& x) {                                          // (45)
  return both_on_paper(x) && x.c.touched && x.t.time - x.c.instant >= x.c.k.settle;
}
bool lowered(const X& x) { return settled(x) || no_contact(x); }
bool stroke_ends(const X& x) {  // (48)
  return !next_node_is(x.c.recording, x.c.p, true) || arm_off_its_sheet(x);
}
bool lifted(const X& x) { return x.t.time - x.c.instant >= x.c.k.lift_off; }         // (50)
bool travel_ends(const X& x) { return !next_node_is(x.c.recording, x.c.p, false); }  // (52)

None nothing(const X&) { return {}; }

}  // namespace

bool no_contact(const X& x) { return !x.c.touched && x.t.time - x.c.begun >= x.c.k.touch_timeout; }

std::optional<std::size_t> arm_off_its_sheet(const X& x) {
  // Chosen well beyond what pens on their sheets do, for nothing depends on how soon it is seen: sheets are tilted by up
  // to 1 degree (0.017), 1 N presses 2e3 N/m in by 0.5 mm, and copies with the wrong kinematic set are off by 1 mm.
  constexpr double kSteepest = 0.1;  // height per way
  constexpr double kUneven = 0.008;  // [m]
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    if (!x.c.met[arm]) continue;
    const Vector3 way = pose_of(x.T.agent[arm]).p - *x.c.met[arm];
    if (std::abs(way.z()) > kUneven + kSteepest * way.head<2>().norm()) return arm;
  }
  return {};
}

const Motion<Coordinator> kWaitForStart{0,
                                        "wait for start",
                                        retain,
                                        in_time,
                                        nothing,
                                        nothing,
                                        both<0, kBlocked>,
                                        may_start,
                                        "both arms ready and start given"};

// clang-format off
const std::array<Motion<Coordinator>, 7> kCoordinator{{
  // m  name                  entry                  memory            effector sensors  orders                 terminal condition
  {  1, "lead to the paper",  begin_recording,       follow_pose,      nothing, nothing, teach<1>,              touched_paper, "the taught pen touched the paper"},
  {  2, "record",             note_pose_and_trigger, record,           nothing, nothing, teach<2>,              triggered, "the operator's trigger"},
  {  3, "lead to the start",  note_trigger,          in_time,          nothing, nothing, both<3, kCompliant>,   triggered, "the operator's trigger"},
  {  4, "lowering",           not_touched,           watch_contact,    nothing, nothing, lower,                 lowered, "both pens settled on the paper"},
  {  5, "draw on the paper",  meet_sheets,           reproduce<true>,  nothing, nothing, replay<5, true>,       stroke_ends, "the stroke ended, or a pen is off its sheet"},
  {  6, "lift off",           note_instant,          following,        nothing, nothing, lift,                  lifted, "the time of the lift-off elapsed"},
  {  7, "travel above paper", retain,                reproduce<false>, nothing, nothing, replay<7, false>,      travel_ends, "the next stroke begins"},
}};
// clang-format on

}  // namespace mrroc::drawing
