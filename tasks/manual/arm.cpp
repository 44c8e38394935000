#include "tasks/manual/arm.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/representation.hpp"
#include "ecp/generators/space.hpp"
#include "ecp/generators/trapezoid.hpp"

namespace mrroc::manual {
namespace {

using X = Arm::X;
using ecp::age;

constexpr std::int64_t kHomingTimeout = 9000;  // macrosteps that homing may take
constexpr std::int64_t kSettling = 50;         // at rest before the force is biased
constexpr std::int64_t kSetTimeout = 50;       // for the answer to SET
constexpr std::int64_t kGripTimeout = 250;     // for the jaws
constexpr double kGripTolerance = 5e-4;        // of their distance [m]

/// The driver stands in the state of a fault and says which: to a command it says only that it waits for a reset.
bool tripped(const X& x) {
  return x.e.state == DriverState::faulted && x.e.fault && x.e.fault.code != FaultCode::reset_required;
}

/// The driver has tripped, or trips again when it is reset.
bool broken(const X& x) {
  if (age(x) < latency::kCommandToReply || mishap_of(x.e) != Mishap::tripped) return false;
  return x.T.manual.kind == Kind::reset ? x.e.verdict != Verdict::none && x.e.verdict != Verdict::executed
                                        : tripped(x);
}

// --- where to, and how ----------------------------------------------------------------------------------

ecp::Coordinates present(const X& x, Representation space) {
  if (space == Representation::motors || space == Representation::joints) {
    const auto& source = space == Representation::motors ? x.e.motors : x.e.joints;
    return Eigen::Map<const Eigen::VectorXd>(source.data(), x.c.axes);
  }
  return axes_from_numbers(numbers_from_pose(space, pose_of(x.e)), 6);
}

ecp::Coordinates goal(const X& x, const ecp::Coordinates& from) {
  const ManualOrder& o = x.T.manual;
  const ecp::Coordinates given = axes_from_numbers(o.value, static_cast<int>(from.size()));
  if (o.reference == Reference::absolute) return ecp::nearest_coordinates(o.space, given, from);
  if (per_axis(o.space)) return from + given;
  const auto T_0E = pose_from_numbers(o.space, numbers_from_axes(from));
  const auto T_EG = pose_from_numbers(o.space, o.value);
  if (!T_0E || !T_EG) throw FaultError(FaultCode::not_finite, "the pose is no pose");
  return ecp::nearest_coordinates(o.space, axes_from_numbers(numbers_from_pose(o.space, *T_0E * *T_EG), 6),
                                  from);
}

/// @throws FaultError out_of_limits, unreachable_pose: the arm cannot be at the goal
ecp::Trajectory plan(const X& x) {
  const ManualOrder& o = x.T.manual;
  // Motions relative to the motors' positions need no synchronisation. The rest does, also to where the arm seems to be.
  const bool by_increments = o.space == Representation::motors && o.reference == Reference::relative;
  const bool lost = x.e.state == DriverState::not_synchronised || x.e.state == DriverState::jogging;
  if (lost && !by_increments) throw FaultError(Fault{.code = FaultCode::not_synchronised});
  const ecp::Coordinates from = present(x, o.space);
  const ecp::Coordinates there = goal(x, from);
  if (x.c.reach)
    if (const auto wrong = x.c.reach->validation_error(o.space, there, x.e, x.c.kinematic_model))
      throw FaultError(*wrong);
  const ecp::Coding coding{.space = o.space,
                           .reference = by_increments ? Reference::relative : Reference::absolute,
                           .mu = per_axis(o.space) ? Interpolation::mim : Interpolation::tcim_pose};
  const ecp::ViaPoint to{there, o.velocity, o.acceleration};
  return {std::make_shared<ecp::Trapezoid>(from, std::vector{to}, ecp::default_limits(o.space, x.c.axes),
                                           x.c.pacing.macrostep_s()),
          coding, x.c.pacing};
}

Memory planned(const X& x) {
  Memory c = x.c;
  try {
    c.path = plan(x);
  } catch (const FaultError& e) {
    c.path = {};
    c.fault = e.fault();
  }
  return c;
}

/// f_entry of idle: the order is over, one way or the other.
Memory over(const X& x) {
  Memory c = x.c;
  const bool same = x.T.manual.number == c.doing, news = c.done != c.doing;
  const bool stops = same && x.T.manual.kind == Kind::stop;
  const bool fails = mishap_of(x.e) == Mishap::tripped && x.e.verdict != Verdict::none;
  if (news && !c.fault && !stops && (fails || tripped(x))) c.fault = x.e.fault;
  if (news && same && !c.fault && x.T.manual.kind == Kind::kinematic_model)
    c.kinematic_model = x.T.manual.model;
  c.done = c.doing;
  return c;
}

/// f_cc of a behaviour that commands something: a mishap is why the order fails.
Memory note(const X& x) {
  Memory c = x.c;
  const Mishap mishap = mishap_of(x.e);
  const bool own = age(x) >= latency::kCommandToReply;
  if (own && !c.fault && (mishap == Mishap::refused || mishap == Mishap::failed)) c.fault = x.e.fault;
  return c;
}

/// f_cc of one that waits for something as well: it may be in vain.
template <std::int64_t timeout, FaultCode code>
Memory timed(const X& x) {
  Memory c = note(x);
  if (c.fault) return c;
  if (age(x) >= timeout) c.fault = Fault{.code = code};
  return c;
}

Memory retain(const X& x) { return x.c; }

// --- y_ce -------------------------------------------------------------------------------------------------

EffectorCommand at_rest(const X&) { return ecp::rest(); }

EffectorCommand synchro(const X& x) {
  return age(x) == 0 ? EffectorCommand{.instruction = Instruction::synchro} : ecp::rest();
}

EffectorCommand with_model(const RobotModel& model) {
  EffectorCommand command{.instruction = Instruction::set};
  command.set = static_cast<std::uint8_t>(Part::robot_model);
  command.robot_model = model;
  return command;
}

EffectorCommand tool_of_task(const X& x) { return age(x) == 0 ? with_model(x.c.model) : ecp::rest(); }

EffectorCommand follow(const X& x) {
  const bool over = x.e.state == DriverState::faulted || age(x) >= x.c.path.macrosteps();
  return over ? ecp::rest() : ecp::move_arm(x.c.path.command(age(x)));
}

EffectorCommand setting(const X& x) {
  const ManualOrder& o = x.T.manual;
  RobotModel model;
  switch (o.kind) {
    case Kind::reset:
      return {.instruction = Instruction::reset};
    case Kind::bias:
      return ecp::bias_force();
    case Kind::force_tool:
      return ecp::change_force_tool(o.value[0], Vector3(o.value[1], o.value[2], o.value[3]));
    case Kind::tool:
      model.set_tool = true;
      model.tool_representation = Representation::xyz_angle_axis;
      std::copy_n(o.value.begin(), 6, model.tool.begin());
      break;
    case Kind::kinematic_model:
      model.set_kinematic_model = true;
      model.kinematic_model = o.model;
      break;
    case Kind::servo_algorithm:
      model.set_servo_algorithm = static_cast<std::uint8_t>((1U << x.c.axes) - 1);
      model.servo_algorithm.fill(o.algorithm);
      model.servo_parameter_set.fill(o.parameter_set);
      break;
    default:
      return ecp::rest();
  }
  return with_model(model);
}

EffectorCommand set_once(const X& x) { return age(x) == 0 ? setting(x) : ecp::rest(); }

EffectorCommand grip(const X& x) {
  if (x.e.state == DriverState::faulted) return ecp::rest();
  EffectorCommand command = ecp::move_arm(TaskFrameCommand{}, x.c.pacing);
  command.arm.gripper = x.T.manual.value[0];
  return command;
}

// --- y_cV, y_cT -------------------------------------------------------------------------------------------

ecp::None nothing(const X&) { return {}; }

/// The fault is that of an order, and no verdict on a command. A driver that has tripped is told of as long as it waits
/// for its reset.
Report told(const X& x) {
  Report r = ecp::report_of(x, 0);
  r.verdict = Verdict::none;
  r.event = static_cast<int>(x.c.done);
  r.fault = x.c.fault;
  if (x.e.state == DriverState::faulted) r.fault = tripped(x) ? x.e.fault : Fault{};
  return r;
}

// --- f_tau ------------------------------------------------------------------------------------------------

bool ordered(const X& x) { return x.T.manual.number != x.c.done || x.T.finished; }

bool homed(const X& x) {
  const bool begun = age(x) > latency::kCommandToReply + 1;
  return x.c.fault || broken(x) || called_off(x) || (begun && x.e.state == DriverState::ready);
}

bool settled(const X& x) { return age(x) >= kSettling || called_off(x); }

bool answered(const X& x) {
  return x.c.fault || broken(x) || called_off(x) ||
         (age(x) >= latency::kCommandToReply && x.e.verdict == Verdict::executed);
}

bool arrived(const X& x) {
  if (x.c.fault || broken(x) || called_off(x)) return true;
  return age(x) > x.c.path.macrosteps() + latency::kCommandToReply && !moves(x.e);
}

bool gripped(const X& x) {
  if (x.c.fault || broken(x) || called_off(x)) return true;
  if (age(x) <= latency::kCommandToReply + 10) return false;
  return std::abs(x.e.gripper - x.T.manual.value[0]) < kGripTolerance || x.e.blocked ||
         age(x) >= kGripTimeout;
}

}  // namespace

bool called_off(const X& x) { return x.T.manual.number != x.c.doing || x.T.finished; }

namespace {

/// A refused order is no fault of the system, and neither is a driver that has tripped: a person resets it.
constexpr FaultPolicy kCarryOn{Response::go_on, Response::go_on, Response::go_on};
/// It ends the order.
constexpr FaultPolicy kOrderFails{Response::next_behaviour, Response::next_behaviour, Response::go_on};

}  // namespace

// clang-format off
const std::array<Motion<Arm>, 7> kManual{{
  // m  name                  entry    memory                                         command        sensors  agents  ends
  {  1, "wait for an order",  over,    retain,                                        at_rest,       nothing, told,   ordered,  "an order has come", kCarryOn},
  {  2, "find the position",  retain,  timed<kHomingTimeout, FaultCode::not_ready>,   synchro,       nothing, told,   homed,    "the positions are known, or it was called off", kOrderFails},
  {  3, "settle",             retain,  retain,                                        at_rest,       nothing, told,   settled,  "the arm rests", kCarryOn},
  {  4, "set the tool",       retain,  timed<kSetTimeout, FaultCode::peer_silent>,    tool_of_task,  nothing, told,   answered, "the driver has answered", kOrderFails},
  {  5, "move",               planned, note,                                          follow,        nothing, told,   arrived,  "the arm is there, or it was called off", kOrderFails},
  {  6, "set",                retain,  timed<kSetTimeout, FaultCode::peer_silent>,    set_once,      nothing, told,   answered, "the driver has answered", kOrderFails},
  {  7, "grip",               retain,  note,                                          grip,          nothing, told,   gripped,  "the jaws are there or hold something", kOrderFails},
}};
// clang-format on

}  // namespace mrroc::manual
