#include "edp/guard.hpp"

#include <algorithm>
#include <cmath>

#include "base/representation.hpp"
#include "edp/control_law.hpp"
#include "edp/servo.hpp"

namespace mrroc::edp {
namespace {

/// Rounding of positions and speeds that is no violation.
constexpr double kRounding = 1e-9;

constexpr unsigned kGettable =
    static_cast<unsigned>(Part::arm | Part::robot_model) | static_cast<unsigned>(Part::io);
constexpr unsigned kSettable = kGettable | static_cast<unsigned>(Part::force_bias);

template <class Enum>
bool known(Enum value, Enum last) {
  return static_cast<unsigned>(value) <= static_cast<unsigned>(last);
}

Fault unknown(std::string_view field, double value) {
  return make_fault(FaultCode::unknown_enum, field, -1, value);
}

/// @return whether |value| <= limit; false for NaN
bool within(double value, double limit) { return std::abs(value) <= limit; }
/// @return whether 0 <= value <= limit; false for NaN
bool between_0_and(double limit, double value) { return value >= 0 && value <= limit; }

/// @return whether |v| <= limit; false for NaN
bool no_longer_than(const Vector3& v, double limit) {
  const double longest = limit * (1 + kRounding);
  return v.squaredNorm() <= longest * longest;
}

/// Lowest and highest position to go to: legal ones, and those no farther away than where the axis is.
Range range_from(const Range& legal, double start) {
  return {std::min(legal.lower, start) - kRounding, std::max(legal.upper, start) + kRounding};
}
bool is_legal(const Range& legal, double start, double end) { return range_from(legal, start).contains(end); }
Fault beyond(const Range& legal, double start, double end, int axis, std::string_view text) {
  const bool below = end < range_from(legal, start).lower;
  return make_fault(FaultCode::joint_limit, text, axis, end, below ? legal.lower : legal.upper);
}

ValidationError check_row(const AxisCommand& row, Axis axis, double largest_force, const Limits& limits) {
  const int k = static_cast<int>(axis);
  if (!known(row.b, Behaviour::contact)) return unknown("behaviour", static_cast<double>(row.b));
  for (const double number : {row.force, row.velocity, row.inertia, row.mobility})
    if (!std::isfinite(number)) return make_fault(FaultCode::not_finite, "row of the task frame", k, number);
  const AxisCommand a = behaving(row);
  if (!within(a.force, largest_force))
    return make_fault(FaultCode::out_of_limits, "F_d [N], [N m]", k, a.force, largest_force);
  if (!between_0_and(limits.inertia, a.inertia))
    return make_fault(FaultCode::out_of_limits, "I [kg], [kg m^2], 0 to the limit", k, a.inertia,
                      limits.inertia);
  if (!between_0_and(limits.mobility, a.mobility))
    return make_fault(FaultCode::out_of_limits, "B [s/kg], [s/(kg m^2)], 0 to the limit", k, a.mobility,
                      limits.mobility);
  return {};
}

ValidationError check_rows(const ArmCommand& command, const Limits& limits) {
  Twist free_motion;
  for (const Axis axis : kAxes) {
    const AxisCommand& row = command.frame[axis];
    if (const ValidationError wrong = check_row(row, axis, limits.force[axis], limits)) return wrong;
    const bool pose = command.mu == Interpolation::tcim_pose;  // its velocity is computed, not commanded
    free_motion[axis] = row.b == Behaviour::contact ? row.mobility * row.force : pose ? 0 : row.velocity;
  }
  return check_velocity(free_motion, limits);
}

ValidationError check_pose(const ArmCommand& command, int axes) {
  const Representation r = command.representation;
  if (!known(r, Representation::xyz_angle_axis)) return unknown("representation", static_cast<double>(r));
  if (!known(command.reference, Reference::relative))
    return unknown("reference", static_cast<double>(command.reference));
  if (command.mu == Interpolation::tcim_pose && per_axis(r))
    return unknown("TCIM takes a frame, xyz_euler_zyz or xyz_angle_axis", static_cast<double>(r));
  for (int k = 0; k < numbers_used(r, axes); ++k)
    if (const double number = command.pose[static_cast<std::size_t>(k)]; !std::isfinite(number))
      return make_fault(FaultCode::not_finite, "pose", k, number);
  if (!per_axis(r) && !pose_from_numbers(r, command.pose))
    return make_fault(FaultCode::not_a_rotation, "pose");
  return {};
}

}  // namespace

Fault make_fault(FaultCode code, std::string_view text, int axis, double value, double limit) noexcept {
  Fault fault;
  fault.code = code;
  fault.axis = static_cast<std::int16_t>(axis);
  fault.value = value;
  fault.limit = limit;
  fault.text = text;
  return fault;
}

ValidationError check_form(const EffectorCommand& command) noexcept {
  if (!known(command.instruction, Instruction::release))
    return unknown("instruction", static_cast<double>(command.instruction));
  const bool sets = command.instruction == Instruction::set || command.instruction == Instruction::set_get;
  const bool gets = command.instruction == Instruction::get || command.instruction == Instruction::set_get;
  if (sets) {
    if ((command.set & ~kSettable) != 0)
      return unknown("SET: ARM, ROBOT_MODEL, OUTPUTS, force_bias", command.set);
  }
  if (gets) {
    if ((command.get & ~kGettable) != 0) return unknown("GET: ARM, ROBOT_MODEL, INPUTS", command.get);
    const Representation tool = command.get_tool_representation;
    if (has(command.get, Part::robot_model) &&
        (!known(tool, Representation::xyz_angle_axis) || per_axis(tool)))
      return unknown("representation of GET TOOL", static_cast<double>(tool));
    if (!known(command.get_representation, Representation::xyz_angle_axis))
      return unknown("representation of GET", static_cast<double>(command.get_representation));
    if (!known(command.feedback, Feedback::set_value))
      return unknown("feedback", static_cast<double>(command.feedback));
  }
  return {};
}

ValidationError check_arm(const ArmCommand& command, int axes, const Limits& limits) noexcept {
  if (!known(command.mu, Interpolation::tcim_velocity))
    return unknown("interpolation", static_cast<double>(command.mu));
  if (command.n_s < 1 || command.n_s > kMaxSteps)
    return make_fault(FaultCode::out_of_limits, "n_s, from 1", -1, command.n_s, kMaxSteps);
  if (command.n_Q < 1 || command.n_Q > command.n_s + 1)
    return make_fault(FaultCode::out_of_limits, "n_Q, from 1 to n_s + 1", -1, command.n_Q, command.n_s + 1);
  if (!std::isfinite(command.gripper))
    return make_fault(FaultCode::not_finite, "distance of the jaws [m]", -1, command.gripper);
  if (command.mu != Interpolation::tcim_velocity)
    if (const ValidationError wrong = check_pose(command, axes)) return wrong;
  if (command.mu != Interpolation::mim) return check_rows(command, limits);
  return {};
}

ValidationError check_model(const RobotModel& model, const Robot& robot, const Limits& limits) noexcept {
  if (model.set_kinematic_model && robot.with_model(model.kinematic_model) == nullptr)
    return make_fault(FaultCode::unknown_model, "KINEMATIC_MODEL", -1, model.kinematic_model,
                      robot.models() - 1);
  if (const int motors = model.set_servo_algorithm; motors >> robot.axes() != 0)
    return make_fault(FaultCode::out_of_limits, "SERVO_ALGORITHM: motors of the mask", -1, motors,
                      (1 << robot.axes()) - 1);
  for (int k = 0; k < robot.axes(); ++k) {
    const auto motor = static_cast<std::size_t>(k);
    if ((model.set_servo_algorithm >> k & 1) != 0 &&
        !Servo::known(model.servo_algorithm[motor], model.servo_parameter_set[motor]))
      return make_fault(FaultCode::unknown_model, "SERVO_ALGORITHM", k, model.servo_algorithm[motor],
                        kServoAlgorithms - 1);
  }
  if (model.set_tool) {
    const Representation r = model.tool_representation;
    if (!known(r, Representation::xyz_angle_axis) || per_axis(r))
      return unknown("representation of the tool", static_cast<double>(r));
    const std::optional<Pose> T_WE = pose_from_numbers(r, model.tool);
    if (!T_WE) return make_fault(FaultCode::not_a_rotation, "tool");
    if (!within(T_WE->p.norm(), limits.lever))
      return make_fault(FaultCode::out_of_limits, "length of the tool [m]", -1, T_WE->p.norm(), limits.lever);
  }
  if (model.set_force_tool) {
    if (!between_0_and(limits.weight, model.weight))
      return make_fault(FaultCode::out_of_limits, "weight of the tool [N], 0 to the limit", -1, model.weight,
                        limits.weight);
    const double lever = Vector3(model.mass_centre[0], model.mass_centre[1], model.mass_centre[2]).norm();
    if (!within(lever, limits.lever))
      return make_fault(FaultCode::out_of_limits, "distance of the mass centre [m]", -1, lever, limits.lever);
  }
  return {};
}

ValidationError check_velocity(const Twist& v, const Limits& limits) noexcept {
  const auto check = [](const Vector3& part, double limit, int first,
                        std::string_view text) -> ValidationError {
    if (no_longer_than(part, limit)) return {};
    int worst{};
    part.cwiseAbs().maxCoeff(&worst);
    return make_fault(FaultCode::too_fast, text, first + worst, part.norm(), limit);
  };
  if (const ValidationError wrong = check(v.linear(), limits.linear_velocity, 0, "speed [m/s]")) return wrong;
  return check(v.angular(), limits.angular_velocity, 3, "speed [rad/s]");
}

ValidationError check_range(const Robot& robot, const AxisPositions& from, const AxisPositions& to,
                            double stop_way) noexcept {
  const int axes = robot.axes();
  for (int k = 0; k < axes; ++k) {
    const AxisProperties& axis = robot.axis(k);
    const double motor = to.motors[k] + (to.motors[k] - from.motors[k]) * stop_way;
    if (!is_legal(axis.motor, from.motors[k], motor))
      return beyond(axis.motor, from.motors[k], motor, k, "motor [rad]");
    const double joint = to.joints[k] + (to.joints[k] - from.joints[k]) * stop_way;
    if (!is_legal(axis.joint, from.joints[k], joint))
      return beyond(axis.joint, from.joints[k], joint, k, "joint [rad], [m]");
  }
  return {};
}

AxisRanges::AxisRanges(const Robot& robot, double dt, double motor_acceleration) noexcept
    : axes_(robot.axes()), most_change_(motor_acceleration * dt * dt) {
  for (int k = 0; k < axes_; ++k) {
    const AxisProperties& axis = robot.axis(k);
    const auto i = static_cast<std::size_t>(k);
    motor_lower_[i] = axis.motor.lower;
    motor_upper_[i] = axis.motor.upper;
    joint_lower_[i] = axis.joint.lower;
    joint_upper_[i] = axis.joint.upper;
    most_[i] = axis.max_motor_speed * dt;
  }
}

bool AxisRanges::contain(const AxisPositions& axes) const noexcept {
  const double* motor = axes.motors.data();
  const double* joint = axes.joints.data();
  bool inside = true;
  for (std::size_t k = 0; k < static_cast<std::size_t>(axes_); ++k) {
    inside &= motor[k] >= motor_lower_[k] && motor[k] <= motor_upper_[k];
    inside &= joint[k] >= joint_lower_[k] && joint[k] <= joint_upper_[k];
  }
  return inside;
}

bool AxisRanges::allow(const AxisVector& before, const AxisVector& after) const noexcept {
  bool allowed = true;
  for (std::size_t k = 0; k < static_cast<std::size_t>(axes_); ++k) {
    allowed &= std::abs(after.data()[k]) <= most_[k];
    allowed &= std::abs(after.data()[k] - before.data()[k]) <= most_change_;
  }
  return allowed;
}

ValidationError check_motor_speed(const Robot& robot, const AxisVector& from, const AxisVector& to,
                                  double time) noexcept {
  const int axes = robot.axes();
  for (int k = 0; k < axes; ++k) {
    const double speed = std::abs(to[k] - from[k]) / time;
    const double limit = robot.axis(k).max_motor_speed;
    if (!(speed <= limit * (1 + kRounding)))
      return make_fault(FaultCode::too_fast, "motor [rad/s]", k, speed, limit);
  }
  return {};
}

ValidationError check_motor_acceleration(const AxisVector& before, const AxisVector& after, double dt,
                                         const Limits& limits) noexcept {
  for (int k = 0; k < after.size(); ++k) {
    const double a = std::abs(after[k] - before[k]) / dt;
    if (!(a <= limits.motor_acceleration * (1 + kRounding)))
      return make_fault(FaultCode::excessive_acceleration, "motor [rad/s^2]", k, a,
                        limits.motor_acceleration);
  }
  return {};
}

ValidationError check_acceleration(const Twist& before, const Twist& after, double dt,
                                   const Limits& limits) noexcept {
  const auto check = [dt](const Vector3& change, double limit, int first,
                          std::string_view text) -> ValidationError {
    if (no_longer_than(change, limit * dt)) return {};
    int worst{};
    change.cwiseAbs().maxCoeff(&worst);
    return make_fault(FaultCode::excessive_acceleration, text, first + worst, change.norm() / dt, limit);
  };
  const Twist change = after - before;
  if (const ValidationError wrong =
          check(change.linear(), limits.linear_acceleration, 0, "acceleration [m/s^2]"))
    return wrong;
  return check(change.angular(), limits.angular_acceleration, 3, "acceleration [rad/s^2]");
}

ValidationError check_workspace(const Pose& from, const Pose& to, const Limits& limits) noexcept {
  if (!limits.workspace) return {};
  for (int k = 0; k < 3; ++k) {
    const double lower = limits.workspace->lower[k];
    const double upper = limits.workspace->upper[k];
    const double p = to.p[k];
    if (p >= std::min(lower, from.p[k]) - kRounding && p <= std::max(upper, from.p[k]) + kRounding) continue;
    return make_fault(FaultCode::outside_workspace, "x y z of E in the base [m]", k, p,
                      p < lower ? lower : upper);
  }
  return {};
}

ValidationError check_contact_force(const Wrench& F_a, const Twist& v, const Limits& limits) noexcept {
  for (const Axis a : kAxes)
    if (std::abs(F_a[a]) > limits.contact_force[a] && F_a[a] * v[a] > 0)
      return make_fault(FaultCode::force_limit, "contact force [N], [N m]", static_cast<int>(a), F_a[a],
                        limits.contact_force[a]);
  return {};
}

}  // namespace mrroc::edp
