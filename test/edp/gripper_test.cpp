// The servo of the jaws step by step: set point, current, what counts as blocked, and homing.
#include "edp/gripper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mrroc::edp {
namespace {

constexpr double kDt = 0.002;
constexpr double kIncrements = 100;  // of a radian

double distance(double motor) noexcept { return 0.07 - 1e-5 * motor; }
double motor(double distance) noexcept { return (0.07 - distance) / 1e-5; }

GripperParameters parameters() {
  GripperParameters p;
  p.distance = distance;
  p.motor = motor;
  p.legal = {0.05, 0.09};
  p.open_stop = -2100;
  p.open_direction = -1;
  p.increments_per_rad = kIncrements;
  p.speed = 1000;
  p.opening_speed = 1500;
  p.acceleration = 5000;
  p.homing_speed = 251;  // of which no whole number of steps makes the time that homing may take
  p.max_current = 0.15;
  p.stiffness = 0.03;
  p.damping = 0.001;
  p.current_gain = 100;
  p.over_current = 0.2;
  p.blocked_current = 0.1;
  p.blocked_motion = 0.5;
  p.blocked_steps = 25;
  return p;
}

class Jaws : public testing::Test {
 protected:
  explicit Jaws(const GripperParameters& p = parameters()) : gripper(p, kDt) {}

  [[nodiscard]] static std::int32_t count(double position) {
    return static_cast<std::int32_t>(std::lround(kIncrements * position));
  }
  /// A step in which the shaft is where it is told to be. @return the set point
  double follow() {
    EXPECT_FALSE(gripper.measure(count(gripper.set_motor()), 0));
    std::ignore = gripper.step();
    return gripper.set_motor();
  }
  /// So many steps of a shaft that stands and a motor that draws a current. @return whether it is blocked then
  bool press(double position, double current, int steps) {
    for (int k = 0; k < steps; ++k) std::ignore = gripper.measure(count(position), current);
    return gripper.blocked();
  }

  Gripper gripper;
};

TEST_F(Jaws, SetPointGoesToItsGoalWithTheSpeedAndAccelerationOfItsDirection) {
  for (const double to : {0.055, 0.085}) {
    const bool opens = to > 0.07;
    gripper.believe(0.07, 0);
    gripper.set_distance(to);
    double before = 0, speed = 0, fastest = 0;
    int steps = 0;
    for (; std::abs(gripper.set_motor() - motor(to)) > 0.1 && steps < 5000; ++steps) {
      const double set = follow();
      const double now = (set - before) / kDt;
      EXPECT_LE(std::abs(now - speed), 5000 * kDt * (1 + 1e-9)) << steps;
      EXPECT_GE(now * (opens ? -1 : 1), 0) << "never back";
      fastest = std::max(fastest, std::abs(now));
      before = set;
      speed = now;
    }
    EXPECT_NEAR(fastest, opens ? 1500 : 1000, 1e-6);
    // Two ramps, and the rest at the top speed.
    const double way = 1500, top = opens ? 1500 : 1000;
    EXPECT_NEAR(steps * kDt, way / top + top / 5000, 0.03) << to;
    for (int k = 0; k < 100; ++k)
      EXPECT_NEAR(follow(), motor(to), 3) << "and stays there, to the way of a step";
    EXPECT_NEAR(follow(), motor(to), 1e-6);
    EXPECT_NEAR(gripper.distance(), to, 1e-6);
  }
}

TEST_F(Jaws, ShortWaysNeverReachTheTopSpeed) {
  gripper.believe(0.07, 0);
  gripper.set_distance(0.0695);  // 50 rad
  double before = 0, fastest = 0;
  for (int k = 0; k < 500; ++k) {
    const double set = follow();
    fastest = std::max(fastest, std::abs(set - before) / kDt);
    before = set;
  }
  EXPECT_NEAR(before, 50, 1e-9);
  EXPECT_NEAR(fastest, std::sqrt(5000 * 50), 15);
}

TEST_F(Jaws, SetPointWaitsForJawsThatAreHeldAndGoesOnWithThem) {
  gripper.believe(0.07, 0);
  gripper.set_distance(0.06);
  for (int k = 0; k < 500; ++k) {
    std::ignore = gripper.measure(0, 0.05);
    std::ignore = gripper.step();
    ASSERT_LE(std::abs(gripper.set_motor()), 1.5 * 0.15 / 0.03 + 1e-9);
  }
  EXPECT_GT(gripper.set_motor(), 0.15 / 0.03) << "the whole current is asked for";
  gripper.set_distance(0.08);
  for (int k = 0; k < 500; ++k) follow();
  EXPECT_NEAR(gripper.set_motor(), -1000, 5) << "the way back is free";
}

TEST_F(Jaws, SetPointOfJawsThatWereHeldGoesOnFromRest) {
  for (const double to : {0.06, 0.08}) {
    gripper.believe(0.07, 0);
    gripper.set_distance(to);
    for (int k = 0; k < 500; ++k) {
      std::ignore = gripper.measure(0, 0.05);
      std::ignore = gripper.step();
    }
    double before = gripper.set_motor();
    for (int k = 1; k <= 10; ++k) {
      const double set = follow();
      EXPECT_NEAR((set - before) / kDt, (to < 0.07 ? 1 : -1) * k * 5000 * kDt, 1e-6) << "step " << k;
      before = set;
    }
    gripper.braked();
  }
}

TEST_F(Jaws, DutyCycleIsTheSumOfTheErrorsOfTheCurrent) {
  gripper.believe(0.07, 0);  // the goal is where it is
  // 2 rad behind at rest: 0.06 A wanted, 0.02 A flow.
  std::ignore = gripper.measure(count(-2), 0.02);
  std::ignore = gripper.step();  // the shaft has just moved by -2 rad in a step
  gripper.braked();
  gripper.believe(0.07, 0);
  std::ignore = gripper.measure(count(-2), 0);
  std::ignore = gripper.measure(count(-2), 0.02);
  EXPECT_NEAR(gripper.step(), 100 * (0.06 - 0.02), 1e-9);
  std::ignore = gripper.measure(count(-2), 0.05);
  EXPECT_NEAR(gripper.step(), 4 + 100 * (0.06 - 0.05), 1e-9);
  std::ignore = gripper.measure(count(-1), 0.06);  // 500 rad/s towards it: 0.03 - 0.5 A, at least -0.15
  EXPECT_NEAR(gripper.step(), 5 + 100 * (-0.15 - 0.06), 1e-9);
}

TEST_F(Jaws, CurrentAndDutyCycleAreClipped) {
  gripper.believe(0.07, 0);
  double pwm = 0;
  for (const double side : {-1., 1.}) {
    std::ignore = gripper.measure(count(side * 500), 0);
    for (int k = 0; k < 200; ++k) {
      std::ignore = gripper.measure(count(side * 500), 0);
      const double next = gripper.step();
      EXPECT_LE(std::abs(next - pwm), 100 * 0.15 + 1e-9);
      EXPECT_LE(std::abs(next), kMaxPwm);
      pwm = next;
    }
    EXPECT_EQ(pwm, -side * kMaxPwm);
  }
}

TEST_F(Jaws, AreBlockedByCurrentAndStandstillTogetherForAllTheSteps) {
  gripper.believe(0.07, 0);
  EXPECT_FALSE(press(0, 0.15, 25)) << "nobody knows where it was 25 steps ago";
  EXPECT_FALSE(press(0, 0, 10));
  EXPECT_FALSE(press(0, 0.1, 24));
  EXPECT_TRUE(press(0, -0.1, 1)) << "25 steps, in either direction";
  EXPECT_FALSE(press(0, 0.0999, 1)) << "the current has ended";
  EXPECT_FALSE(press(0, 0.15, 24));
  EXPECT_TRUE(press(0, 0.15, 1));
  EXPECT_FALSE(press(0.5, 0.15, 1)) << "it moves";
  EXPECT_FALSE(press(0.5, 0.15, 24));
  EXPECT_TRUE(press(0.5, 0.15, 1)) << "it stands since 25 steps";
  EXPECT_TRUE(press(0.99, 0.15, 1)) << "less than the motion";
  for (int k = 0; k < 200; ++k)
    EXPECT_FALSE(press(1 + 0.021 * k + 0.021, 0.15, 1) && k > 1) << "half a radian in 25 steps";
  EXPECT_FALSE(press(5, 0.05, 200)) << "standing alone is nothing";
  EXPECT_TRUE(press(5, 0.15, 25));
  EXPECT_FALSE(press(4.5, 0.15, 1)) << "it moves the other way";
  EXPECT_FALSE(press(4.5, 0.15, 24));
  EXPECT_TRUE(press(4.5, 0.15, 1));
}

TEST_F(Jaws, TellNoDistanceUntilTheirPlaceIsKnownAndForgetItWhenTheyAreHomedAnew) {
  EXPECT_FALSE(gripper.known());
  EXPECT_EQ(gripper.distance(), 0);
  gripper.believe(0.06, 7);
  EXPECT_TRUE(gripper.known());
  EXPECT_NEAR(gripper.distance(), 0.06, 1e-12);
  gripper.start_homing();
  EXPECT_FALSE(gripper.known());
  EXPECT_TRUE(gripper.homing());
  EXPECT_EQ(gripper.distance(), 0);
}

TEST_F(Jaws, TooMuchCurrentIsAFault) {
  gripper.believe(0.07, 0);
  EXPECT_FALSE(gripper.measure(0, 0.2));
  EXPECT_FALSE(gripper.measure(0, -0.2));
  for (const double wrong : {0.2001, -0.2001, std::numeric_limits<double>::quiet_NaN()}) {
    const auto fault = gripper.measure(0, wrong);
    ASSERT_TRUE(fault) << wrong;
    EXPECT_EQ(fault->code, FaultCode::over_current);
    EXPECT_EQ(fault->limit, 0.2);
  }
}

TEST_F(Jaws, HomingOpensUntilTheStopAndKnowsTheDistanceThen) {
  std::ignore = gripper.measure(7000, 0);
  gripper.start_homing();
  EXPECT_TRUE(gripper.homing());
  EXPECT_FALSE(gripper.known());
  EXPECT_EQ(gripper.distance(), 0) << "not known";
  double position = 70, before = gripper.set_motor();
  for (int k = 0; k < 100; ++k) {
    position += gripper.set_motor() - before;
    before = gripper.set_motor();
    EXPECT_FALSE(gripper.measure(count(position), 0.05));
    std::ignore = gripper.step();
  }
  EXPECT_NEAR((gripper.set_motor() - before) / kDt, -parameters().homing_speed, 1e-6)
      << "evenly, towards the opening";
  for (int k = 0; k < 40 && gripper.homing(); ++k) {
    EXPECT_FALSE(gripper.measure(count(position), -0.15));
    std::ignore = gripper.step();
  }
  EXPECT_FALSE(gripper.homing());
  EXPECT_TRUE(gripper.known());
  EXPECT_NEAR(gripper.distance(), distance(-2100), 1e-9);
  EXPECT_FALSE(gripper.measure(count(position) + 300, 0));
  EXPECT_NEAR(gripper.distance(), distance(-2100 + 3), 1e-9) << "counts go on from there";
}

// Twice the way from the narrowest distance to the stop: (2000 + 2100) rad at 250 rad/s, and as much again.
TEST_F(Jaws, HomingThatFindsNoStopIsAFaultWhenItLastsTooLong) {
  gripper.start_homing();
  const int most = static_cast<int>(2 * 4100 / parameters().homing_speed / kDt);
  int steps = 0;
  std::optional<Fault> fault;
  while (!fault && steps < 2 * most) {
    ++steps;
    fault = gripper.measure(count(-0.5 * steps), 0);
    std::ignore = gripper.step();
  }
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::synchro_switch_missing);
  EXPECT_NEAR(steps, most, 1);
  gripper.start_homing();
  EXPECT_FALSE(gripper.measure(count(-0.5 * steps), 0)) << "it may be tried again, for as long";
}

TEST_F(Jaws, WithoutPowerTheyStayWhereTheyAre) {
  gripper.believe(0.07, 0);
  gripper.set_distance(0.06);
  for (int k = 0; k < 50; ++k) follow();
  const double here = gripper.set_motor() + 10;
  EXPECT_FALSE(gripper.measure(count(here), 0));
  gripper.braked();
  EXPECT_NEAR(gripper.set_motor(), here, 0.01);
  EXPECT_FALSE(gripper.measure(count(here), 0));
  EXPECT_NEAR(gripper.step(), 0, 0.5) << "nothing of the duty cycle is left";
  for (int k = 0; k < 50; ++k) EXPECT_NEAR(follow(), here, 0.02) << "the goal is given up";
}

TEST_F(Jaws, WithThePowerBackTheyPressAgainWhatTheyHeld) {
  gripper.believe(0.07, 0);
  gripper.set_distance(0.06);
  EXPECT_TRUE(press(0, 0.15, 26));
  gripper.braked();
  for (int k = 0; k < 50; ++k) {
    std::ignore = gripper.measure(0, 0.12);
    std::ignore = gripper.step();
  }
  EXPECT_GT(gripper.set_motor(), 4) << "the goal is still 0.06 m";
}

TEST_F(Jaws, WithoutPowerHomingEnds) {
  gripper.start_homing();
  gripper.braked();
  EXPECT_FALSE(gripper.homing());
  EXPECT_FALSE(gripper.known());
  std::ignore = gripper.measure(0, 0);
  std::ignore = gripper.step();
  EXPECT_EQ(gripper.set_motor(), 0) << "an unknown gripper moves nowhere";
}

TEST_F(Jaws, ACounterThatWrapsIsNoJump) {
  gripper.believe(0.07, std::numeric_limits<std::int32_t>::max() - 50);
  EXPECT_FALSE(gripper.measure(std::numeric_limits<std::int32_t>::min() + 49, 0));
  EXPECT_NEAR(gripper.distance(), distance(1), 1e-9);
}

TEST(JawParameters, ThatMakeNoSenseAreRefused) {
  const auto refused = [](auto change) {
    GripperParameters p = parameters();
    change(p);
    try {
      const Gripper gripper(p, kDt);
    } catch (const FaultError& e) {
      return e.fault().code == FaultCode::bad_configuration;
    }
    return false;
  };
  EXPECT_FALSE(refused([](GripperParameters&) {}));
  EXPECT_TRUE(refused([](GripperParameters& p) { p.distance = nullptr; }));
  EXPECT_TRUE(refused([](GripperParameters& p) { p.motor = nullptr; }));
  EXPECT_TRUE(refused([](GripperParameters& p) { p.legal = {0.05, 0.05}; }));
  for (double GripperParameters::*const number :
       {&GripperParameters::increments_per_rad, &GripperParameters::speed, &GripperParameters::opening_speed,
        &GripperParameters::acceleration, &GripperParameters::homing_speed, &GripperParameters::max_current,
        &GripperParameters::stiffness, &GripperParameters::current_gain})
    for (const double wrong : {0., -1.})
      EXPECT_TRUE(refused([&](GripperParameters& p) { p.*number = wrong; }));
  for (const int wrong : {-1, 0, 65})
    EXPECT_TRUE(refused([&](GripperParameters& p) { p.blocked_steps = wrong; }));
  for (const int right : {1, 64})
    EXPECT_FALSE(refused([&](GripperParameters& p) { p.blocked_steps = right; }));
}

TEST(JawDistance, EveryLegalOneIsTakenAndTheNearestLimitIsTold) {
  const GripperParameters p = parameters();
  for (const double good : {0.05, 0.07, 0.09, 0.}) EXPECT_FALSE(check_distance(p, good)) << good;
  EXPECT_EQ(check_distance(p, 0.0499)->limit, 0.05);
  EXPECT_EQ(check_distance(p, 0.0901)->limit, 0.09);
  EXPECT_EQ(check_distance(p, 0.0901)->value, 0.0901);
  EXPECT_EQ(check_distance(p, 0.0901)->text.view(), "distance of the jaws [m], legal 0.05 to 0.09");
}

}  // namespace
}  // namespace mrroc::edp
