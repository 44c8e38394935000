// The coordinator's transition functions and terminal conditions (MS 8.2). Numbers in comments are the
// paper's.
#include <algorithm>

#include "tasks/drawing/playback.hpp"
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

using X = Coordinator::X;
using Memory = Coordinator::Memory;
using Orders = std::array<Order, kArms>;

PenState pen(const X& x, std::size_t arm) { return static_cast<PenState>(x.T.agent[arm].sensor); }
bool on_paper(const X& x, std::size_t arm) { return pen(x, arm) == PenState::paper_surface; }
bool both_on_paper(const X& x) { return on_paper(x, 0) && on_paper(x, 1); }
Pose pose_of_arm_1(const X& x) {
  return pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(x.T.agent[0].T_0E.data()));
}
double macrostep_s(const Parameters& k) { return k.dt * k.n_s; }

// --- task time
// -----------------------------------------------------------------------------------------------------

double next_pace(const X& x) {
  const double step = x.T.h.paused ? -x.c.k.pace_change : x.c.k.pace_change;
  return std::clamp(x.c.pace + step, 0.0, 1.0);
}

/// Memory one macrostep later, nothing else changed.
Memory in_time(const X& x) {
  Memory c = x.c;
  c.pace = next_pace(x);
  c.time += c.pace;
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
  c.T_previous = pose_of_arm_1(x);
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
  c.begun = c.time;
  return c;
}

Memory note_instant(const X& x) {  // (49), i = i_0
  Memory c = x.c;
  c.instant = c.time;
  return c;
}

// --- memory
// --------------------------------------------------------------------------------------------------------

Memory follow_pose(const X& x) {  // (37): c[5] while the pen is led to the paper
  Memory c = in_time(x);
  c.T_previous = pose_of_arm_1(x);
  return c;
}

Memory record(const X& x) {  // (39), (40)
  Memory c = in_time(x);
  const Pose T = pose_of_arm_1(x);
  const AngleAxisPose r = angle_axis_from_pose(c.T_previous.inverse() * T);
  // During a pause nodes in which nothing moves are left out: task time stands still.
  constexpr double kStill = 2e-5;  // [m] in a macrostep
  if (c.pace == 0 && r.norm() < kStill && pen(x, 0) != PenState::lift_off) return c;
  const AngleAxisPose v = r / macrostep_s(c.k);
  c.recording = c.recording.appended({Twist::from(v.head<3>(), v.tail<3>()), pen(x, 0)});
  c.T_previous = T;
  return c;
}

Memory watch_contact(const X& x) {
  Memory c = in_time(x);
  if (both_on_paper(x) && !c.touched) c.instant = c.time;
  c.touched = both_on_paper(x);
  return c;
}

template <bool paper>
Memory reproduce(const X& x) {  // (47), (51)
  Memory c = in_time(x);
  c.p = advance(x.c.recording, x.c.p, c.pace, paper).p;
  return c;
}

// --- orders to the arms (33)
// ---------------------------------------------------------------------------------------

Order order(const X& x, int m, const TaskFrameCommand& frame) {
  Order o;
  o.m = m;
  o.arm.mu = Interpolation::tcim_velocity;
  o.arm.frame = at_pace(frame, next_pace(x));
  o.arm.n_s = static_cast<std::uint16_t>(x.c.k.n_s);
  o.arm.n_Q = static_cast<std::uint16_t>(x.c.k.n_s - 1);
  return o;
}

template <int m>
Orders teach(const X& x) {  // tabs 1 and 2
  TaskFrameCommand led = kCompliant;
  if (m == 2 && on_paper(x, 0)) led.z.force = x.c.k.teach_force;
  return {order(x, m, led), order(x, m, kBlocked)};
}

template <int m, const TaskFrameCommand& frame>
Orders both(const X& x) {
  return {order(x, m, frame), order(x, m, frame)};
}

template <int m, bool paper>
Orders replay(const X& x) {  // (46), tab. 4
  TaskFrameCommand frame = paper ? kOnPaper : kAbovePaper;
  if (paper) frame.z.force = x.c.k.draw_force;
  const Advance a = advance(x.c.recording, x.c.p, next_pace(x), paper);
  Order o = order(x, m, frame);
  o.arm.frame.x.velocity = a.vx;  // the pace is in it already
  o.arm.frame.y.velocity = a.vy;
  return {o, o};
}

// --- terminal conditions
// -------------------------------------------------------------------------------------------

bool may_start(const X& x) { return x.T.h.started && x.T.agent[0].ready && x.T.agent[1].ready; }
bool touched_paper(const X& x) { return on_paper(x, 0); }           // (38)
bool triggered(const X& x) { return x.T.h.trigger > x.c.trigger; }  // (41), (43)
bool settled(const X& x) {                                          // (45)
  return both_on_paper(x) && x.c.touched && x.c.time - x.c.instant >= x.c.k.settle;
}
bool lowered(const X& x) { return settled(x) || no_contact(x); }
bool stroke_ends(const X& x) { return !next_node_is(x.c.recording, x.c.p, true); }   // (48)
bool lifted(const X& x) { return x.c.time - x.c.instant >= x.c.k.lift_off; }         // (50)
bool travel_ends(const X& x) { return !next_node_is(x.c.recording, x.c.p, false); }  // (52)

None nothing(const X&) { return {}; }

}  // namespace

bool no_contact(const X& x) { return !x.c.touched && x.c.time - x.c.begun >= x.c.k.touch_patience; }

TaskFrameCommand at_pace(TaskFrameCommand frame, double pace) {
  for (const Axis a : kAxes) frame[a].velocity *= pace;
  return frame;
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
  {  4, "lowering",           not_touched,           watch_contact,    nothing, nothing, both<4, kLowering>,    lowered, "both pens settled on the paper"},
  {  5, "draw on the paper",  retain,                reproduce<true>,  nothing, nothing, replay<5, true>,       stroke_ends, "the stroke ended"},
  {  6, "lift off",           note_instant,          in_time,          nothing, nothing, both<6, kLiftOff>,     lifted, "the time of the lift-off elapsed"},
  {  7, "travel above paper", retain,                reproduce<false>, nothing, nothing, replay<7, false>,      travel_ends, "the next stroke begins"},
}};
// clang-format on

}  // namespace mrroc::drawing
