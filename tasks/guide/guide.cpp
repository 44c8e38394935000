#include "tasks/guide/guide.hpp"

#include <algorithm>
#include <cmath>

#include "ecp/generators/force.hpp"

namespace mrroc::guide {
namespace {

using X = Arm::X;

constexpr double kWayShare = 0.3;  // of a macrostep in the mean of the way
// From the reading of a pose to the middle of the macrostep that answers it, in macrosteps.
constexpr double kReaction = static_cast<double>(latency::kCommandToReply) - 0.5;

/// @return how far behaviour has come of a time, 0..1
double share_of(const X& x, double seconds) {
  return static_cast<double>(ecp::age(x)) * kPacing.macrostep_s() / std::max(seconds, kPacing.macrostep_s());
}

double entered(const X& x) { return smooth(share_of(x, x.c.k->entry)); }
double held(const X&) { return 1; }
double left(const X& x) { return 1 - smooth(share_of(x, x.c.k->leave)); }

// --- f_cc ---------------------------------------------------------------------------------------------------

Memory find_place(const X& x) {
  Memory c = x.c;
  const Pose T_0E = pose_of(x.e);
  c.R_0W = T_0E.R * c.k->T_WE.R.transpose();
  c.s = c.k->fixture.stand(T_0E.p, {}).s;
  c.way = 0;
  return c;
}

Memory follow_place(const X& x) {
  Memory c = x.c;
  c.s = standing(x).s;
  double way = c.s - x.c.s;
  if (const Curve* curve = c.k->fixture.curve(); curve && curve->closed())
    way -= curve->length() * std::round(way / curve->length());
  c.way += kWayShare * (way - c.way);
  return c;
}

// --- f_ce ---------------------------------------------------------------------------------------------------

EffectorCommand lead(const X& x) {
  TaskFrameCommand frame;
  for (const Axis a : {Axis::x, Axis::y, Axis::z})
    frame[a] = c(0, x.c.k->law.free_inertia, x.c.k->law.free_mobility);
  return ecp::with_tool(ecp::move_arm(frame, kPacing), x.c.k->T_WE);
}

/// The tool's frame is turned to where the tool will be when the arm moves.
template <double (*share)(const X&)>
EffectorCommand hold(const X& x) {
  const Setup& k = *x.c.k;
  const Standing now = standing(x);
  const double most_speed = share == held ? HUGE_VAL : k.entry_speed;
  const Matrix3 R_0E = k.fixture.axes(now.s + kReaction * x.c.way);
  return ecp::with_tool(ecp::move_arm(rows(k.law, k.fixture, now, share(x), most_speed), kPacing),
                        {x.c.R_0W.transpose() * R_0E, k.T_WE.p});
}

// --- f_tau --------------------------------------------------------------------------------------------------

bool is_near(const X& x) { return x.c.k->fixture.stand(pose_of(x.e).p, {}).distance() <= x.c.k->capture; }
/// Not before its force is small enough to go on without a step.
bool has_entered(const X& x) {
  const Setup& k = *x.c.k;
  const Standing s = standing(x);
  const double walls =
      std::max(std::abs(wall_force(k.law, s.beyond[0])), std::abs(wall_force(k.law, s.beyond[1])));
  return share_of(x, k.entry) >= 1 &&
         std::max(k.law.stiffness * s.off(), walls) <= k.entry_speed / k.law.mobility;
}
bool told(const X& x) { return x.T.go_on[0]; }
bool has_left(const X& x) { return share_of(x, x.c.k->leave) >= 1; }

}  // namespace

Standing standing(const X& x) { return x.c.k->fixture.stand(pose_of(x.e).p, x.c.s); }

// clang-format off
const std::array<Motion<Arm>, 5> kGuide{{
  // m        name                   entry             memory            command        sensors              coordinator
  //          terminal condition
  {  1,       "to the fixture",      ecp::retain<Arm>, ecp::retain<Arm>, lead,          ecp::no_sensor<Arm>, ecp::tell<Arm>, is_near, "the tool is near the fixture"},
  {  kEnter,  "enter",               find_place,       follow_place,     hold<entered>, ecp::no_sensor<Arm>, ecp::tell<Arm>, has_entered, "the fixture has taken hold"},
  {  kGuided, "along the fixture",   follow_place,     follow_place,     hold<held>,    ecp::no_sensor<Arm>, ecp::tell<Arm>, told, "the operator's trigger"},
  {  kLeave,  "leave",               follow_place,     follow_place,     hold<left>,    ecp::no_sensor<Arm>, ecp::tell<Arm>, has_left, "the fixture has let go"},
  {  kAway,   "away",                ecp::retain<Arm>, ecp::retain<Arm>, lead,          ecp::no_sensor<Arm>, ecp::tell<Arm>, told, "the operator's trigger"},
}};
// clang-format on

}  // namespace mrroc::guide
