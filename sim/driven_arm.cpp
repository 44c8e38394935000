#include "sim/driven_arm.hpp"

namespace mrroc::sim {
namespace {

constexpr int kSettling = 50;  // macrosteps

WorldParameters alone(const ArmParameters& arm) {
  WorldParameters world;
  world.arms = {arm};
  return world;
}

std::unique_ptr<irb6::Arm> robot_of(ArmModel model) {
  return irb6::make_arm(model == ArmModel::irb6_track ? "irb6_track" : "irb6_postument");
}

edp::DriverParameters driver_parameters(const irb6::Arm& robot, const AxisVector& start) {
  edp::DriverParameters p;
  p.synchro_joints = start;
  p.T_WE = robot.tool_in_wrist();
  p.force.T_WS = robot.sensor_in_wrist();
  return p;
}

}  // namespace

DrivenArm::DrivenArm(const ArmParameters& arm, std::uint64_t seed)
    : robot_(robot_of(arm.model)), world_(alone(arm), seed) {
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

}  // namespace mrroc::sim
