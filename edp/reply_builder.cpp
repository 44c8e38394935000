#include "edp/reply_builder.hpp"

#include <algorithm>

#include "base/representation.hpp"

namespace mrroc::edp {
namespace {

/// [rad, m]; 0 while the positions of the motors are not known.
AxisVector measured_joints(const DriverView& driver) noexcept {
  if (!driver.position_known) return AxisVector::Zero(driver.robot.axes());
  return driver.robot.joints_from_motors(driver.motors);
}

RobotModel model_of(const DriverView& driver, const Answer& answer) noexcept {
  RobotModel model = driver.model;
  const int axes = driver.robot.axes();
  model.set_tool = model.set_kinematic_model = model.set_force_tool = true;
  model.set_servo_algorithm = static_cast<std::uint8_t>((1 << axes) - 1);
  for (int k = 0; k < axes; ++k) {
    const ServoChoice choice = driver.servo.selected(k);
    model.servo_algorithm[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(choice.algorithm_no);
    model.servo_parameter_set[static_cast<std::size_t>(k)] =
        static_cast<std::uint8_t>(choice.parameter_set_no);
  }
  model.tool_representation = answer.tool_representation;
  model.tool = numbers_from_pose(answer.tool_representation, driver.generator.tool());
  return model;
}

PoseNumbers pose_of(const DriverView& driver, const Answer& answer, const Pose& T_0E) noexcept {
  const SetPoint& set = driver.generator.set_point();
  const bool wants_set = answer.feedback == Feedback::set_value;
  switch (answer.representation) {
    case Representation::motors:
      return numbers_from_axes(wants_set ? set.axes.motors : driver.motors);
    case Representation::joints:
      return numbers_from_axes(wants_set ? set.axes.joints : measured_joints(driver));
    case Representation::frame:
    case Representation::xyz_euler_zyz:
    case Representation::xyz_angle_axis:
      break;
  }
  return numbers_from_pose(answer.representation, wants_set ? set.T_0E : T_0E);
}

}  // namespace

StepSample MeasuredStep::sample() const noexcept {
  const AngleAxisPose r = angle_axis_from_pose(T_0E);
  return {{r[0], r[1], r[2], r[3], r[4], r[5]}, F_a};
}

void ReplyBuilder::build(const DriverView& driver, const Answer& answer, const Protocol& protocol,
                         const HardwareReading& reading) noexcept {
  due_ = true;
  const CurrentStatistics current = currents_.take();
  if (answer.replay) {
    reply_ = protocol.stored();
    return;
  }
  const bool commanded = answer.verdict != Verdict::none;
  const StepSample measured = samples_[count_ - 1].sample();
  reply_ = {};
  reply_.session = commanded ? answer.session : protocol.owner().value_or(0);
  reply_.number = answer.number;
  reply_.step = reading.step;
  reply_.expected = protocol.expected();
  reply_.verdict = answer.verdict;
  reply_.fault = commanded ? answer.fault : driver.fault;
  reply_.state = driver.state;
  reply_.position_known = driver.position_known;
  reply_.at_rest = driver.at_rest;
  reply_.parts = answer.parts;
  reply_.T_0E = measured.T_0E;
  reply_.F_a = measured.F_a;
  const AxisVector joints = measured_joints(driver);
  std::copy_n(joints.data(), joints.size(), reply_.joints.begin());
  std::copy_n(driver.motors.data(), driver.motors.size(), reply_.motors.begin());
  reply_.current = current;
  if (driver.gripper) {
    reply_.gripper = driver.gripper->distance();
    reply_.blocked = driver.gripper->blocked();
  }
  reply_.robot_model = model_of(driver, answer);
  if (has(answer.parts, Part::io)) {
    reply_.inputs = reading.inputs;
    reply_.analog = reading.analog;
  }
}

void ReplyBuilder::complete(const DriverView& driver, const Answer& answer, Protocol& protocol) noexcept {
  if (answer.replay) return;
  reply_.representation = answer.representation;
  reply_.pose = pose_of(driver, answer, samples_[count_ - 1].T_0E);
  if (answer.store) protocol.store(reply_);
}

}  // namespace mrroc::edp
