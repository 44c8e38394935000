#include "tasks/box_push/pusher.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::box_push {
namespace {

using X = Pusher::X;

/// Standard deviation of the position, in the direction in which it is largest, from above [m].
double uncertainty(const PlatformEstimate& estimate) {
  return std::sqrt(std::max(0.0, estimate.covariance[0] + estimate.covariance[4]));
}

/// A fragment is said until the next one: the coordinator waits until it has been notified of.
bool hands_over(const X& x) { return x.T.go.fragment.number == x.c.handed + 1; }

// --- memory ----------------------------------------------------------------------------------------------------

/// The platform knows its position again when it knows it clearly better: it does not stop and go in turns.
PusherMemory watch(const X& x) {
  constexpr double kFound = 0.8;
  PusherMemory c = x.c;
  c.lost = uncertainty(x.e.estimate) > (x.c.lost ? kFound : 1) * x.c.k.lost;
  return c;
}
PusherMemory count(const X& x) {
  PusherMemory c = watch(x);
  if (hands_over(x)) ++c.handed;
  return c;
}
PusherMemory retain(const X& x) { return x.c; }

// --- effector --------------------------------------------------------------------------------------------------

PlatformCommand route(const X& x) {
  PlatformCommand y;
  y.pace = x.T.variant == kPaused ? 0 : 1;
  y.map = x.T.map.pose;
  return y;
}
PlatformCommand hand_over(const X& x) {
  PlatformCommand y = route(x);
  if (!hands_over(x)) return y;
  y.instruction = Instruction::set;
  y.fragment = x.T.go.fragment;
  return y;
}

// --- reports ---------------------------------------------------------------------------------------------------

template <int m>
PusherSaid tell(const X& x) {
  PusherSaid r;
  r.m = m;
  r.event = static_cast<int>(x.e.notified);
  r.driver_state = x.e.state;
  r.ready = x.e.position_known;
  r.position_known = x.e.position_known;
  // Not every fault is an answer: a silence, or a motion that fails when its command has long been executed.
  r.verdict = x.e.fault && x.e.verdict == Verdict::none ? Verdict::failed : x.e.verdict;
  r.fault = x.e.fault;
  const PlanarPose& p = x.e.estimate.p;
  r.T_0E = {p.x, p.y, 0, 0, 0, p.phi};
  const bool stands = x.e.notified == x.c.handed && x.e.remaining == 0 && x.e.at_rest;
  r.sensor = (stands ? kStands : 0) + (watch(x).lost ? kPositionLost : 0) + kIterationUnit * x.e.remaining;
  if (x.e.position_known) r.estimate = x.e.estimate;
  return r;
}

// --- terminal conditions ---------------------------------------------------------------------------------------

bool started(const X& x) { return x.T.m > 0 || x.T.finished; }
bool finished(const X& x) { return x.T.finished; }

None nothing(const X&) { return {}; }

}  // namespace

// clang-format off
const Motion<Pusher> kReady { 1, "wait for start", retain, watch, route,     nothing, tell<1>, started,  "the coordinator begins"};
const Motion<Pusher> kFollow{ 2, "follow",         retain, count, hand_over, nothing, tell<2>, finished, "the task is over"};
// clang-format on

}  // namespace mrroc::box_push
