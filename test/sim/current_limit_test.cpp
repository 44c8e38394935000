// A simulated drive limits the current of its motor: an arm that presses harder than its motors may is
// stopped where it is, and holds without a reset.
#include <gtest/gtest.h>

#include <algorithm>

#include "test/sim/pressing_arm.hpp"

namespace mrroc::sim {
namespace {

constexpr double kMore = 1;  // than what holds the arm [A]

/// @return largest current of each motor while an arm that nobody limits holds its weight [A]
std::array<double, kMaxAxes> holding_currents() {
  PressingArm arm;
  arm.prepare();
  std::array<double, kMaxAxes> most{};
  for (int k = 0; k < 10; ++k) {
    const CurrentStatistics current = arm.move({}).current;
    for (std::size_t m = 0; m < most.size(); ++m)
      most[m] = std::max({most[m], current.greatest[m], -current.least[m]});
  }
  return most;
}

TEST(CurrentLimit, AnArmThatPressesHarderThanItsMotorsMayIsStoppedWhereItIsAndHolds) {
  const std::array<double, kMaxAxes> holding = holding_currents();
  WorldParameters w = PressingArm::world_of_one();
  w.arms[0].start_height = 0.002;
  for (std::size_t m = 0; m < w.arms[0].motors.size(); ++m)
    w.arms[0].motors[m].current_limit = holding[m] + kMore;
  edp::DriverParameters p = PressingArm::driver_parameters();
  p.limits.contact_force.v.fill(1000);
  // A sensor of a range that the arms' own do not have: the motors meet their limits first.
  w.arms[0].sensor.range_xy = w.arms[0].sensor.range_z = 1000;
  w.arms[0].sensor.range_torque = 100;
  p.force.range = {{1000, 1000, 1000, 100, 100, 100}};
  PressingArm arm(w, p);
  arm.prepare();
  bool limited = false;
  arm.after_each_step = [&] {
    for (std::size_t m = 0; m < w.arms[0].motors.size(); ++m) {
      const HardwareReading& reading = arm.world.reading(0);
      EXPECT_LE(std::abs(reading.current[m]), w.arms[0].motors[m].current_limit + 1e-9);
      limited |= (reading.switches[m] & static_cast<unsigned>(AxisSwitch::current_limited)) != 0;
    }
  };
  Fault fault;
  for (int k = 0; k < 100 && !fault; ++k) fault = arm.move({u(), u(), u(0.02), u(), u(), u()}).fault;
  EXPECT_EQ(fault.code, FaultCode::excessive_torque) << describe(fault);
  EXPECT_TRUE(limited);
  EXPECT_GT(arm.force(), 10);
  for (int k = 0; k < 20 && arm.driver->state() != DriverState::holding; ++k) arm.rest();
  EXPECT_EQ(arm.driver->state(), DriverState::holding);
  EXPECT_EQ(arm.move({}).verdict, Verdict::executed);
}

}  // namespace
}  // namespace mrroc::sim
