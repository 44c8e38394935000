#include "sim/motor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/irb6/robot_type.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {
namespace {

MotorParameters a_motor() { return arm_parameters(irb6::postument()).motors[2]; }

TEST(Motor, FullVoltageDrivesTheFreeShaftAtSupplyOverK) {
  const MotorParameters m = a_motor();
  EXPECT_NEAR(motor_current(m, 255, 48 / 0.105), 0, 1e-9);
  EXPECT_NEAR(motor_current(m, 1000, 0), 48 / m.resistance, 1e-9) << "the duty cycle is clipped";
}

TEST(Motor, ShortCircuitBrakesIt) { EXPECT_LT(motor_torque(a_motor(), motor_current(a_motor(), 0, 10)), 0); }

TEST(Motor, SpeedFollowsVoltageWithTheMechanicalTimeConstant) {
  const MotorParameters m = a_motor();
  const double inertia = 3e-4, h = 1e-5, tau = mechanical_time_constant(m, inertia);
  double speed = 0;
  for (double t = 0; t < tau; t += h) speed += h / inertia * motor_torque(m, motor_current(m, 100, speed));
  EXPECT_NEAR(speed / (48 * 100 / 255.0 / 0.105), 1 - std::exp(-1), 1e-3);
}

TEST(Motor, ItsTorqueGrowsNoFurtherThanTheDriveLimitsTheCurrentTo) {
  MotorParameters m = a_motor();
  m.current_limit = 3;
  double before = -1;
  for (const double pwm : {-200.0, -30.0, -10.0, 0.0, 10.0, 30.0, 200.0}) {
    const double free = motor_current(m, pwm, 2);
    const LimitedCurrent in = limited_current(m, free);
    EXPECT_EQ(in.limited, std::abs(free) > 3) << pwm;
    EXPECT_EQ(in.current, in.limited ? std::copysign(3, free) : free);
    EXPECT_GE(motor_torque(m, in.current), before);
    before = motor_torque(m, in.current);
  }
  EXPECT_FALSE(limited_current(MotorParameters{}, 1e9).limited) << "without a limit";
}

TEST(ShaftFriction, IsCoulombsInMotionAndAgainstIt) {
  const MotorParameters m = a_motor();
  for (const double speed : {-20.0, -0.5, 0.5, 20.0}) {
    ShaftFriction friction;
    double torque = 0;
    for (int k = 0; k < 5000; ++k) torque = friction.step(m, speed, 1e-3);
    EXPECT_NEAR(torque, speed > 0 ? -m.friction : m.friction, 1e-6);
  }
}

TEST(ShaftFriction, NeverGivesEnergyOverACycle) {
  const MotorParameters m = a_motor();
  ShaftFriction friction;
  double work = 0;
  for (int k = 0; k < 20000; ++k) {
    const double speed = 3 * std::sin(0.01 * k) + 0.5 * std::sin(0.173 * k);
    work += friction.step(m, speed, 1e-3) * speed * 1e-3;
    EXPECT_LT(work, m.friction * m.presliding);
  }
  EXPECT_LT(work, -0.1);
}

TEST(Encoder, CountsWholeIncrementsFromPowerUp) {
  const double per_rad = 4000 / (2 * 3.14159265358979);
  for (const double phase : {0.0, 0.3, 0.999}) {
    const Encoder encoder(per_rad, phase);
    EXPECT_EQ(encoder.count(0), 0);
    EXPECT_EQ(encoder.count(10 / per_rad), 10);
    EXPECT_EQ(encoder.count((1.001 - phase) / per_rad), 1);
    EXPECT_EQ(encoder.count((-0.001 - phase) / per_rad), -1);
  }
}

}  // namespace
}  // namespace mrroc::sim
