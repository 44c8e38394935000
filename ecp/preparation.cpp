#include "ecp/preparation.hpp"

#include <algorithm>

#include "base/latency.hpp"

namespace mrroc::ecp {
namespace {

Report not_ready_yet(const ArmLinks& links) {
  Report r;
  r.driver_state = links.reply().state;
  r.verdict = links.reply().verdict;
  r.fault = links.reply().fault;
  r.T_0E = links.reply().T_0E;
  r.F_a = links.reply().F_a;
  return r;
}

/// Lets macrosteps pass without a command.
Outcome rest(ArmLinks& links, int macrosteps) {
  for (int k = 0; k < macrosteps; ++k) {
    links.send({}, not_ready_yet(links));
    if (const Outcome o = links.wait(); o != Outcome::terminated) return o;
  }
  return Outcome::terminated;
}

/// Sends one command and waits for what becomes of it.
Outcome execute(ArmLinks& links, const EffectorCommand& command) {
  links.send(command, not_ready_yet(links));
  const std::int64_t answered = links.i() + latency::kCommandToReply;
  while (true) {
    if (const Outcome o = links.wait(); o != Outcome::terminated) return o;
    if (links.i() >= answered && links.reply().verdict == Verdict::executed) return Outcome::terminated;
    if (links.i() >= answered && links.reply().verdict != Verdict::none &&
        links.reply().fault.code != FaultCode::lost_command)
      return Outcome::faulted;
    // With the wall clock its reply may have been skipped.
    if (links.i() > answered && links.client().settled()) return Outcome::terminated;
    links.send({}, not_ready_yet(links));
  }
}

/// Lets macrosteps pass until homing has ended, one way or the other.
Outcome await_positions(ArmLinks& links) {
  while (links.reply().state == DriverState::homing)
    if (const Outcome o = rest(links, 1); o != Outcome::terminated) return o;
  const DriverState state = links.reply().state;
  const bool lost = state == DriverState::faulted || state == DriverState::not_synchronised ||
                    state == DriverState::jogging;
  return lost ? Outcome::faulted : Outcome::terminated;
}

}  // namespace

RobotModel read_tool_model(const Config& config, const std::string& arm) {
  const Config tool = config.section("robots." + arm + ".tool");
  RobotModel m;
  m.set_tool = true;
  m.tool_representation = Representation::xyz_angle_axis;
  std::ranges::copy(tool.numbers<6>("pose", std::nullopt, {-10, 10}, "m, rad"), m.tool.begin());
  m.set_force_tool = true;
  m.weight = tool.number("weight", std::nullopt, {0, 50}, "N");
  m.mass_centre = tool.numbers<3>("mass_centre", std::nullopt, {-1, 1}, "m");
  return m;
}

Outcome prepare_effector(ArmLinks& links, const Preparation& prepare) {
  if (prepare.by_program) return Outcome::terminated;
  if (const Outcome o = execute(links, {.instruction = Instruction::synchro}); o != Outcome::terminated)
    return o;
  if (const Outcome o = await_positions(links); o != Outcome::terminated) return o;
  if (const Outcome o = rest(links, prepare.settling_macrosteps); o != Outcome::terminated) return o;
  EffectorCommand set{.instruction = Instruction::set};
  set.set = static_cast<std::uint8_t>(Part::robot_model);
  set.robot_model = prepare.model;
  return execute(links, set);
}

Fault fault_of(const ArmLinks& links) {
  if (links.client().fault()) return *links.client().fault();
  return links.reply().fault;
}

}  // namespace mrroc::ecp
