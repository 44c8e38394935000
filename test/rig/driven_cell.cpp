#include "test/rig/driven_cell.hpp"

#include "robots/gripper/jaws.hpp"

namespace mrroc::rig {
namespace {

constexpr int kSettling = 50;  // macrosteps

bool bad(const EffectorReply& reply) {
  return (reply.verdict == Verdict::refused || reply.verdict == Verdict::failed) &&
         reply.fault.code != FaultCode::lost_command;
}

}  // namespace

edp::DriverParameters driver_parameters(const irb6::Arm& robot, const sim::ArmParameters& arm,
                                        const AxisVector& start) {
  edp::DriverParameters p;
  p.synchro_joints = start;
  p.T_WE = robot.tool_in_wrist();
  p.force.T_WS = robot.sensor_in_wrist();
  p.force.weight = robot.parameters().tool_weight;
  p.force.mass_centre = Eigen::Map<const Vector3>(robot.parameters().tool_mass_centre.data());
  if (arm.jaws) {
    p.gripper = gripper::two_jaw();
    p.jaws = arm.jaws->start;
  }
  return p;
}

DrivenCell::DrivenCell(const sim::WorldParameters& world, std::uint64_t seed,
                       const std::vector<edp::Limits>& limits, const edp::OscillationParameters& oscillation)
    : world_(world, seed) {
  for (int k = 0; k < world_.arms(); ++k) {
    const sim::ArmParameters& arm = world.arms[index(k)];
    Driven driven;
    driven.robot = irb6::make_arm(arm.type->name);
    edp::DriverParameters p = driver_parameters(*driven.robot, arm, world_.start_joints(k));
    if (index(k) < limits.size()) p.limits = limits[index(k)];
    p.oscillation = oscillation;
    driven.driver = std::make_unique<edp::Driver>(*driven.robot, p);
    arms_.push_back(std::move(driven));
  }
  for (Driven& arm : arms_) arm.next = {.instruction = Instruction::synchro};
  for (int k = 0; k < kSettling; ++k)
    if (wait() != Outcome::terminated)
      for (const Driven& arm : arms_)
        if (bad(arm.reply)) throw FaultError(arm.reply.fault);
}

Outcome DrivenCell::wait() {
  for (Driven& arm : arms_) arm.driver->take(arm.current);
  std::vector<HardwareCommand> commands(arms_.size());
  do {
    for (std::size_t k = 0; k < arms_.size(); ++k) {
      commands[k] = arms_[k].driver->step(world_.reading(static_cast<int>(k)));
      if (arms_[k].driver->reply_due()) arms_[k].reply = arms_[k].driver->reply();
    }
    world_.step(commands);
    if (after_) after_();
  } while (!arms_.front().driver->at_boundary());
  ++i_;
  Outcome outcome = Outcome::terminated;
  for (Driven& arm : arms_) {
    arm.reply.macrostep = i_;
    arm.client.see(arm.reply);
    arm.current = arm.client.next(arm.next, i_);
    arm.next = {};
    if (bad(arm.reply)) outcome = Outcome::faulted;
  }
  return outcome;
}

}  // namespace mrroc::rig
