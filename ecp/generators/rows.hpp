// Parts of the rows of a Move table besides commands: reports, and f' and f_tau of common behaviours.
#pragma once
#include "base/agent_images.hpp"
#include "base/latency.hpp"
#include "base/motion.hpp"
#include "ecp/generators/commands.hpp"

namespace mrroc::ecp {

using mrroc::None;  // a part of an image that an agent does not have

// --- y_cT -----------------------------------------------------------------------------------------------

/// f_cT: effector and sensor for the coordinator (MS 34, 35). @param m  behaviour of the agent
template <class X>
[[nodiscard]] Report report_of(const X& x, int m) {
  Report r;
  r.m = m;
  r.ready = true;
  if constexpr (requires { r.sensor = x.V.state; }) r.sensor = x.V.state;
  r.driver_state = x.e.state;
  // A driver may fail while it has nothing to execute.
  r.verdict = x.e.state == DriverState::faulted && x.e.fault ? Verdict::failed : x.e.verdict;
  r.fault = x.e.fault;
  r.position_known = x.e.position_known;
  r.T_0E = x.e.T_0E;
  r.F_a = x.e.F_a;
  r.gripper = x.e.gripper;
  r.blocked = x.e.blocked;
  return r;
}

// --- f_tau, and what rows need besides -------------------------------------------------------------------

/// @return macrosteps since the behaviour began
template <class X>
[[nodiscard]] std::int64_t age(const X& x) {
  return x.i - x.i_0;
}

/// f_ce: executes c.path, and stays at its end.
template <class X>
[[nodiscard]] EffectorCommand follow_path(const X& x) {
  return move_arm(x.c.path.command(age(x)));
}
/// f_tau: c.path has been commanded to its end. The reply to its last command comes latency::kCommandToReply later.
template <class X>
[[nodiscard]] bool path_ends(const X& x) {
  return age(x) >= x.c.path.macrosteps();
}

/// f_tau: so many macrosteps have passed.
template <class A, int macrosteps>
[[nodiscard]] bool after(const typename A::X& x) {
  return age(x) >= macrosteps;
}

/// f_ce: a constant command for the task frame.
template <class A, const TaskFrameCommand& frame>
[[nodiscard]] EffectorCommand command(const typename A::X&) {
  return move_arm(frame);
}

// --- whole rows --------------------------------------------------------------------------------------------

/// f_cc of rows that remember nothing new, and their entry.
template <class A>
decltype(A::X::c) retain(const typename A::X& x) {
  return x.c;
}
/// f_cV of rows that ask nothing of the sensors.
template <class A>
decltype(A::Y::V) no_sensor(const typename A::X&) {
  return {};
}
/// f_ce of resting.
template <class A>
EffectorCommand at_rest(const typename A::X&) {
  return rest();
}
/// f_cT of rows that report the effector and nothing else.
template <class A>
Report tell(const typename A::X& x) {
  return report_of(x, 0);
}

/// A row of a behaviour that moves the effector and remembers nothing new.
/// @param until   what f_tau waits for, in words for the operator; may be empty
/// @param policy  what a refused or failed command leads to
template <Images A>
constexpr Motion<A> row(int m, std::string_view name, EffectorCommand (*f_ce)(const typename A::X&),
                        bool (*f_tau)(const typename A::X&), std::string_view until = {},
                        const FaultPolicy& policy = {}) {
  return {m, name, retain<A>, retain<A>, f_ce, no_sensor<A>, tell<A>, f_tau, until, policy};
}

}  // namespace mrroc::ecp
