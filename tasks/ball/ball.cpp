#include "tasks/ball/ball.hpp"

#include <algorithm>
#include <cmath>

#include "ecp/generators/force.hpp"
#include "ecp/transparent.hpp"
#include "tasks/ball/grip.hpp"
#include "tasks/ball/law.hpp"
#include "tasks/ball/path.hpp"

namespace mrroc::ball {
namespace {

using X = Coordinator::X;
using Orders = std::array<Order, kArms>;

constexpr double kApproachSpeed = 0.01;  // [m/s]
constexpr double kLeavingSpeed = 0.02;   // [m/s]
constexpr double kLeaving = 150;         // macrosteps
constexpr double kGrowing = 75;          // macrosteps in which the force grows
constexpr double kApproachLimit = 1500;  // macrosteps
constexpr double kSqueezeLimit = 500;    // macrosteps
constexpr double kWeighing = 50;         // macrosteps
constexpr int kBounce = 10;              // macrosteps that are more than a bounce
constexpr int kSteady = 25;              // macrosteps of a force that has settled
constexpr double kSettled = 0.7;         // [N]
constexpr double kClosedIn = 0.02;       // of palms between which nothing is any more [m]
constexpr double kNobody = 1.5;          // difference of both forces when nobody pushes [N]
constexpr double kFollowing = 0.02;      // share per macrostep
constexpr int kGone = 5;                 // macrosteps of what is no noise
constexpr double kOnPedestal = 0.3;      // share of the load
constexpr double kStayed = 0.25;  // share of the weight that is told: less than that has not been lifted
// From the reading of a pose to the beginning of the macrostep that answers it, in macrosteps.
constexpr double kReaction = 2;

// --- f_entry and f_cc ----------------------------------------------------------------------------------------

PairState state_of(const X& x) { return pair_state(x.c.k, x.T.agent); }

Memory retain(const X& x) { return x.c; }

Memory begin(const X& x) {
  Memory c = x.c;
  c.age = 0;
  c.steady = 0;
  c.touching = {};
  return c;
}

/// The palms are where they are wanted from now on.
Memory begin_here(const X& x) {
  Memory c = begin(x);
  const PairState s = state_of(x);
  for (std::size_t arm = 0; arm < kArms; ++arm) c.grip[arm] = s.T_UE[arm].p;
  return c;
}

Memory begin_weighing(const X& x) {
  Memory c = begin(x);
  c.load = 0;
  return c;
}

void fail(Memory& c, Failure failure) {
  if (c.failure == Failure::none) c.failure = failure;
}

/// What happens to the object between the palms.
void watch_force(Memory& c, const PairState& s) {
  const double force = contact_force(s, c.closed);
  c.lost = force < c.k.least_force ? c.lost + 1 : 0;
  if (c.lost > kGone || s.distance < c.closed - kClosedIn) fail(c, Failure::lost);
  if (force > c.k.most_force) fail(c, Failure::crushed);
  if (std::abs(s.press[0] - s.press[1]) < kNobody) c.closed += kFollowing * (s.distance - c.closed);
}

Memory come_nearer(const X& x) {
  Memory c = x.c;
  const PairState s = state_of(x);
  c.age += x.t.pace;
  for (std::size_t arm = 0; arm < kArms; ++arm)
    c.touching[arm] = ecp::in_contact(c.touching[arm], s.press[arm], c.k.touch, 0.6);
  if (s.distance < (1 - c.k.size_tolerance) * c.k.body.size || c.age > kApproachLimit)
    fail(c, Failure::no_contact);
  return c;
}

Memory press_on(const X& x) {
  Memory c = x.c;
  const PairState s = state_of(x);
  c.age += x.t.pace;
  const bool settled =
      std::ranges::all_of(s.press, [&](double f) { return std::abs(f - c.k.force) < kSettled; });
  c.steady = c.age > kGrowing && settled ? c.steady + 1 : 0;
  if (*std::ranges::min_element(s.press) > c.k.most_force) fail(c, Failure::crushed);
  if (c.age > kSqueezeLimit) fail(c, Failure::no_contact);
  if (c.steady >= kSteady) c.closed = s.distance;
  if (c.steady >= kSteady && std::abs(s.distance - c.k.body.size) > c.k.size_tolerance * c.k.body.size)
    fail(c, Failure::not_as_told);
  return c;
}

/// While the object is held.
template <bool yields>
Memory carry(const X& x) {
  Memory c = x.c;
  const PairState s = state_of(x);
  c.age += x.t.pace;
  const Vector3 pushed = yields ? pushed_by_hand(s, c.load) : Vector3::Zero();
  if (pushed.isZero()) c.shift = share_load(c.shift, s);
  c.yielded = yield(c.yielded, pushed);
  watch_force(c, s);
  return c;
}

double borne(const PairState& s) { return s.across[0].z() + s.across[1].z(); }

Memory weigh(const X& x) {
  Memory c = carry<false>(x);
  c.load += (borne(state_of(x)) - c.load) / std::max(1.0, c.age);
  if (c.age >= kWeighing && c.load > most_load(c.k.force, c.k.body.friction, c.k.margin))
    fail(c, Failure::too_heavy);
  if (c.age >= kWeighing && c.load < kStayed * kGravity * c.k.body.mass) fail(c, Failure::stayed);
  return c;
}

Memory put_down(const X& x) {
  Memory c = carry<false>(x);
  c.steady = borne(state_of(x)) < kOnPedestal * c.load ? c.steady + 1 : 0;
  return c;
}

Memory leave(const X& x) {
  Memory c = x.c;
  c.age += x.t.pace;
  return c;
}

// --- f_cT ----------------------------------------------------------------------------------------------------

template <int m>
PalmGoal goal(const X& x, std::size_t arm) {
  const Memory& c = x.c;
  const double next = c.age + x.t.pace;
  const Vector3 side = (arm == 0 ? -0.5 : 0.5) * c.shift;
  PalmGoal g;
  g.place = c.grip[arm] + path(c.k, m, c.age - kReaction * x.t.pace) + c.yielded + side;
  g.velocity = (path(c.k, m, next) - path(c.k, m, c.age)) / kPacing.macrostep_s();
  return g;
}

template <int m>
Orders approach(const X& x) {
  const PairState s = state_of(x);
  Orders orders;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    TaskFrameCommand frame = hold_place(arm, s.T_UE[arm], goal<m>(x, arm));
    frame.z = ecp::approach(Axis::z, kApproachSpeed, x.c.k.touch).z;
    frame.z.velocity *= x.t.pace;
    orders[arm] = ecp::order(m, frame, kPacing);
  }
  return orders;
}

Orders held_with(const X& x, int m, double force, const std::array<PalmGoal, kArms>& goals) {
  const PairState s = state_of(x);
  Orders orders;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    TaskFrameCommand frame = hold_place(arm, s.T_UE[arm], goals[arm]);
    frame.z = arm == 0 ? press_in_place(force, s, (goals[0].place + goals[1].place) / 2) : press(force);
    orders[arm] = ecp::order(m, frame, kPacing);
  }
  return orders;
}

template <int m>
Orders hold(const X& x) {
  return held_with(x, m, x.c.k.force, {goal<m>(x, 0), goal<m>(x, 1)});
}

Orders squeeze(const X& x) {
  const Parameters& k = x.c.k;
  const double force = k.touch + (k.force - k.touch) * std::min(1.0, x.c.age / kGrowing);
  return held_with(x, kSqueeze, force, {goal<kSqueeze>(x, 0), goal<kSqueeze>(x, 1)});
}

Orders release(const X& x) {
  const Order o = ecp::order(kRelease, {.z = u(-kLeavingSpeed * x.t.pace)}, kPacing);
  return {o, o};
}

Orders wait(const X&) {
  const Order o = ecp::order(0, {}, kPacing);
  return {o, o};
}

// --- f_tau ---------------------------------------------------------------------------------------------------

bool may_start(const X& x) { return x.T.h.started && std::ranges::all_of(x.T.agent, &Report::ready); }
bool failed(const X& x) { return x.c.failure != Failure::none; }
bool both_touch(const X& x) {
  return failed(x) || std::ranges::all_of(x.c.touching, [](int n) { return n > kBounce; });
}
bool held(const X& x) { return failed(x) || x.c.steady >= kSteady; }
bool broken(const X& x) { return x.c.failure == Failure::lost || x.c.failure == Failure::crushed; }
template <int m>
bool path_ends(const X& x) {
  return broken(x) || x.c.age >= duration(x.c.k, m);
}
bool weighed(const X& x) { return broken(x) || x.c.age >= kWeighing; }
bool stands(const X& x) { return path_ends<kLower>(x) || x.c.steady > kGone; }
bool left(const X& x) { return x.c.age >= kLeaving; }

None nothing(const X&) { return {}; }

}  // namespace

// clang-format off
const Motion<Coordinator> kWaitForStart
  {  0, "wait for start", retain, retain, nothing, nothing, wait, may_start, "both arms ready and start given"};
const std::array<Motion<Coordinator>, 7> kBehaviours{{
  // m         name                entry           memory        effector sensors  orders               terminal condition
  {  kApproach, "approach",        begin_here,     come_nearer,  nothing, nothing, approach<kApproach>, both_touch, "both palms touch the object"},
  {  kSqueeze,  "squeeze",         begin_here,     press_on,     nothing, nothing, squeeze,             held, "the inner force has settled"},
  {  kLift,     "lift",            begin_here,     carry<false>, nothing, nothing, hold<kLift>,         path_ends<kLift>, "the object is lifted"},
  {  kWeigh,    "weigh",           begin_weighing, weigh,        nothing, nothing, hold<kWeigh>,        weighed, "the object is weighed"},
  {  kCircle,   "around",          begin,          carry<true>,  nothing, nothing, hold<kCircle>,       path_ends<kCircle>, "once around the circle"},
  {  kLower,    "put down",        begin,          put_down,     nothing, nothing, hold<kLower>,        stands, "the object stands on the pedestal"},
  {  kRelease,  "release",         begin,          leave,        nothing, nothing, release,             left, "the palms have left"},
}};
// clang-format on

}  // namespace mrroc::ball
