// The conveyor in the simulated cell, with its real driver: homing, limits, stop, and the sheets that go with it.
#include <gtest/gtest.h>

#include <algorithm>

#include "edp/driver.hpp"
#include "robots/conveyor/conveyor.hpp"
#include "sim/world.hpp"

namespace mrroc::conveyor {
namespace {

constexpr double kMacrostep = 0.02;  // [s]

/// The belt alone, with its driver.
class Belt : public testing::Test {
 protected:
  static sim::WorldParameters world_parameters() {
    sim::WorldParameters w;
    w.arms = {sim::arm_parameters(type())};
    return w;
  }
  static edp::DriverParameters driver_parameters(edp::Synchronisation how) {
    edp::DriverParameters p;
    p.synchronisation = how;
    p.synchro_joints = AxisVector::Zero(1);
    p.homing = type().driver.homing;
    p.force.weight = type().driver.tool_weight;
    return p;
  }

  explicit Belt(edp::Synchronisation how = edp::Synchronisation::known_pose)
      : world_(world_parameters(), 5), driver_(robot_, driver_parameters(how)) {
    give({.instruction = Instruction::synchro});
  }

  /// One macrostep. @return the state of the driver after it
  DriverState give(EffectorCommand command) {
    if (command.instruction != Instruction::keep) ++number_;
    command.session = 1;
    command.number = number_;
    driver_.take(command);
    do {
      const std::array commands{driver_.step(world_.reading(0))};
      if (driver_.reply_due()) reply_ = driver_.reply();
      world_.step(commands);
    } while (!driver_.at_boundary());
    return driver_.state();
  }
  /// Moves so fast along y of E for so many macrosteps, of which the first ones lead to that speed: motors need time.
  void move(double velocity, int macrosteps) {
    EffectorCommand c{.instruction = Instruction::set};
    c.set = static_cast<std::uint8_t>(mrroc::Part::arm);
    c.arm.frame = {.x = u(), .y = u(velocity), .z = u(), .ax = u(), .ay = u(), .az = u()};
    for (int k = 0; k < macrosteps; ++k) {
      constexpr double kChange = 0.04;  // [m/s]
      velocity_ += std::clamp(velocity - velocity_, -kChange, kChange);
      c.arm.frame.y.velocity = velocity_;
      give(c);
    }
  }
  void rest(int macrosteps) {
    for (int k = 0; k < macrosteps; ++k) give({});
  }
  [[nodiscard]] double way() const { return world_.truth(0).joints[0]; }

  Conveyor robot_;
  sim::World world_;
  edp::Driver driver_;
  EffectorReply reply_;
  std::int64_t number_{};
  double velocity_{};  // of the last command [m/s]
};

TEST_F(Belt, RunsAsFastAsItIsCommandedAndAgainstYOfE) {
  rest(10);
  move(-0.1, 50);
  const double before = way();
  move(-0.1, 50);
  EXPECT_NEAR(way() - before, 0.1 * 50 * kMacrostep, 1e-4);
  EXPECT_EQ(reply_.verdict, Verdict::executed);
}

TEST_F(Belt, ComesToRestWithinTheStopStepsWhenCommandsEnd) {
  rest(10);
  move(-0.1, 25);
  rest(5);  // 40 steps of deceleration, and the servo's rest
  const double stopped = way();
  rest(50);
  EXPECT_NEAR(way(), stopped, 1e-4);
  EXPECT_EQ(driver_.state(), DriverState::holding);
}

TEST_F(Belt, StopsBeforeTheEndOfItsRangeAndTellsWhy) {
  rest(10);
  move(-0.1, 700);  // 1.4 m, of which there is one
  EXPECT_LT(way(), kWay + 1e-3);
  EXPECT_GT(way(), kWay - 0.05);
  EXPECT_NE(reply_.fault.code, FaultCode::none);
}

TEST_F(Belt, RefusesSpeedsBeyondItsMotor) {
  rest(10);
  move(-0.2, 3);
  EXPECT_NEAR(way(), 0, 0.01);
  EXPECT_NE(reply_.fault.code, FaultCode::none);
}

TEST_F(Belt, BrakesByItselfWhenItsDriverIsDead) {
  rest(10);
  move(-0.1, 25);
  for (int step = 0; step < 500; ++step) world_.step({});
  const double stopped = way();
  for (int step = 0; step < 500; ++step) world_.step({});
  EXPECT_NEAR(way(), stopped, 1e-4);
  EXPECT_LT(stopped, 0.1);
}

class HomedBelt : public Belt {
 protected:
  HomedBelt() : Belt(edp::Synchronisation::homing) {}
};

TEST_F(HomedBelt, FindsItsTruePosition) {
  constexpr int kMost = 3000;  // macrosteps: a minute
  int k = 0;
  while (driver_.state() == DriverState::homing && ++k < kMost) rest(1);
  ASSERT_LT(k, kMost);
  rest(20);
  EffectorCommand get{.instruction = Instruction::get};
  get.get = static_cast<std::uint8_t>(mrroc::Part::arm);
  get.get_representation = Representation::joints;
  give(get);
  EXPECT_NEAR(reply_.pose[0], way(), 2e-6);
}

}  // namespace
}  // namespace mrroc::conveyor
