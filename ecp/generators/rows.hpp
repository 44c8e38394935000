// What the rows of a Move table are made of: effector commands, reports, and f' and f_tau of common
// behaviours. For images X { c; EffectorReply e; ...; i, i_0 } of an embodied agent.
#pragma once
#include "base/effector_command.hpp"
#include "base/motion.hpp"
#include "base/pose.hpp"
#include "base/transmission.hpp"
#include "ecp/generators/trajectory.hpp"

namespace mrroc::ecp {

/// A part of an image that an agent does not have.
struct None {};

/// Images of an agent whose memory is C. An agent of a task is `struct Arm : ArmAgent<Memory> {}`.
template <class C>
struct ArmAgent {
  struct X {
    C c{};
    EffectorReply e;
    SensorReading V;
    Order T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  struct Y {
    C c{};
    EffectorCommand e;
    None V;
    Report T;
  };
};

/// The answer to a command is read so many macrosteps after the macrostep in which the command was made.
inline constexpr std::int64_t kAnswerDelay = 2;

// --- y_ce -----------------------------------------------------------------------------------------------

/// @return SET_GET ARM
[[nodiscard]] constexpr EffectorCommand move_arm(const ArmCommand& arm) {
  EffectorCommand command{.instruction = Instruction::set_get};
  command.set = static_cast<std::uint8_t>(Part::arm);
  command.get = static_cast<std::uint8_t>(Part::arm);
  command.arm = arm;
  return command;
}

/// @return SET_GET ARM, TCIM-VELOCITY, with these rows of the task frame
[[nodiscard]] constexpr EffectorCommand move_arm(const TaskFrameCommand& frame, const Pacing& pacing = {}) {
  ArmCommand arm;
  arm.frame = frame;
  arm.n_s = pacing.n_s;
  arm.n_Q = pacing.n_Q;
  return move_arm(arm);
}

/// @return nothing: the arm comes to rest and holds, which biasing and changing the force tool need
[[nodiscard]] constexpr EffectorCommand rest() { return {}; }

/// @return SET force_bias: the adjusted force is zero from now on; at rest and without contact
[[nodiscard]] constexpr EffectorCommand bias_force() {
  EffectorCommand command{.instruction = Instruction::set};
  command.set = static_cast<std::uint8_t>(Part::force_bias);
  return command;
}

/// @return SET ROBOT_MODEL FORCE_TOOL, which biases anew; at rest and without contact
/// @param w  weight of everything beyond the sensor [N]  @param P  its mass centre W_G P [m]
[[nodiscard]] EffectorCommand change_force_tool(double w, const Vector3& P);

/// @return the command with SET ROBOT_MODEL TOOL added; the wrist stays where it is
/// @param T_WE  task frame in the wrist
[[nodiscard]] EffectorCommand with_tool(EffectorCommand command, const Pose& T_WE);

/// @return the command of a pause: a motion by velocity stands and keeps its forces, any other comes to rest
[[nodiscard]] EffectorCommand standing(EffectorCommand command);

/// f_ce of the transparent behaviour (MS 36): the coordinator's order, as it is. A late one is kept back: the
/// arm comes to rest and holds until an order comes.
template <class X>
[[nodiscard]] EffectorCommand copied_order(const X& x) {
  return x.T.late ? EffectorCommand{} : move_arm(x.T.arm);
}

// --- y_cT -----------------------------------------------------------------------------------------------

/// f_cT: effector and sensor for the coordinator (MS 34, 35). @param m  behaviour of the agent
template <class X>
[[nodiscard]] Report report_of(const X& x, int m) {
  Report r;
  r.m = m;
  r.ready = true;
  if constexpr (requires { r.sensor = x.V.state; }) r.sensor = x.V.state;
  r.driver_state = x.e.state;
  r.verdict = x.e.verdict;
  r.fault = x.e.fault;
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
/// f_tau: c.path has been commanded to its end. The reply to its last command comes kAnswerDelay later.
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
/// f_cV of an agent that does not configure its sensors.
template <class A>
None no_sensor(const typename A::X&) {
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
template <Images A>
constexpr Motion<A> row(int m, std::string_view name, EffectorCommand (*f_ce)(const typename A::X&),
                        bool (*f_tau)(const typename A::X&)) {
  return {m, name, retain<A>, retain<A>, f_ce, no_sensor<A>, tell<A>, f_tau};
}

}  // namespace mrroc::ecp
