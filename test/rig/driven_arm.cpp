#include "test/rig/driven_arm.hpp"

namespace mrroc::rig {
namespace {

constexpr int kSettling = 50;  // macrosteps

sim::WorldParameters alone(const sim::ArmParameters& arm) {
  sim::WorldParameters world;
  world.arms = {arm};
  return world;
}

edp::DriverParameters driver_parameters(const irb6::Arm& robot, const AxisVector& start) {
  edp::DriverParameters p;
  p.synchro_joints = start;
  p.T_WE = robot.tool_in_wrist();
  p.force.T_WS = robot.sensor_in_wrist();
  return p;
}

}  // namespace

DrivenArm::DrivenArm(const sim::ArmParameters& arm, std::uint64_t seed)
    : robot_(irb6::make_arm(arm.type->name)), world_(alone(arm), seed) {
  driver_ = std::make_unique<edp::Driver>(*robot_, driver_parameters(*robot_, world_.start_joints(0)));
  send({.instruction = Instruction::synchro});
  for (int k = 0; k < kSettling; ++k) {
    if (wait() != Outcome::terminated) throw FaultError(fault());
    send({});
  }
}

Outcome DrivenArm::wait() {
  driver_->take(current_);
  do {
    const HardwareCommand command = driver_->step(world_.reading(0));
    if (driver_->reply_due()) reply_ = driver_->reply();
    world_.step({&command, 1});
  } while (!driver_->at_boundary());
  ++i_;
  reply_.macrostep = i_;
  client_.see(reply_);
  current_ = client_.next(next_, i_);
  next_ = {};
  const bool refused = reply_.verdict == Verdict::refused || reply_.verdict == Verdict::failed;
  return refused && reply_.fault.code != FaultCode::lost_command ? Outcome::faulted : Outcome::terminated;
}

}  // namespace mrroc::rig
