// A driver with a fake arm, ideal drives and a spring to push against.
#pragma once
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "base/axis_command.hpp"
#include "base/representation.hpp"
#include "edp/driver.hpp"
#include "test/edp/fake_arm.hpp"

namespace mrroc::edp::test {

/// The surroundings of the arm, and the readings of its sensors.
class FakeWorld {
 public:
  explicit FakeWorld(const FakeArm& arm, const AxisVector& joints) : arm_(&arm) {
    const AxisVector m = arm.motors_from_joints(joints);
    for (int k = 0; k < FakeArm::kAxes; ++k) at(k) = m[k] * arm.axis(k).increments_per_rad;
    last_counts_ = counts_;
  }

  Vector6 stiffness = Vector6::Zero();  ///< of the surroundings, along and about the axes of the base
  Pose T_0E_free;                       ///< pose of E at which the springs are relaxed
  bool one_sided{};                     ///< the spring along z only pushes, against +z
  Pose T_WS;                            ///< sensor in the wrist
  Pose T_WE;                            ///< tool
  double weight{};                      ///< of the tool [N]
  Vector3 mass_centre = Vector3::Zero();
  Wrench sensor_offset;                           ///< in every reading
  std::array<std::uint8_t, kMaxAxes> switches{};  ///< of the next readings
  std::uint16_t inputs{};                         ///< in every reading, as the next
  std::array<double, kAnalogInputs> analog{};
  struct SynchroSwitch {
    double place{-3};  ///< pressed below this motor position [rad]
    bool missing{};    ///< never pressed
    bool stuck{};      ///< always pressed
    bool index{true};  ///< the encoder has its zero marks, at whole turns of the motor
  };
  std::array<SynchroSwitch, kMaxAxes> synchro{};  ///< for homing
  bool limit_switches{};                          ///< pressed beyond the motors' legal ranges
  std::array<double, kMaxAxes> slip{};            ///< counts that a shaft turns by itself in the next step
  std::array<bool, kMaxAxes> blocked{};

  [[nodiscard]] AxisVector motors() const {
    AxisVector m(FakeArm::kAxes);
    for (int k = 0; k < FakeArm::kAxes; ++k)
      m[k] = counts_[static_cast<std::size_t>(k)] / arm_->axis(k).increments_per_rad;
    return m;
  }
  [[nodiscard]] Pose T_0W() const { return arm_->forward(arm_->joints_from_motors(motors())); }
  [[nodiscard]] Pose T_0E() const { return T_0W() * T_WE; }

  /// @return what the surroundings exert on the tool, at E, in E
  [[nodiscard]] Wrench load() const {
    const Pose T = T_0E();
    Vector6 deviation;
    deviation << T.p - T_0E_free.p, angle_axis_from_rotation(T.R * T_0E_free.R.transpose());
    Vector6 F = -stiffness.cwiseProduct(deviation);
    if (one_sided && deviation[2] < 0) F[2] = 0;
    return xi_star(T.R.transpose(), Wrench::from(F.head<3>(), F.tail<3>()));
  }

  [[nodiscard]] HardwareReading reading() const {
    HardwareReading r;
    r.step = step_;
    for (std::size_t k = 0; k < FakeArm::kAxes; ++k)
      r.encoder[k] = static_cast<std::int32_t>(std::lround(counts_[k])) + 1000 * static_cast<int>(k + 1);
    const Vector3 f = -weight * T_0W().R.row(2).transpose();
    const Wrench W_F = Wrench::from(f, mass_centre.cross(f)) + xi_F(T_WE, load());
    r.S_F_m = xi_F(T_WS.inverse(), W_F) + sensor_offset;
    r.switches = switches;
    r.inputs = inputs;
    r.analog = analog;
    for (std::size_t k = 0; k < FakeArm::kAxes; ++k) read_switches(k, r);
    return r;
  }

  /// The drives make every increment in one step; switched off they brake.
  void apply(const HardwareCommand& command) {
    last_counts_ = counts_;
    for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
      if (command.enabled && !blocked[k]) counts_[k] += 2 * command.pwm[k];
      counts_[k] += slip[k];
      slip[k] = 0;
    }
    ++step_;
  }

 private:
  void read_switches(std::size_t k, HardwareReading& r) const {
    const AxisProperties& axis = arm_->axis(static_cast<int>(k));
    const double motor = counts_[k] / axis.increments_per_rad;
    const SynchroSwitch& s = synchro[k];
    const auto press = [&](AxisSwitch which, bool pressed) {
      if (pressed) r.switches[k] = static_cast<std::uint8_t>(r.switches[k] | static_cast<unsigned>(which));
    };
    press(AxisSwitch::synchro, s.stuck || (!s.missing && motor < s.place));
    press(AxisSwitch::lower_limit, limit_switches && motor < axis.motor.lower);
    press(AxisSwitch::upper_limit, limit_switches && motor > axis.motor.upper);
    const double turn = 2 * std::numbers::pi;
    const double before = last_counts_[k] / axis.increments_per_rad;
    const double mark = std::max(std::floor(motor / turn), std::floor(before / turn));
    press(AxisSwitch::index, s.index && std::floor(motor / turn) != std::floor(before / turn));
    r.index[k] = r.encoder[k] +
                 static_cast<std::int32_t>(std::lround(mark * turn * axis.increments_per_rad - counts_[k]));
  }
  double& at(int k) { return counts_[static_cast<std::size_t>(k)]; }
  const FakeArm* arm_;
  std::array<double, kMaxAxes> counts_{};
  std::array<double, kMaxAxes> last_counts_{};
  std::int64_t step_{100};
};

/// Driver and world, stepped together.
class Rig {
 public:
  static AxisVector home() { return AxisVector::Zero(FakeArm::kAxes); }
  static DriverParameters parameters() {
    DriverParameters p;
    p.synchro_joints = home();
    p.T_WE = {Matrix3::Identity(), Vector3(0.02, 0, 0.1)};
    // The arm is as quick as a test likes; the limits of acceleration have tests of their own.
    p.limits.linear_acceleration = p.limits.angular_acceleration = p.limits.motor_acceleration = 1e6;
    p.force.T_WS = {rotation_from_angle_axis(Vector3(0, 0, 1)), Vector3(0, 0, 0.03)};
    return p;
  }

  explicit Rig(const DriverParameters& p = parameters(), const AxisVector& joints = home())
      : driver(arm, p), world(arm, joints), p_(p) {
    world.T_WS = p.force.T_WS;
    world.T_WE = p.T_WE;
    world.weight = p.force.weight;
    world.mass_centre = p.force.mass_centre;
    world.T_0E_free = world.T_0E();
  }

  FakeArm arm;
  Driver driver;
  FakeWorld world;
  std::int64_t number{};                  ///< of the last command
  std::function<void()> after_each_step;  ///< looks at the rig

  /// @return a command with the next number
  EffectorCommand command(Instruction instruction) {
    EffectorCommand c;
    c.session = 7;
    c.number = ++number;
    c.instruction = instruction;
    return c;
  }
  EffectorCommand set_arm(const ArmCommand& arm_command) {
    EffectorCommand c = command(Instruction::set);
    c.set = Part::arm | Part{};
    c.arm = arm_command;
    return c;
  }
  /// @return TCIM-VELOCITY with n_Q = n_s - 1
  EffectorCommand velocity(const TaskFrameCommand& frame, std::uint16_t n_s = 10) {
    ArmCommand a;
    a.frame = frame;
    a.n_s = n_s;
    a.n_Q = n_s > 1 ? static_cast<std::uint16_t>(n_s - 1) : std::uint16_t{1};
    return set_arm(a);
  }

  void step() {
    world.apply(last = driver.step(world.reading()));
    if (after_each_step) after_each_step();
  }
  /// One macrostep. @return its reply
  EffectorReply macrostep(const std::optional<EffectorCommand>& c = std::nullopt) {
    if (c) driver.take(*c);
    EffectorReply reply{};
    do {
      step();
      if (driver.reply_due()) reply = driver.reply();
    } while (!driver.at_boundary());
    return reply;
  }
  /// Repeats a command with new numbers. @return the last reply
  EffectorReply repeat(EffectorCommand c, int macrosteps) {
    EffectorReply reply{};
    for (int k = 0; k < macrosteps; ++k) {
      if (k > 0) c.number = ++number;
      reply = macrostep(c);
    }
    return reply;
  }
  /// Silent macrosteps. @return the last reply
  EffectorReply silence(int macrosteps) {
    EffectorReply reply{};
    for (int k = 0; k < macrosteps; ++k) reply = macrostep();
    return reply;
  }
  /// @return a relative motion of the motors [rad], which needs no synchronisation
  EffectorCommand jog(const PoseNumbers& motors, std::uint16_t n_s = 100) {
    ArmCommand a;
    a.mu = Interpolation::mim;
    a.representation = Representation::motors;
    a.reference = Reference::relative;
    a.pose = motors;
    a.n_s = a.n_Q = n_s;
    return set_arm(a);
  }
  /// @return a motion at 0.5 m/s in the air, which meets the limit of slide z after its reply
  EffectorCommand motion_into_a_limit() {
    ArmCommand a;
    a.frame.z = c(5, 0, 0.1);
    a.n_s = 1000;
    a.n_Q = 1;
    return set_arm(a);
  }
  EffectorReply synchronise() { return macrostep(command(Instruction::synchro)); }

  HardwareCommand last;

 private:
  DriverParameters p_;
};

}  // namespace mrroc::edp::test
