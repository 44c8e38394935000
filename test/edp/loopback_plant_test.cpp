// The plant of motors alone: what its drives do with a duty cycle, and what its sensors say of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "edp/loopback_hardware.hpp"
#include "test/edp/one_motor.hpp"

namespace mrroc::edp {
namespace {

constexpr double kDt = 0.002;
constexpr double kIncrements = 1000;  // of a radian
constexpr double kTurn = 2 * std::numbers::pi;

AxisProperties motor_with(const DriveModel& drive) {
  AxisProperties axis{"motor", {-1e6, 1e6}, {-50, 70}, kIncrements, 1e6, {}};
  axis.servo.drive = drive;
  return axis;
}

/// A motor whose time constant is 50 ms and whose speed at full voltage is 480 rad/s.
DriveModel motor(double friction = 0) {
  DriveModel drive;
  drive.resistance = 2;
  drive.torque_constant = 0.1;
  drive.inertia = 2.5e-4;
  drive.friction = friction;
  return drive;
}

/// One motor that a weight loads.
class Loaded : public test::OneMotor {
 public:
  Loaded(const AxisProperties& axis, double load) : OneMotor(axis), load_(load) {}
  [[nodiscard]] AxisVector gravity(const AxisVector&) const noexcept override {
    return AxisVector::Constant(1, load_);
  }

 private:
  double load_;
};

struct Bench {
  explicit Bench(const DriveModel& drive, double load = 0, double start = 1)
      : robot(motor_with(drive), load) {
    plant = {robot, AxisVector::Constant(1, start), kDt};
    command.enabled = true;
  }
  void run(double pwm, int steps = 1) {
    command.pwm[0] = pwm;
    for (int k = 0; k < steps; ++k) {
      const double before = position();
      plant.step(&command);
      speed = (position() - before) / kDt;
    }
  }
  [[nodiscard]] double position() const { return plant.motors()[0]; }
  [[nodiscard]] double current() const { return plant.reading().current[0]; }
  [[nodiscard]] bool told(AxisSwitch which) const {
    return (plant.reading().switches[0] & static_cast<unsigned>(which)) != 0;
  }

  Loaded robot;
  LoopbackPlant plant{robot, AxisVector::Constant(1, 0), kDt};
  HardwareCommand command;
  double speed{};  // mean of the last step
};

TEST(LoopbackPlant, AFreeShaftComesToItsSpeedWithTheTimeConstantOfItsDrive) {
  for (const double pwm : {-120., 60., 255.}) {
    Bench b(motor());
    const double fastest = pwm / 255 * 480;
    b.run(pwm, 25);  // 50 ms
    EXPECT_NEAR(b.speed / fastest, 1 - std::exp(-1.), 0.02) << "a time constant";
    b.run(pwm, 500);
    EXPECT_NEAR(b.speed, fastest, 1e-6);
    EXPECT_NEAR(b.current(), 0, 1e-6) << "it needs no torque";
  }
}

TEST(LoopbackPlant, MoreThanTheWholeVoltageThereIsNot) {
  Bench b(motor());
  b.run(1000, 500);
  EXPECT_NEAR(b.speed, 480, 1e-4);
  b.run(-1000, 1000);
  EXPECT_NEAR(b.speed, -480, 1e-4);
}

TEST(LoopbackPlant, FrictionTakesItsTorqueFromAShaftThatTurnsAndHoldsOneThatHardlyPulls) {
  const double friction = 0.02;
  Bench turns(motor(friction));
  turns.run(100, 1000);
  EXPECT_NEAR(turns.speed, 100. / 255 * 480 - friction * 2 / 0.01, 0.5);
  EXPECT_NEAR(turns.current(), friction / 0.1, 0.002);
  Bench held(motor(friction));
  const double half = 0.5 * held.robot.axis(0).servo.drive.pwm_per_torque() * friction;
  constexpr int kSlowly = 4000;
  for (int k = 1; k <= kSlowly; ++k) held.run(half * k / kSlowly);
  held.run(half, 500);
  EXPECT_NEAR(held.speed, 0, 1e-6);
  EXPECT_NEAR(held.position() - 1, std::log(2) * held.robot.axis(0).servo.drive.presliding, 1e-4)
      << "as a spring that yields: half of the friction is there after that part of its turn";
}

TEST(LoopbackPlant, AWeightIsHeldByItsDutyCycleAndSinksWithoutIt) {
  const double load = 0.15;
  Bench b(motor(), load);
  const double holding = b.robot.axis(0).servo.drive.pwm_per_torque() * load;
  b.run(holding, 100);
  EXPECT_NEAR(b.position(), 1, 1e-9);
  EXPECT_NEAR(b.current(), load / 0.1, 1e-9);
  b.run(0, 500);
  EXPECT_NEAR(b.speed, -load * 2 / 0.01, 1e-3) << "the motor brakes it as a generator";
}

TEST(LoopbackPlant, ADriveLimitsItsCurrentAndTellsIt) {
  DriveModel drive = motor();
  drive.current_limit = 3;
  for (const double side : {-1., 1.}) {
    Bench b(drive);
    b.run(side * 200);
    EXPECT_NEAR(b.current(), side * 3, 1e-12);
    EXPECT_TRUE(b.told(AxisSwitch::current_limited));
    const double before = b.speed;
    b.run(side * 200);
    EXPECT_NEAR(b.speed - before, side * 0.1 * 3 / drive.inertia * kDt, 1e-9) << "the torque of that current";
    b.run(side * 200, 1000);
    EXPECT_FALSE(b.told(AxisSwitch::current_limited));
    EXPECT_NEAR(b.speed, side * 200. / 255 * 480, 1e-6) << "the speed is as ever";
  }
}

TEST(LoopbackPlant, AShaftThatMeetsAStopStandsAndDrawsWhatItsWindingLetsThrough) {
  Bench b(motor());
  b.plant.set_stops(0, {0.5, 1.5});
  for (const double side : {1., -1.}) {
    b.run(side * 50, 400);
    EXPECT_EQ(b.position(), side > 0 ? 1.5 : 0.5);
    EXPECT_NEAR(b.current(), side * 48 * 50 / 255 / 2, 0.3);
  }
  b.run(50, 1);
  EXPECT_GT(b.position(), 0.5) << "it is free to go away from it, from rest";
  EXPECT_LT(b.speed, 10);
}

TEST(LoopbackPlant, BrakesTakeAlmostAllOfTheSpeedInAStep) {
  Bench b(motor());
  b.run(100, 500);
  const double before = b.speed;
  b.command.enabled = false;
  b.run(100);
  EXPECT_LT(b.speed, 0.1 * before);
  EXPECT_GT(b.speed, 0);
  EXPECT_EQ(b.current(), 0);
  b.run(100, 20);
  const double stands = b.position();
  b.run(100, 50);
  EXPECT_NEAR(b.position(), stands, 1e-9) << "no duty cycle moves it";
}

TEST(LoopbackPlant, EncoderCountsFromWhereItBegan) {
  Bench b(motor());
  EXPECT_EQ(b.plant.reading().encoder[0], 0);
  EXPECT_EQ(b.plant.reading().step, 0);
  for (int k = 1; k <= 300; ++k) {
    b.run(k < 100 ? 100 : -150);
    EXPECT_EQ(b.plant.reading().encoder[0], std::lround((b.position() - 1) * kIncrements));
    EXPECT_EQ(b.plant.reading().step, k);
  }
  EXPECT_LT(b.plant.reading().encoder[0], 0);
}

TEST(LoopbackPlant, SwitchesArePressedBeyondTheLegalRangeAndBelowThePlaceOfTheSynchronisation) {
  const auto at = [](double position) {
    const Bench b(motor(), 0, position);
    return static_cast<int>(b.plant.reading().switches[0]);
  };
  constexpr int kLower = static_cast<int>(AxisSwitch::lower_limit),
                kUpper = static_cast<int>(AxisSwitch::upper_limit),
                kSynchro = static_cast<int>(AxisSwitch::synchro);
  EXPECT_EQ(at(-50.01), kLower | kSynchro);
  EXPECT_EQ(at(-50), kSynchro);
  EXPECT_EQ(at(-3.01), kSynchro);
  EXPECT_EQ(at(-3), 0);
  EXPECT_EQ(at(70), 0);
  EXPECT_EQ(at(70.01), kUpper);
}

TEST(LoopbackPlant, TheZeroMarkIsPassedOncePerTurnAtTheSamePlaceInEitherDirection) {
  Bench b(motor());
  for (const double pwm : {40., -40.}) {
    int marks = 0;
    const double from = b.position();
    for (int k = 0; k < 400; ++k) {
      const double before = b.position();
      b.run(pwm);
      if (!b.told(AxisSwitch::index)) continue;
      ++marks;
      const double mark = 1 + b.plant.reading().index[0] / kIncrements;
      EXPECT_NEAR(mark, kTurn * std::round(mark / kTurn), 0.5 / kIncrements + 1e-9) << "whole turns";
      EXPECT_GE(mark, std::min(before, b.position()) - 1 / kIncrements);
      EXPECT_LE(mark, std::max(before, b.position()) + 1 / kIncrements);
    }
    EXPECT_NEAR(marks, std::abs(b.position() - from) / kTurn, 1);
    EXPECT_GT(marks, 4);
  }
}

TEST(LoopbackPlant, OutputsComeBackAsInputs) {
  Bench b(motor());
  b.command.outputs = 0xa5;
  b.run(0);
  EXPECT_EQ(b.plant.reading().inputs, 0xa5);
  b.plant.step(nullptr);
  EXPECT_EQ(b.plant.reading().inputs, 0xa5) << "they stay";
}

TEST(LoopbackPlant, TheForceSensorHasNoiseAboutZeroThatNeverRepeats) {
  Bench b(motor());
  Wrench sum, last;
  constexpr int kSteps = 4000;
  double squares = 0;
  for (int k = 0; k < kSteps; ++k) {
    b.run(0);
    const Wrench& F = b.plant.reading().S_F_m;
    for (const Axis a : kAxes) {
      EXPECT_LE(std::abs(F[a]), 0.02);
      EXPECT_NE(F[a], last[a]) << "else the sensor would count as stuck";
      squares += F[a] * F[a];
    }
    sum += F;
    last = F;
  }
  for (const Axis a : kAxes) EXPECT_NEAR(sum[a] / kSteps, 0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / (6 * kSteps)), 0.02 / std::sqrt(3), 0.0005) << "evenly up to its largest";
}

// Of a nanosecond, which is over before a command can be given, and of a day, which is not.
TEST(LoopbackHardware, ByTheClockACommandAfterItsPeriodIsAnOverrun) {
  const test::OneMotor robot(motor_with(motor()));
  for (const auto& [period, overruns] : {std::pair(1e-9, 1), {86400., 0}}) {
    LoopbackHardware hardware(LoopbackPlant(robot, AxisVector::Constant(1, 1), kDt), period, true);
    ASSERT_NE(hardware.clock(), nullptr);
    EXPECT_EQ(hardware.read(0).reading.step, 0);
    hardware.write({});
    EXPECT_EQ(hardware.clock()->late().periods, 1);
    EXPECT_EQ(hardware.clock()->late().overruns, overruns) << period;
  }
}

TEST(LoopbackHardware, InLockStepAStepPassesForEveryCommandAndMissedOnesWithoutOne) {
  const test::OneMotor robot(motor_with(motor()));
  LoopbackHardware hardware(LoopbackPlant(robot, AxisVector::Constant(1, 1), kDt), kDt, false);
  EXPECT_EQ(hardware.clock(), nullptr);
  HardwareCommand command;
  command.enabled = true;
  for (std::int64_t step = 0; step < 5; ++step) {
    const ReadResult r = hardware.read(step);
    EXPECT_EQ(r.status, ReadStatus::reading);
    EXPECT_EQ(r.reading.step, step);
    EXPECT_EQ(hardware.read(step).reading.step, step) << "it waits for its command";
    hardware.write(command);
  }
  EXPECT_EQ(hardware.read(5 + LoopbackPlant::kCommandTimeout).reading.step,
            5 + LoopbackPlant::kCommandTimeout);
  EXPECT_TRUE(hardware.plant().enabled());
  EXPECT_EQ(hardware.read(6 + LoopbackPlant::kCommandTimeout).reading.step,
            6 + LoopbackPlant::kCommandTimeout);
  EXPECT_FALSE(hardware.plant().enabled()) << "too many without a command";
}

}  // namespace
}  // namespace mrroc::edp
