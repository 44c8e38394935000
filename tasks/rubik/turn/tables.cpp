#include "tasks/rubik/turn/tables.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/representation.hpp"

namespace mrroc::rubik {
namespace {

using X = Arm::X;
using std::numbers::pi;

/// dg(m) of the jaws. @tparam sign  -1: they close
template <const TaskFrameCommand& frame, int sign>
EffectorCommand row(const X& x) {
  return command(x, frame, sign * kJawStep);
}

/// @return dg of jaws that touch nothing, per macrostep [m]: that of the order; without one the tables'
double jaw_step_of(const CubeOrder& order) { return order.jaw_step > 0 ? order.jaw_step : kJawStep; }

/// The same as quickly as is ordered.
template <const TaskFrameCommand& frame, int sign>
EffectorCommand as_ordered(const X& x) {
  return command(x, frame, sign * jaw_step_of(x.T.cube));
}

/// B about z of a face that stands: tab. 7's, or a share of the order's when that is far above it.
double least_mobility(const TurnOrder& turn) {
  return std::min(turn.mobility, std::max(kTurn.az.mobility, kOfStanding * turn.mobility));
}

/// tab. 7(a) with what the order has for it.
EffectorCommand turn(const X& x) {
  TaskFrameCommand frame = kTurn;
  frame.az = c(x.c.turn.torque, kTurn.az.inertia, x.c.mobility);
  return command(x, frame, 0);
}

/// y_cT: m of the event, once it is seen. (62)
template <int m, bool (*seen)(const X&)>
ArmReport event(const X& x) {
  ArmReport r;
  r = ecp::report_of(x, m);
  r.event = seen(x) ? m : 0;
  return r;
}

/// f_tau: element l of what the coordinator sends (60), or it has left the cycle.
template <int l>
bool told(const X& x) {
  return x.T.go_on[l - 1] || x.T.m > 6 || x.T.finished;
}

constexpr auto kRetain = ecp::retain<Arm>;
constexpr auto kNoSensor = ecp::no_sensor<Arm>;

}  // namespace

EffectorCommand command(const X& x, const TaskFrameCommand& frame, double dg) {
  EffectorCommand out = ecp::move_arm(frame, kPacing);
  if (dg != 0) out.arm.gripper = std::clamp(x.e.gripper + dg, kClosest, kWidest);
  return out;
}

bool pushing(const X& x) { return x.e.F_a[Axis::z] > kApproachForce; }
bool settled(const X& x) { return ecp::age(x) >= kSettling; }
bool narrow(const X& x) { return x.e.gripper <= kNarrow; }
bool gripped(const X& x) { return x.e.blocked; }
bool turned(const X& x) {
  return std::copysign(1.0, x.c.turn.torque) * track_angle(x).angle >= x.c.turn.angle;
}
bool released(const X& x) { return x.e.gripper - x.c.gap >= kRelease; }
bool nothing(const X&) { return false; }

ArmMemory keep_gap(const X& x) {
  ArmMemory c = x.c;
  c.gap = x.e.gripper;
  return c;
}

ArmMemory keep_pose(const X& x) {
  ArmMemory c = x.c;
  c.T_0E = pose_of(x.e);
  c.angle = 0;
  return c;
}

ArmMemory begin_turn(const X& x) {
  ArmMemory c = keep_pose(x);
  c.turn = x.T.cube.turn;
  c.mobility = least_mobility(c.turn);
  return c;
}

double angle_about_z(const Pose& from, const Pose& to, double last) {
  const Matrix3 R = from.R.transpose() * to.R;
  const double angle = std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
  return angle + 2 * pi * std::round((last - angle) / (2 * pi));
}

ArmMemory track_angle(const X& x) {
  ArmMemory c = x.c;
  c.angle = angle_about_z(c.T_0E, pose_of(x.e), c.angle);
  return c;
}

ArmMemory track_turn(const X& x) {
  ArmMemory c = track_angle(x);
  c.turn.torque = x.T.cube.turn.torque;
  const double least = least_mobility(c.turn);
  const bool resists = std::abs(x.e.F_a[Axis::az]) > kResists * std::abs(c.turn.torque);
  c.mobility = resists ? least : std::min(kQuicken * c.mobility, c.turn.mobility);
  return c;
}

// clang-format off
const std::array<Motion<Arm>, 6> kWorker{{
  // m  name        entry      memory       command           sensors    event                terminal condition, in words
  {  1, "approach", kRetain,   kRetain,     row<kApproach, 0>, kNoSensor, event<1, pushing>,  told<1>, "the hand presses (66)"},
  {  2, "settle",   kRetain,   kRetain,     row<kApproach, 0>, kNoSensor, event<2, settled>,  told<2>, "the force has settled (69)"},
  {  3, "close y",  kRetain,   kRetain,     as_ordered<kCloseY, -1>, kNoSensor, event<3, narrow>,   told<1>, "the jaws are about to touch (71)"},
  {  4, "close xy", kRetain,   kRetain,     as_ordered<kCloseXY, -1>, kNoSensor, event<4, gripped>,  told<2>, "the jaws are blocked (72)"},
  {  5, "await the turn", kRetain,   kRetain,     row<kStill, 0>,    kNoSensor, event<5, nothing>,  told<1>, "the face has turned"},
  {  6, "await release", kRetain,   kRetain,     row<kStill, 0>,    kNoSensor, event<6, nothing>,  told<2>, "the jaws have opened"},
}};
const std::array<Motion<Arm>, 6> kHolder{{
  {  1, "await contact", kRetain,   kRetain,     row<kStill, 0>,    kNoSensor, event<1, nothing>,  told<1>, "the other hand presses"},
  {  2, "await settling", kRetain,   kRetain,     row<kStill, 0>,    kNoSensor, event<2, nothing>,  told<2>, "the force has settled"},
  {  3, "await closing", kRetain,   kRetain,     row<kStill, 0>,    kNoSensor, event<3, nothing>,  told<1>, "the other jaws are about to touch"},
  {  4, "await the grip", kRetain,   kRetain,     row<kStill, 0>,    kNoSensor, event<4, nothing>,  told<2>, "the other jaws are blocked"},
  {  5, "turn",     begin_turn, track_turn, turn,              kNoSensor, event<5, turned>,   told<1>, "the angle is reached (75)"},
  {  6, "open",     keep_gap,  kRetain,     as_ordered<kStill, 1>,   kNoSensor, event<6, released>, told<2>, "the jaws have opened (77)"},
}};
// clang-format on

}  // namespace mrroc::rubik
