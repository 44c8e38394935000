// Rest of a robot whose driver is dead: detected from its encoders, from the end of the driver's commands on.
#include "sim/shell/driverless_robot.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace mrroc::sim {
namespace {

constexpr std::int64_t kDeath = 1000;  // step
constexpr auto kSettled = static_cast<int>(edp::StandstillDetector::kSettled);

/// Passes so many steps in which an axis turns by so many increments each.
void pass(DriverlessRobot& robot, std::int64_t& step, std::int32_t& encoder, int steps, int speed) {
  for (int k = 0; k < steps; ++k) {
    encoder += speed;
    robot.step(step++, std::array{0, 0, encoder, 0}, true);
  }
}

TEST(DriverlessRobot, RestsWhenItsEncodersHaveStoodAndTellsHowLongThatTookFromTheDeathOn) {
  DriverlessRobot robot;
  std::int64_t step = kDeath;
  std::int32_t encoder = 50'000;
  EXPECT_FALSE(robot.at_rest()) << "it has a driver";
  pass(robot, step, encoder, 30, 10);
  EXPECT_FALSE(robot.at_rest());
  pass(robot, step, encoder, kSettled, 0);
  EXPECT_FALSE(robot.at_rest());
  pass(robot, step, encoder, 1, 0);
  EXPECT_TRUE(robot.at_rest());
  EXPECT_EQ(robot.stop_steps(), 30);
}

TEST(DriverlessRobot, ThatStoodAlreadyNeedsNoStep) {
  DriverlessRobot robot;
  std::int64_t step = kDeath;
  std::int32_t encoder = -7;
  pass(robot, step, encoder, kSettled + 1, 0);
  EXPECT_TRUE(robot.at_rest());
  EXPECT_EQ(robot.stop_steps(), 0);
}

TEST(DriverlessRobot, DoesNotRestBeforeItsDrivesBrake) {
  DriverlessRobot robot;
  for (std::int64_t step = 0; step < 2 * kSettled; ++step) robot.step(step, {}, false);
  EXPECT_FALSE(robot.at_rest());
}

}  // namespace
}  // namespace mrroc::sim
