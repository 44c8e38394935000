#include "base/msg/convert.hpp"
#include "base/msg/copy.hpp"
#include "base/msg/finite.hpp"
#include "base/msg/pose_rows.hpp"

#include <algorithm>

namespace mrroc {
namespace {

using RowMajorMatrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

template <std::size_t N>
void put(std::int8_t (&field)[N], const FixedText<N>& text) {
  std::ranges::transform(text.data, field, [](char ch) { return static_cast<std::int8_t>(ch); });
}

template <std::size_t N>
FixedText<N> get(const std::int8_t (&field)[N]) {
  FixedText<N> text;
  std::ranges::transform(field, text.data.begin(), [](std::int8_t ch) { return static_cast<char>(ch); });
  return text;
}

}  // namespace

fault_t to_message(const Fault& f) {
  fault_t m{};
  m.code = static_cast<int>(f.code);
  m.axis = f.axis;
  m.value = f.value;
  m.limit = f.limit;
  put(m.process, f.process);
  put(m.text, f.text);
  return m;
}

Fault from_message(const fault_t& m) {
  Fault f;
  f.code = fault_code(m.code).value_or(FaultCode::internal_error);
  f.axis = static_cast<std::int16_t>(m.axis);
  f.value = m.value;
  f.limit = m.limit;
  f.process = get(m.process);
  f.text = get(m.text);
  return f;
}

arm_command_t to_message(const ArmCommand& c) {
  arm_command_t m{};
  m.mu = static_cast<std::int8_t>(c.mu);
  m.representation = static_cast<std::int8_t>(c.representation);
  m.reference = static_cast<std::int8_t>(c.reference);
  copy(c.pose, m.pose);
  for (const Axis a : kAxes) {
    const AxisCommand& from = c.frame[a];
    m.axis[static_cast<std::size_t>(a)] = {static_cast<std::int8_t>(from.b), from.force, from.velocity,
                                           from.inertia, from.mobility};
  }
  m.n_s = static_cast<std::int16_t>(c.n_s);
  m.n_Q = static_cast<std::int16_t>(c.n_Q);
  m.gripper = c.gripper;
  return m;
}

ArmCommand from_message(const arm_command_t& m) {
  ArmCommand c;
  c.mu = static_cast<Interpolation>(m.mu);
  c.representation = static_cast<Representation>(m.representation);
  c.reference = static_cast<Reference>(m.reference);
  copy(m.pose, c.pose);
  for (const Axis a : kAxes) {
    const axis_command_t& from = m.axis[static_cast<std::size_t>(a)];
    c.frame[a] = {static_cast<Behaviour>(from.b), from.force, from.velocity, from.inertia, from.mobility};
  }
  c.n_s = static_cast<std::uint16_t>(m.n_s);
  c.n_Q = static_cast<std::uint16_t>(m.n_Q);
  c.gripper = m.gripper;
  return c;
}

robot_model_t to_message(const RobotModel& model) {
  robot_model_t m{};
  m.set_tool = model.set_tool;
  m.tool_representation = static_cast<std::int8_t>(model.tool_representation);
  copy(model.tool, m.tool);
  m.set_kinematic_model = model.set_kinematic_model;
  m.kinematic_model = static_cast<std::int16_t>(model.kinematic_model);
  m.set_servo_algorithm = model.set_servo_algorithm;
  copy(model.servo_algorithm, m.servo_algorithm);
  copy(model.servo_parameter_set, m.servo_parameter_set);
  m.set_force_tool = model.set_force_tool;
  m.weight = model.weight;
  copy(model.mass_centre, m.mass_centre);
  return m;
}

RobotModel from_message(const robot_model_t& m) {
  RobotModel model;
  model.set_tool = m.set_tool != 0;
  model.tool_representation = static_cast<Representation>(m.tool_representation);
  copy(m.tool, model.tool);
  model.set_kinematic_model = m.set_kinematic_model != 0;
  model.kinematic_model = static_cast<std::uint16_t>(m.kinematic_model);
  model.set_servo_algorithm = m.set_servo_algorithm;
  copy(m.servo_algorithm, model.servo_algorithm);
  copy(m.servo_parameter_set, model.servo_parameter_set);
  model.set_force_tool = m.set_force_tool != 0;
  model.weight = m.weight;
  copy(m.mass_centre, model.mass_centre);
  return model;
}

effector_command_t to_message(const EffectorCommand& c) {
  effector_command_t m{};
  m.session = c.session;
  m.number = c.number;
  m.instruction = static_cast<std::int8_t>(c.instruction);
  m.set = c.set;
  m.get = c.get;
  m.get_representation = static_cast<std::int8_t>(c.get_representation);
  m.feedback = static_cast<std::int8_t>(c.feedback);
  m.queried = c.queried;
  m.arm = to_message(c.arm);
  m.get_tool_representation = static_cast<std::int8_t>(c.get_tool_representation);
  m.robot_model = to_message(c.robot_model);
  m.outputs = static_cast<std::int16_t>(c.outputs);
  return m;
}

EffectorCommand from_message(const effector_command_t& m) {
  EffectorCommand c;
  c.session = m.session;
  c.number = m.number;
  c.macrostep = m.header.stamp;
  c.instruction = static_cast<Instruction>(m.instruction);
  c.set = m.set;
  c.get = m.get;
  c.get_representation = static_cast<Representation>(m.get_representation);
  c.feedback = static_cast<Feedback>(m.feedback);
  c.queried = m.queried;
  c.arm = from_message(m.arm);
  c.get_tool_representation = static_cast<Representation>(m.get_tool_representation);
  c.robot_model = from_message(m.robot_model);
  c.outputs = static_cast<std::uint16_t>(m.outputs);
  return c;
}

effector_reply_t to_message(const EffectorReply& r) {
  effector_reply_t m{};
  m.session = r.session;
  m.number = r.number;
  m.step = r.step;
  m.expected = r.expected;
  m.verdict = static_cast<std::int8_t>(r.verdict);
  m.fault = to_message(r.fault);
  m.state = static_cast<std::int8_t>(r.state);
  m.parts = r.parts;
  m.representation = static_cast<std::int8_t>(r.representation);
  copy(r.pose, m.pose);
  copy(r.T_0E, m.T_0E);
  copy(r.F_a.v, m.F_a);
  copy(r.joints, m.joints);
  copy(r.motors, m.motors);
  m.gripper = r.gripper;
  m.blocked = r.blocked;
  copy(r.current.mean, m.current_mean);
  copy(r.current.least, m.current_least);
  copy(r.current.greatest, m.current_greatest);
  copy(r.current.rms, m.current_rms);
  m.robot_model = to_message(r.robot_model);
  m.inputs = static_cast<std::int16_t>(r.inputs);
  copy(r.analog, m.analog);
  m.position_known = r.position_known;
  m.at_rest = r.at_rest;
  return m;
}

EffectorReply from_message(const effector_reply_t& m) {
  EffectorReply r;
  r.session = m.session;
  r.number = m.number;
  r.macrostep = m.header.stamp;
  r.step = m.step;
  r.expected = m.expected;
  r.verdict = static_cast<Verdict>(m.verdict);
  r.fault = from_message(m.fault);
  r.state = static_cast<DriverState>(m.state);
  r.parts = m.parts;
  r.representation = static_cast<Representation>(m.representation);
  copy(m.pose, r.pose);
  copy(m.T_0E, r.T_0E);
  copy(m.F_a, r.F_a.v);
  copy(m.joints, r.joints);
  copy(m.motors, r.motors);
  r.gripper = m.gripper;
  r.blocked = m.blocked != 0;
  copy(m.current_mean, r.current.mean);
  copy(m.current_least, r.current.least);
  copy(m.current_greatest, r.current.greatest);
  copy(m.current_rms, r.current.rms);
  r.robot_model = from_message(m.robot_model);
  r.inputs = static_cast<std::uint16_t>(m.inputs);
  copy(m.analog, r.analog);
  r.position_known = m.position_known != 0;
  r.at_rest = m.at_rest != 0;
  return r;
}

step_sample_t to_message(const StepSample& s) {
  step_sample_t m{};
  copy(s.T_0E, m.T_0E);
  copy(s.F_a.v, m.F_a);
  return m;
}

StepSample from_message(const step_sample_t& m) {
  StepSample s;
  copy(m.T_0E, s.T_0E);
  copy(m.F_a, s.F_a.v);
  return s;
}

agent_order_t to_message(const Order& o) {
  agent_order_t m{};
  m.m = o.m;
  m.variant = o.variant;
  copy(o.go_on, m.go_on);
  m.finished = o.finished;
  m.arm = to_message(o.arm);
  return m;
}

Order from_message(const agent_order_t& m) {
  Order o;
  o.m = m.m;
  o.variant = m.variant;
  o.go_on = {m.go_on[0] != 0, m.go_on[1] != 0};
  o.finished = m.finished != 0;
  o.arm = from_message(m.arm);
  return o;
}

agent_report_t to_message(const Report& r) {
  agent_report_t m{};
  m.m = r.m;
  m.event = r.event;
  m.ready = r.ready;
  m.sensor = r.sensor;
  m.driver_state = static_cast<std::int8_t>(r.driver_state);
  m.verdict = static_cast<std::int8_t>(r.verdict);
  m.fault = to_message(r.fault);
  m.position_known = r.position_known;
  copy(r.T_0E, m.T_0E);
  copy(r.F_a.v, m.F_a);
  m.gripper = r.gripper;
  m.blocked = r.blocked;
  return m;
}

Report from_message(const agent_report_t& m) {
  Report r;
  r.m = m.m;
  r.event = m.event;
  r.ready = m.ready != 0;
  r.sensor = m.sensor;
  r.driver_state = static_cast<DriverState>(m.driver_state);
  r.verdict = static_cast<Verdict>(m.verdict);
  r.fault = from_message(m.fault);
  r.position_known = m.position_known != 0;
  copy(m.T_0E, r.T_0E);
  copy(m.F_a, r.F_a.v);
  r.gripper = m.gripper;
  r.blocked = m.blocked != 0;
  return r;
}

sensor_reading_t to_message(const SensorReading& r) {
  sensor_reading_t m{};
  m.state = r.state;
  m.valid = r.valid;
  copy(r.value, m.value);
  return m;
}

SensorReading from_message(const sensor_reading_t& m) {
  SensorReading r;
  r.state = m.state;
  r.valid = m.valid != 0;
  copy(m.value, r.value);
  return r;
}

sensor_setting_t to_message(const SensorSetting& s) {
  sensor_setting_t m{};
  m.mode = s.mode;
  copy(s.value, m.value);
  return m;
}

SensorSetting from_message(const sensor_setting_t& m) {
  SensorSetting s;
  s.mode = m.mode;
  copy(m.value, s.value);
  return s;
}

bool is_proper(const sensor_setting_t& m) noexcept { return finite(m.value); }

camera_reading_t to_message(const CameraReading& r) {
  camera_reading_t m{};
  m.step = r.step;
  m.t = r.t;
  m.seen = r.seen;
  m.ambiguous = r.ambiguous;
  put_rows(m.T_CG, r.T_CG);
  Eigen::Map<RowMajorMatrix6>{m.covariance} = r.covariance;
  m.reprojection_px = r.reprojection_px;
  return m;
}

CameraReading from_message(const camera_reading_t& m) {
  CameraReading r;
  r.frame = m.header.stamp;
  r.step = m.step;
  r.t = m.t;
  r.seen = m.seen != 0;
  r.ambiguous = m.ambiguous != 0;
  r.T_CG = pose_from_rows(m.T_CG);
  r.covariance = Eigen::Map<const RowMajorMatrix6>{m.covariance};
  r.reprojection_px = m.reprojection_px;
  return r;
}

hardware_command_t to_message(const HardwareCommand& c) {
  hardware_command_t m{};
  copy(c.pwm, m.pwm);
  m.enabled = c.enabled;
  m.jaws_enabled = c.jaws_enabled;
  m.macrostep = c.macrostep;
  m.outputs = static_cast<std::int16_t>(c.outputs);
  return m;
}

HardwareCommand from_message(const hardware_command_t& m) {
  HardwareCommand c;
  c.step = m.header.stamp;
  copy(m.pwm, c.pwm);
  c.enabled = m.enabled != 0;
  c.jaws_enabled = m.jaws_enabled != 0;
  c.macrostep = m.macrostep;
  c.outputs = static_cast<std::uint16_t>(m.outputs);
  return c;
}

hardware_state_t to_message(const HardwareReading& r) {
  hardware_state_t m{};
  copy(r.encoder, m.encoder);
  copy(r.current, m.current);
  copy(r.S_F_m.v, m.S_F_m);
  copy(r.switches, m.switches);
  copy(r.index, m.index);
  m.inputs = static_cast<std::int16_t>(r.inputs);
  copy(r.analog, m.analog);
  return m;
}

HardwareReading from_message(const hardware_state_t& m) {
  HardwareReading r;
  r.step = m.header.stamp;
  copy(m.encoder, r.encoder);
  copy(m.current, r.current);
  copy(m.S_F_m, r.S_F_m.v);
  copy(m.switches, r.switches);
  copy(m.index, r.index);
  r.inputs = static_cast<std::uint16_t>(m.inputs);
  copy(m.analog, r.analog);
  return r;
}

}  // namespace mrroc
