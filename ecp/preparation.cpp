#include "ecp/preparation.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "base/latency.hpp"

namespace mrroc::ecp {
namespace {

Report not_ready_yet(const EffectorReply& reply) {
  Report r;
  r.driver_state = reply.state;
  r.verdict = reply.verdict;
  r.fault = reply.fault;
  r.T_0E = reply.T_0E;
  r.F_a = reply.F_a;
  return r;
}

Report not_ready_yet(const PlatformReply& reply) {
  Report r;
  r.driver_state = reply.state;
  r.verdict = reply.verdict;
  r.fault = reply.fault;
  r.position_known = reply.position_known;
  const PlanarPose& p = reply.estimate.p;
  if (reply.position_known) r.T_0E = {p.x, p.y, 0, 0, 0, p.phi};
  return r;
}

/// Brings one driver into the state ready.
template <Effector E>
class Preparing {
 public:
  using Command = typename E::Command;

  /// @param renew  fills in what is not numbered in a command; may be empty
  explicit Preparing(EffectorLinks<E>& links, std::function<void(Command&)> renew = {})
      : links_(links), renew_(std::move(renew)) {}

  /// Lets macrosteps pass without a command.
  Outcome rest(int macrosteps) {
    for (int k = 0; k < macrosteps; ++k) {
      send({});
      if (const Outcome o = links_.wait(); o != Outcome::terminated) return o;
    }
    return Outcome::terminated;
  }

  /// Sends one command and waits for what becomes of it.
  Outcome execute(const Command& command) {
    send(command);
    const std::int64_t answered = links_.i() + latency::kCommandToReply;
    while (true) {
      if (const Outcome o = links_.wait(); o != Outcome::terminated) return o;
      if (links_.i() >= answered && links_.reply().verdict == Verdict::executed) return Outcome::terminated;
      if (links_.i() >= answered && links_.reply().verdict != Verdict::none &&
          links_.reply().fault.code != FaultCode::lost_command)
        return Outcome::faulted;
      // With the wall clock its reply may have been skipped.
      if (links_.i() > answered && links_.client().settled()) return Outcome::terminated;
      send({});
    }
  }

  /// SYNCHRO. Lets macrosteps pass until homing has ended, one way or the other.
  Outcome synchronise() {
    if (const Outcome o = execute({.instruction = Instruction::synchro}); o != Outcome::terminated) return o;
    while (links_.reply().state == DriverState::homing)
      if (const Outcome o = rest(1); o != Outcome::terminated) return o;
    const DriverState state = links_.reply().state;
    const bool lost = state == DriverState::faulted || state == DriverState::not_synchronised ||
                      state == DriverState::jogging;
    return lost ? Outcome::faulted : Outcome::terminated;
  }

 private:
  void send(Command command) {
    if (renew_) renew_(command);
    links_.send(command, not_ready_yet(links_.reply()));
  }

  EffectorLinks<E>& links_;
  std::function<void(Command&)> renew_;
};

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
  Preparing<ArmEffector> arm(links);
  if (const Outcome o = arm.synchronise(); o != Outcome::terminated) return o;
  if (const Outcome o = arm.rest(prepare.settling_macrosteps); o != Outcome::terminated) return o;
  EffectorCommand set{.instruction = Instruction::set};
  set.set = static_cast<std::uint8_t>(Part::robot_model);
  set.robot_model = prepare.model;
  return arm.execute(set);
}

Outcome prepare_effector(PlatformLinks& links, const PlatformPreparation& prepare) {
  return Preparing<PlatformEffector>(links, prepare.renew).synchronise();
}

}  // namespace mrroc::ecp
