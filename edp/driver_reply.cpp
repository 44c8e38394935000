// What a Driver tells in its replies.
#include <algorithm>

#include "base/representation.hpp"
#include "edp/driver.hpp"

namespace mrroc::edp {

StepSample MeasuredStep::sample() const noexcept {
  const AngleAxisPose r = angle_axis_from_pose(T_0E);
  return {{r[0], r[1], r[2], r[3], r[4], r[5]}, F_a};
}

void Driver::add_sample() noexcept {
  if (sample_count_ == samples_.size()) {
    std::move(samples_.begin() + 1, samples_.end(), samples_.begin());
    --sample_count_;
  }
  samples_[sample_count_++] = {measured_.T_0E, measured_.F_a};
}

void Driver::answer(const HardwareReading& reading) noexcept {
  reply_due_ = true;
  const CurrentStatistics current = currents_.take();
  if (answer_.replay) {
    reply_ = protocol_.stored();
    return;
  }
  reply_ = {};
  reply_.session = answer_.verdict == Verdict::none ? protocol_.owner().value_or(0) : answer_.session;
  reply_.number = answer_.number;
  reply_.step = reading.step;
  reply_.expected = protocol_.expected();
  reply_.verdict = answer_.verdict;
  reply_.fault = answer_.verdict == Verdict::none ? fault_ : answer_.fault;
  if (reply_.fault.code == fault_.code) fault_told_ = true;
  reply_.state = state_;
  reply_.parts = answer_.parts;
  reply_.T_0E = samples_[sample_count_ - 1].sample().T_0E;
  reply_.F_a = measured_.F_a;
  const AxisVector joints = measured_joints();
  std::copy_n(joints.data(), joints.size(), reply_.joints.begin());
  std::copy_n(measured_.motors.data(), measured_.motors.size(), reply_.motors.begin());
  reply_.current = current;
  if (gripper_) {
    reply_.gripper = gripper_->distance();
    reply_.blocked = gripper_->blocked();
  }
  report_model(reply_);
  if (has(answer_.parts, Part::io)) {
    reply_.inputs = reading.inputs;
    reply_.analog = reading.analog;
  }
}

void Driver::complete_answer() noexcept {
  if (answer_.replay) return;
  report_pose(reply_);
  if (answer_.store) protocol_.store(reply_);
}

AxisVector Driver::measured_joints() const noexcept {
  if (!position_known_) return AxisVector::Zero(robot_->axes());
  return robot_->joints_from_motors(measured_.motors);
}

void Driver::report_pose(EffectorReply& reply) const noexcept {
  const SetPoint& set = generator_.set_point();
  const bool wants_set = answer_.feedback == Feedback::set_value;
  reply.representation = answer_.representation;
  switch (answer_.representation) {
    case Representation::motors:
      reply.pose = numbers_from_axes(wants_set ? set.axes.motors : measured_.motors);
      break;
    case Representation::joints:
      reply.pose = numbers_from_axes(wants_set ? set.axes.joints : measured_joints());
      break;
    case Representation::frame:
    case Representation::xyz_euler_zyz:
    case Representation::xyz_angle_axis:
      reply.pose = numbers_from_pose(answer_.representation, wants_set ? set.T_0E : measured_.T_0E);
      break;
  }
}

void Driver::report_model(EffectorReply& reply) const noexcept {
  reply.robot_model = model_;
  RobotModel& model = reply.robot_model;
  model.set_tool = model.set_kinematic_model = model.set_force_tool = true;
  model.set_servo_algorithm = static_cast<std::uint8_t>((1 << robot_->axes()) - 1);
  for (int k = 0; k < robot_->axes(); ++k) {
    const ServoChoice choice = servo_.selected(k);
    model.servo_algorithm[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(choice.algorithm_no);
    model.servo_parameter_set[static_cast<std::size_t>(k)] =
        static_cast<std::uint8_t>(choice.parameter_set_no);
  }
  model.tool_representation = answer_.tool_representation;
  model.tool = numbers_from_pose(answer_.tool_representation, generator_.tool());
}

}  // namespace mrroc::edp
