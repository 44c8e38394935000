#include "tasks/haptic/haptic.hpp"

#include <algorithm>
#include <cmath>

#include "ecp/transparent.hpp"

namespace mrroc::haptic {
namespace {

using X = Coordinator::X;
using Orders = std::array<Order, 2>;

constexpr std::array kLinear{Axis::x, Axis::y, Axis::z};

Matrix3 R_0E(const X& x, std::size_t arm) { return pose_of(x.T.agent[arm]).R; }

// --- f_cc ---------------------------------------------------------------------------------------------------

Memory keep(const X& x) { return x.c; }

Memory begin_coupling(const X& x) {
  Memory c = x.c;
  for (const std::size_t arm : {kMaster, kSlave}) c.begin[arm] = pose_of(x.T.agent[arm]).p;
  c.coupling = coupled(c.k.law);
  c.trigger = x.T.h.trigger;
  return c;
}

Memory go_on_coupled(const X& x) {
  Memory c = x.c;
  c.coupling = couple(std::move(c.coupling), c.k.law, sides(x), x.i, x.t.pace);
  return c;
}

Memory note_trigger(const X& x) {
  Memory c = x.c;
  c.trigger = x.T.h.trigger;
  return c;
}

// --- f_cT: orders. Orientations stay ------------------------------------------------------------------------

/// @param F_d  on the master in its base [N]
Order led(const X& x, int m, const Vector3& F_d) {
  const Vector3 F = R_0E(x, kMaster).transpose() * F_d;
  const Compliance& k = x.c.k.law.master;
  TaskFrameCommand frame;
  for (const Axis a : kLinear) frame[a] = c(F[static_cast<int>(a)], k.inertia, k.mobility);
  return ecp::order(m, frame, kPacing);
}

/// @param v_d  of the slave in its base [m/s]
Order following(const X& x, int m, const Vector3& v_d) {
  const Vector3 v = R_0E(x, kSlave).transpose() * v_d;
  const Compliance& k = x.c.k.law.slave;
  TaskFrameCommand frame;
  for (const Axis a : kLinear) frame[a] = g(v[static_cast<int>(a)], k.inertia, k.mobility);
  return ecp::order(m, frame, kPacing);
}

Orders wait(const X&) {
  const Order rest = ecp::order(0, {}, kPacing);
  return {rest, rest};
}

Orders lead_and_follow(const X& x) {
  const Coupling now = couple(x.c.coupling, x.c.k.law, sides(x), x.i, x.t.pace);
  return {led(x, kCoupled, now.F_d), following(x, kCoupled, now.v_d)};
}

/// The slave stays and gives way; the force on the master fades.
Orders let_go(const X& x) {
  const double age = static_cast<double>(x.i - x.i_0) * x.c.k.law.macrostep;
  const double left = std::max(0.0, 1 - age / x.c.k.fade);
  return {led(x, kUncoupled, left * x.c.coupling.F_d), following(x, kUncoupled, Vector3::Zero())};
}

// --- f_tau --------------------------------------------------------------------------------------------------

bool may_start(const X& x) { return x.T.h.started && std::ranges::all_of(x.T.agent, &Report::ready); }
bool triggered(const X& x) { return x.T.h.trigger > x.c.trigger; }

None nothing(const X&) { return {}; }

}  // namespace

Sides sides(const X& x) {
  const Pose master = pose_of(x.T.agent[kMaster]), slave = pose_of(x.T.agent[kSlave]);
  return {.x_m = master.p - x.c.begin[kMaster],
          .x_s = slave.p - x.c.begin[kSlave],
          .F_s = slave.R * x.T.agent[kSlave].F_a.linear()};
}

// clang-format off
const Motion<Coordinator> kWaitForStart
  {  0,          "wait for start", keep,           keep,          nothing, nothing, wait,            may_start, "both arms ready and start given"};
const std::array<Motion<Coordinator>, 2> kBehaviours{{
  // m           name              f_entry         f_cc           f_ce     f_cV     f_cT             f_tau
  {  kCoupled,   "coupled",        begin_coupling, go_on_coupled, nothing, nothing, lead_and_follow, triggered, "the operator's trigger"},
  {  kUncoupled, "uncoupled",      note_trigger,   keep,          nothing, nothing, let_go,          triggered, "the operator's trigger"},
}};
// clang-format on

}  // namespace mrroc::haptic
