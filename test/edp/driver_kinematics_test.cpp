// An arm with two kinematic models and with weight: what a driver makes of its robot.
#include <gtest/gtest.h>

#include "edp/control_law.hpp"
#include "test/base/random_pose.hpp"
#include "test/edp/one_motor.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

using mrroc::test::distance;

/// A FakeArm whose second model finds the slides a little farther along at the same motor positions.
class TwoModels final : public Robot {
 public:
  TwoModels(int model, const TwoModels* other) : model_(model), other_(other) {
    if (model_ == 1) shift_.head<3>() << 0.01, -0.02, 0.03;
  }
  void set_other(const TwoModels* other) { other_ = other; }

  [[nodiscard]] int model() const noexcept override { return model_; }
  [[nodiscard]] int models() const noexcept override { return 2; }
  [[nodiscard]] const Robot* with_model(int number) const noexcept override {
    return number == model_ ? this : number == 1 - model_ ? other_ : nullptr;
  }
  [[nodiscard]] std::string_view name() const noexcept override { return arm_.name(); }
  [[nodiscard]] int axes() const noexcept override { return FakeArm::kAxes; }
  [[nodiscard]] const AxisProperties& axis(int axis) const noexcept override { return arm_.axis(axis); }
  [[nodiscard]] Pose forward(const AxisVector& q) const noexcept override { return arm_.forward(q); }
  [[nodiscard]] InverseSolution inverse(const Pose& T, const AxisVector& near) const noexcept override {
    return arm_.inverse(T, near);
  }
  [[nodiscard]] AxisVector motors_from_joints(const AxisVector& q) const noexcept override {
    return arm_.motors_from_joints(q - shift_);
  }
  [[nodiscard]] AxisVector joints_from_motors(const AxisVector& m) const noexcept override {
    return arm_.joints_from_motors(m) + shift_;
  }

 private:
  FakeArm arm_;
  int model_;
  const TwoModels* other_;
  AxisVector shift_ = AxisVector::Zero(FakeArm::kAxes);
};

class Models : public testing::Test {
 protected:
  Models() : second(1, &first), driver(first, Rig::parameters()), world(arm, Rig::home()) {
    first.set_other(&second);
    world.T_WE = Rig::parameters().T_WE;
    world.T_WS = Rig::parameters().force.T_WS;
    EffectorCommand synchro = command();
    synchro.instruction = Instruction::synchro;
    macrostep(synchro);
  }
  EffectorCommand command() {
    EffectorCommand c;
    c.session = 7;
    c.number = ++number;
    c.instruction = Instruction::set;
    return c;
  }
  /// @return SET KINEMATIC_MODEL
  EffectorCommand choose(int model) {
    EffectorCommand c = command();
    c.set = static_cast<std::uint8_t>(Part::robot_model);
    c.robot_model.set_kinematic_model = true;
    c.robot_model.kinematic_model = static_cast<std::uint16_t>(model);
    return c;
  }
  /// @return the same with an interpolated motion of n_s steps
  EffectorCommand choose_and_move(int model, Representation representation, const PoseNumbers& goal,
                                  std::uint16_t n_s) {
    EffectorCommand c = choose(model);
    c.set = Part::arm | Part::robot_model;
    c.arm.mu = Interpolation::mim;
    c.arm.representation = representation;
    c.arm.pose = goal;
    c.arm.n_s = c.arm.n_Q = n_s;
    return c;
  }
  EffectorReply macrostep(const std::optional<EffectorCommand>& c = std::nullopt) {
    if (c) driver.take(*c);
    EffectorReply reply{};
    do {
      world.apply(driver.step(world.reading()));
      if (driver.reply_due()) reply = driver.reply();
    } while (!driver.at_boundary());
    return reply;
  }
  /// Whether set and measured pose are those of a model, with motors that have not moved.
  void expect_pose_of(const TwoModels& model, const EffectorReply& reply) const {
    const Pose T_0E = model.forward_from_motors(AxisVector::Zero(FakeArm::kAxes)) * world.T_WE;
    EXPECT_LT(distance(driver.set_point().T_0E, T_0E), 1e-12);
    EXPECT_LT(distance(pose_from_angle_axis(Vector6(reply.T_0E.data())), T_0E), 1e-12);
    EXPECT_LT(world.motors().cwiseAbs().maxCoeff(), 1e-12);
  }

  FakeArm arm;
  TwoModels first{0, nullptr};
  TwoModels second;
  Driver driver;
  FakeWorld world;
  std::int64_t number{};
};

TEST_F(Models, AnotherOneMeansAnotherPoseOfTheSameMotors) {
  expect_pose_of(first, macrostep());
  const EffectorReply changed = macrostep(choose(1));
  EXPECT_EQ(changed.verdict, Verdict::executed);
  EXPECT_EQ(changed.robot_model.kinematic_model, 1);
  const EffectorReply after = macrostep();
  expect_pose_of(second, after);
  EXPECT_EQ(after.robot_model.kinematic_model, 1);
  EXPECT_EQ(macrostep(choose(2)).fault.limit, 1) << "the last of two";
  number = driver.protocol().expected() - 1;
  macrostep(choose(0));
  expect_pose_of(first, macrostep());
}

TEST_F(Models, AMotionThatBringsAnotherOneIsThatOfTheOtherOne) {
  const AxisVector goal = (AxisVector(6) << 0.02, 0.01, -0.01, 0.1, -0.1, 0.1).finished();
  const EffectorCommand c = choose_and_move(1, Representation::joints, numbers_from_axes(goal), 500);
  ASSERT_EQ(macrostep(c).verdict, Verdict::executed);
  for (int k = 0; k < 10; ++k) macrostep();
  EXPECT_LT((driver.set_point().axes.motors - second.motors_from_joints(goal)).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((driver.set_point().axes.joints - goal).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Models, ARefusedMotionBringsNone) {
  const EffectorCommand c = choose_and_move(1, Representation::motors, {100}, 1);
  EXPECT_EQ(macrostep(c).fault.code, FaultCode::too_fast);
  const EffectorReply reply = macrostep();
  EXPECT_EQ(reply.robot_model.kinematic_model, 0);
  expect_pose_of(first, reply);
}

TEST_F(Models, ADriverBeginsWithTheOneOfItsRobot) {
  Driver other(second, Rig::parameters());
  while (!other.reply_due()) other.step(world.reading());
  EXPECT_EQ(other.reply().robot_model.kinematic_model, 1);
}

AxisProperties axis_of_a_weight() {
  AxisProperties axis;
  axis.name = "any";
  axis.joint = axis.motor = {-50, 50};
  axis.increments_per_rad = 1000;
  axis.max_motor_speed = 250;
  axis.servo.compensating.fill({.bandwidth = 100, .observer = 150});
  axis.servo.drive = {.resistance = 2, .inertia = 3e-4};
  axis.servo.standard = {1, 0};
  return axis;
}

/// One axis that holds a weight.
class Weight final : public OneMotor {
 public:
  Weight() : OneMotor(axis_of_a_weight()) {}
  [[nodiscard]] AxisVector gravity(const AxisVector&) const noexcept override {
    return AxisVector::Constant(1, 0.1);
  }
};

/// What the regulator does about the whole weight in its first step.
double whole_gravity_feed_forward(const Weight& robot) {
  const AxisVector rest = AxisVector::Zero(1);
  return Servo(robot, 0.002).step(rest, rest, robot.gravity(rest))[0];
}

EffectorCommand synchro() {
  EffectorCommand c;
  c.session = 7;
  c.number = 1;
  c.instruction = Instruction::synchro;
  return c;
}

TEST(GravityFeedForward, AtAKnownPoseTheMotorsTakeTheWholeWeightFromTheBrakesAtOnce) {
  const Weight robot;
  DriverParameters p;
  p.synchro_joints = AxisVector::Zero(1);
  Driver driver(robot, p);
  driver.take(synchro());
  const HardwareCommand first = driver.step({});
  EXPECT_TRUE(first.enabled);
  EXPECT_NE(first.pwm[0], 0);
  EXPECT_DOUBLE_EQ(first.pwm[0], whole_gravity_feed_forward(robot));
}

// The motor holds the weight already, as an error that its regulator knows; the shaft of this test needs no torque.
TEST(GravityFeedForward, AfterHomingItGrowsEvenlyToTheWholeWeight) {
  const Weight robot;
  DriverParameters p;
  p.synchronisation = Synchronisation::homing;
  p.homing.standstill_steps = 5;
  Driver driver(robot, p);
  HardwareReading reading{};
  driver.take(synchro());
  const auto step = [&] {
    const HardwareCommand command = driver.step(reading);
    ++reading.step;
    return command.pwm[0];
  };
  double turned = 0;
  for (int k = 0; k < 10'000 && driver.state() != DriverState::ready; ++k) {
    step();
    turned += driver.set_point().motor_increment[0];
    reading.encoder[0] = reading.index[0] = static_cast<std::int32_t>(std::lround(1000 * turned));
    reading.switches[0] = static_cast<std::uint8_t>(AxisSwitch::index);
    if (turned < -1)
      reading.switches[0] =
          static_cast<std::uint8_t>(reading.switches[0] | static_cast<unsigned>(AxisSwitch::synchro));
  }
  ASSERT_EQ(driver.state(), DriverState::ready);
  const double at_first = step();
  double before = at_first;
  for (int k = 0; k < 90; ++k) {
    const double now = step();
    EXPECT_GT((now - before) * whole_gravity_feed_forward(robot), 0) << k;
    before = now;
  }
  EXPECT_NEAR((before - at_first) / whole_gravity_feed_forward(robot), 0.9, 0.05);
}

}  // namespace
}  // namespace mrroc::edp::test
