// Values survive their messages bit for bit, over the bytes of the wire.
#include "base/msg/convert.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/link/decode.hpp"
#include "test/base/msg/brought_back.hpp"
#include "test/base/msg/wire.hpp"

namespace mrroc {
namespace {

using test::bytes_of;
using test::expect_all_back;
using test::expect_round_trip;
using test::sent;
using test::with_random_bytes;

std::mt19937_64 random_bits(1);

double number() {
  static const std::array special{0.0, -0.0, 1e308, -1e-308, std::nan(""), HUGE_VAL, -HUGE_VAL};
  if (random_bits() % 8 == 0) return special[random_bits() % special.size()];
  return static_cast<double>(static_cast<std::int64_t>(random_bits())) * 1e-9;
}
template <class C>
void fill(C& values) {
  for (auto& v : values) v = number();
}
bool flag() { return random_bits() % 2; }
template <class T>
T bits() {
  return static_cast<T>(random_bits());
}
template <std::size_t N>
FixedText<N> text() {
  FixedText<N> t;
  const std::size_t n = random_bits() % (N + 1);
  for (std::size_t k = 0; k < n; ++k) t.data[k] = static_cast<char>('!' + random_bits() % 90);
  return t;
}

Fault random_fault() {
  Fault f;
  f.code = static_cast<FaultCode>(random_bits() % (static_cast<unsigned>(FaultCode::figures_missed) + 1));
  f.axis = bits<std::int16_t>();
  f.value = number();
  f.limit = number();
  f.process = text<32>();
  f.text = text<160>();
  return f;
}

ArmCommand random_arm() {
  ArmCommand c;
  c.mu = bits<Interpolation>();
  c.representation = bits<Representation>();
  c.reference = bits<Reference>();
  fill(c.pose);
  for (const Axis a : kAxes) c.frame[a] = {bits<Behaviour>(), number(), number(), number(), number()};
  c.n_s = bits<std::uint16_t>();
  c.n_Q = bits<std::uint16_t>();
  c.gripper = number();
  return c;
}

bool same(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

RobotModel random_model() {
  RobotModel m;
  m.set_tool = flag();
  m.tool_representation = bits<Representation>();
  fill(m.tool);
  m.set_kinematic_model = flag();
  m.kinematic_model = bits<std::uint16_t>();
  m.set_servo_algorithm = bits<std::uint8_t>();
  for (auto& a : m.servo_algorithm) a = bits<std::uint8_t>();
  for (auto& p : m.servo_parameter_set) p = bits<std::uint8_t>();
  m.set_force_tool = flag();
  m.weight = number();
  fill(m.mass_centre);
  return m;
}

constexpr int kCases = 300;

TEST(Convert, CommandsSurviveTheWire) {
  for (int k = 0; k < kCases; ++k) {
    EffectorCommand c;
    c.session = bits<std::int64_t>();
    c.number = bits<std::int64_t>();
    c.instruction = bits<Instruction>();
    c.set = bits<std::uint8_t>();
    c.get = bits<std::uint8_t>();
    c.get_representation = bits<Representation>();
    c.feedback = bits<Feedback>();
    c.queried = bits<std::int64_t>();
    c.arm = random_arm();
    c.get_tool_representation = bits<Representation>();
    c.robot_model = random_model();
    c.outputs = bits<std::uint16_t>();

    auto m = to_message(c);
    m.header.stamp = k;
    const EffectorCommand d = from_message(sent(m));
    EXPECT_EQ(d.macrostep, k);
    EXPECT_EQ(d.session, c.session);
    EXPECT_EQ(d.number, c.number);
    EXPECT_EQ(d.instruction, c.instruction);
    EXPECT_EQ(d.set, c.set);
    EXPECT_EQ(d.get, c.get);
    EXPECT_EQ(d.get_representation, c.get_representation);
    EXPECT_EQ(d.feedback, c.feedback);
    EXPECT_EQ(d.queried, c.queried);
    EXPECT_EQ(d.arm.mu, c.arm.mu);
    EXPECT_EQ(d.arm.representation, c.arm.representation);
    EXPECT_EQ(d.arm.reference, c.arm.reference);
    EXPECT_EQ(d.arm.n_s, c.arm.n_s);
    EXPECT_EQ(d.arm.n_Q, c.arm.n_Q);
    EXPECT_TRUE(same(d.arm.gripper, c.arm.gripper));
    for (std::size_t j = 0; j < c.arm.pose.size(); ++j) EXPECT_TRUE(same(d.arm.pose[j], c.arm.pose[j]));
    for (const Axis a : kAxes) {
      EXPECT_EQ(d.arm.frame[a].b, c.arm.frame[a].b);
      EXPECT_TRUE(same(d.arm.frame[a].force, c.arm.frame[a].force));
      EXPECT_TRUE(same(d.arm.frame[a].velocity, c.arm.frame[a].velocity));
      EXPECT_TRUE(same(d.arm.frame[a].inertia, c.arm.frame[a].inertia));
      EXPECT_TRUE(same(d.arm.frame[a].mobility, c.arm.frame[a].mobility));
    }
    EXPECT_EQ(d.robot_model.set_tool, c.robot_model.set_tool);
    EXPECT_EQ(d.robot_model.tool_representation, c.robot_model.tool_representation);
    for (std::size_t j = 0; j < c.robot_model.tool.size(); ++j)
      EXPECT_TRUE(same(d.robot_model.tool[j], c.robot_model.tool[j]));
    EXPECT_EQ(d.get_tool_representation, c.get_tool_representation);
    EXPECT_EQ(d.robot_model.set_kinematic_model, c.robot_model.set_kinematic_model);
    EXPECT_EQ(d.robot_model.kinematic_model, c.robot_model.kinematic_model);
    EXPECT_EQ(d.robot_model.set_servo_algorithm, c.robot_model.set_servo_algorithm);
    EXPECT_EQ(d.robot_model.servo_algorithm, c.robot_model.servo_algorithm);
    EXPECT_EQ(d.robot_model.servo_parameter_set, c.robot_model.servo_parameter_set);
    EXPECT_EQ(d.robot_model.set_force_tool, c.robot_model.set_force_tool);
    EXPECT_TRUE(same(d.robot_model.weight, c.robot_model.weight));
    for (std::size_t j = 0; j < 3; ++j)
      EXPECT_TRUE(same(d.robot_model.mass_centre[j], c.robot_model.mass_centre[j]));
    EXPECT_EQ(d.outputs, c.outputs);
  }
}

TEST(Convert, RepliesSurviveTheWire) {
  for (int k = 0; k < kCases; ++k) {
    EffectorReply r;
    r.session = bits<std::int64_t>();
    r.number = bits<std::int64_t>();
    r.step = bits<std::int64_t>();
    r.expected = bits<std::int64_t>();
    r.verdict = bits<Verdict>();
    r.fault = random_fault();
    r.state = bits<DriverState>();
    r.representation = bits<Representation>();
    fill(r.pose);
    fill(r.T_0E);
    fill(r.F_a.v);
    fill(r.joints);
    fill(r.motors);
    r.gripper = number();
    r.blocked = flag();
    r.parts = bits<std::uint8_t>();
    for (auto* numbers : {&r.current.mean, &r.current.least, &r.current.greatest, &r.current.rms, &r.analog})
      fill(*numbers);
    r.robot_model = random_model();
    r.inputs = bits<std::uint16_t>();
    r.position_known = flag();
    r.at_rest = flag();
    auto m = to_message(r);
    m.header.stamp = k;
    const EffectorReply s = from_message(sent(m));
    EXPECT_EQ(s.macrostep, k);
    EXPECT_EQ(s.number, r.number);
    EXPECT_EQ(s.expected, r.expected);
    EXPECT_EQ(s.step, r.step);
    EXPECT_EQ(s.verdict, r.verdict);
    EXPECT_EQ(s.state, r.state);
    EXPECT_EQ(s.blocked, r.blocked);
    EXPECT_EQ(s.inputs, r.inputs);
    EXPECT_EQ(s.parts, r.parts);
    EXPECT_EQ(s.position_known, r.position_known);
    EXPECT_EQ(s.at_rest, r.at_rest);
    EXPECT_EQ(s.robot_model.kinematic_model, r.robot_model.kinematic_model);
    EXPECT_TRUE(same(s.current.rms[7], r.current.rms[7]));
    EXPECT_TRUE(same(s.analog[7], r.analog[7]));
    EXPECT_EQ(s.fault.code, r.fault.code);
    EXPECT_EQ(s.fault.text, r.fault.text);
    EXPECT_EQ(s.fault.process, r.fault.process);
    for (std::size_t j = 0; j < 8; ++j) {
      EXPECT_TRUE(same(s.joints[j], r.joints[j]));
      EXPECT_TRUE(same(s.motors[j], r.motors[j]));
    }
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_TRUE(same(s.T_0E[j], r.T_0E[j]));
      EXPECT_TRUE(same(s.F_a.v[j], r.F_a.v[j]));
    }
    expect_round_trip(r, [](const effector_reply_t& t) { return from_message(t); });
  }
}

TEST(Convert, EverythingElseSurvivesTheWire) {
  for (int k = 0; k < kCases; ++k) {
    expect_round_trip(random_fault(), [](const fault_t& m) { return from_message(m); });
    StepSample sample;
    fill(sample.T_0E);
    fill(sample.F_a.v);
    expect_round_trip(sample, [](const step_sample_t& m) { return from_message(m); });
    const Order order{bits<int>(), bits<int>(), {flag(), flag()}, flag(), random_arm()};
    expect_round_trip(order, [](const agent_order_t& m) { return from_message(m); });
    Report report{bits<int>(),     bits<int>(),    flag(), bits<int>(), bits<DriverState>(),
                  bits<Verdict>(), random_fault(), flag(), {},          {},
                  number(),        flag()};
    fill(report.T_0E);
    fill(report.F_a.v);
    expect_round_trip(report, [](const agent_report_t& m) { return from_message(m); });
    SensorReading reading{bits<int>(), flag(), {}};
    fill(reading.value);
    expect_round_trip(reading, [](const sensor_reading_t& m) { return from_message(m); });
    CameraReading seen{0, bits<std::int64_t>(), number(), flag(), flag(), {}, {}, number()};
    std::ranges::generate(seen.T_CG.R.reshaped(), number);
    std::ranges::generate(seen.T_CG.p, number);
    std::ranges::generate(seen.covariance.reshaped(), number);
    expect_round_trip(seen, [k](camera_reading_t m) {
      m.header.stamp = k;
      CameraReading r = from_message(m);
      EXPECT_EQ(r.frame, k);
      return r;
    });
    HardwareCommand drive;
    fill(drive.pwm);
    drive.enabled = flag();
    drive.jaws_enabled = flag();
    drive.macrostep = bits<std::int64_t>();
    drive.outputs = bits<std::uint16_t>();
    expect_round_trip(drive, [k](hardware_command_t m) {
      m.header.stamp = k;
      const HardwareCommand c = from_message(m);
      EXPECT_EQ(c.step, k);
      return c;
    });
    HardwareReading hardware;
    for (auto& e : hardware.encoder) e = bits<std::int32_t>();
    for (auto& s : hardware.switches) s = bits<std::uint8_t>();
    for (auto& i : hardware.index) i = bits<std::int32_t>();
    hardware.inputs = bits<std::uint16_t>();
    fill(hardware.analog);
    fill(hardware.current);
    fill(hardware.S_F_m.v);
    expect_round_trip(hardware, [](const hardware_state_t& m) { return from_message(m); });
  }
}

TEST(Convert, MessagesBringBackWhateverWasSent) {
  const auto no_fault = [](auto m) {
    m.fault = fault_t{};
    return m;
  };
  with_random_bytes<step_sample_t>([](const step_sample_t& m) { expect_all_back(m); });
  with_random_bytes<arm_command_t>([](const arm_command_t& m) { expect_all_back(m); });
  with_random_bytes<robot_model_t>([](const robot_model_t& m) { expect_all_back(m); });
  with_random_bytes<effector_command_t>([](const effector_command_t& m) { expect_all_back(m); });
  with_random_bytes<effector_reply_t>([&](const effector_reply_t& m) { expect_all_back(no_fault(m)); });
  with_random_bytes<agent_order_t>([](const agent_order_t& m) { expect_all_back(m); });
  with_random_bytes<agent_report_t>([&](const agent_report_t& m) { expect_all_back(no_fault(m)); });
  with_random_bytes<sensor_reading_t>([](const sensor_reading_t& m) { expect_all_back(m); });
  with_random_bytes<sensor_setting_t>([](const sensor_setting_t& m) { expect_all_back(m); });
  with_random_bytes<camera_reading_t>([](const camera_reading_t& m) { expect_all_back(m); });
  with_random_bytes<hardware_command_t>([](const hardware_command_t& m) { expect_all_back(m); });
  with_random_bytes<hardware_state_t>([](const hardware_state_t& m) { expect_all_back(m); });
}

TEST(Convert, AFaultWithAnUnknownCodeIsAnInternalError) {
  for (const std::int32_t code : {-1, 1000, 65536, 65537, INT32_MIN, INT32_MAX}) {
    fault_t m{};
    m.code = code;
    EXPECT_EQ(from_message(m).code, FaultCode::internal_error) << code;
  }
}

TEST(Convert, AnyBytesOfTheRightLengthDecodeWithoutHarm) {
  for (int k = 0; k < 20000; ++k) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<effector_command_t>()));
    const auto good = bytes_of(to_message(EffectorCommand{}));
    std::copy_n(good.begin(), 8, bytes.begin());  // LCM's fingerprint
    for (std::size_t j = 8; j < bytes.size(); ++j) bytes[j] = bits<std::uint8_t>();
    const auto m = link::decode<effector_command_t>(bytes);
    ASSERT_TRUE(m);
    const EffectorCommand c = from_message(*m);
    EXPECT_EQ(c.number, m->number);
  }
}

}  // namespace
}  // namespace mrroc
