#include <fmt/core.h>

#include <limits>

#include "ecp/generators/commands.hpp"
#include "edp/driver.hpp"
#include "robots/catalogue.hpp"
#include "tasks/move/cell/arm_body.hpp"

namespace mrroc::any_motion {
namespace {

/// Ideal drives under a real driver.
class Rehearsal {
 public:
  Rehearsal(const edp::Robot& robot, const edp::DriverParameters& parameters)
      : robot_(robot),
        driver_(robot, parameters),
        motors_(robot.motors_from_joints(parameters.synchro_joints)) {
    give({.instruction = Instruction::synchro});
  }

  /// One macrostep. @return why the command was refused or not executed; none: it was executed
  Fault give(EffectorCommand command) {
    command.session = 1;
    command.number = ++number_;
    driver_.take(command);
    return pass();
  }
  /// A macrostep without a command.
  Fault pass() {
    Fault fault;
    do {
      for (int k = 0; k < robot_.axes(); ++k)
        reading_.encoder[static_cast<std::size_t>(k)] =
            static_cast<std::int32_t>(std::lround(motors_[k] * robot_.axis(k).increments_per_rad));
      static_cast<void>(driver_.step(reading_));
      ++reading_.step;
      if (driver_.synchronised()) motors_ = driver_.set_point().axes.motors;
      const EffectorReply& reply = driver_.reply();
      if (driver_.reply_due() && reply.fault) fault = reply.fault;
    } while (!driver_.at_boundary());
    return fault;
  }

 private:
  const edp::Robot& robot_;
  edp::Driver driver_;
  AxisVector motors_;
  HardwareReading reading_{};
  std::int64_t number_{};
};

edp::DriverParameters without_surroundings(edp::DriverParameters p, const AxisVector& start) {
  p.synchronisation = edp::Synchronisation::known_pose;
  p.synchro_joints = start;
  p.start_guard_steps = 0;
  p.gripper.reset();
  p.force.weight = 0;  // nothing hangs on the sensor
  p.force.stuck_after = 0;
  p.supervision.torque_steps = std::numeric_limits<int>::max();  // these drives need none
  return p;
}

}  // namespace

void rehearse(const Config& config, const ArmPlan& plan) {
  if (!plan.moves) return;
  const robots::RobotType& type = robots::read_type(config, plan.arm, robots::catalogue(), "irb6_postument");
  // The joints at which SYNCHRO finds the arm do not matter here, but they must be known.
  const bool known = config.has("robots." + plan.arm + ".synchro_joints");
  const robots::DriverSetup setup = robots::read_driver(
      config, plan.arm, type,
      known ? std::vector<double>{} : std::vector<double>(plan.start.begin(), plan.start.end()));
  for (int k = 0; k < setup.robot->axes(); ++k) {
    const edp::Range range = setup.robot->axis(k).joint;
    if (!range.contains(plan.start[k]))
      throw FaultError(FaultCode::joint_limit,
                       fmt::format("{}.start: joint {} is {:.4g}, out of its range {:.4g} to {:.4g}",
                                   plan.arm, k + 1, plan.start[k], range.lower, range.upper));
  }
  Rehearsal rehearsal(*setup.robot, without_surroundings(setup.driver, plan.start));
  constexpr int kRest = 20;  // macrosteps
  for (const PlannedMotion& m : plan.motions) {
    const auto demand = [&](const Fault& fault, std::int64_t k) {
      if (fault)
        throw FaultError(fault.code,
                         fmt::format("{}, {:.2f} s after its beginning: {}", m.spec.name,
                                     static_cast<double>(k) * kPacing.macrostep_s(), what_happened(fault)));
    };
    for (std::int64_t k = 0; k < m.path.macrosteps(); ++k) {
      EffectorCommand command = ecp::move_arm(m.command(k));
      command.arm.frame = {};  // no contact, and no force
      demand(rehearsal.give(command), k);
    }
    for (int k = 0; k < kRest; ++k) demand(rehearsal.pass(), m.path.macrosteps());
  }
}

void rehearse(const Config& config, const Plan& plan) {
  for (const ArmPlan& arm : plan.arms) rehearse(config, arm);
}

}  // namespace mrroc::any_motion
