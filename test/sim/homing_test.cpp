// Homing of both simulated arms by their effector drivers: what is found is the truth.
#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "edp/driver.hpp"
#include "robots/irb6/arm.hpp"
#include "robots/irb6/homing.hpp"
#include "sim/world.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::sim {
namespace {

const std::vector<double> kFront{0, -1.57, 0, 1.56, 1.57, -1.57};
const std::vector<double> kTrackFront{0.1, 0.2, -1.45, 0.05, 1.4, 1.3, -1.8};

/// One arm of the simulator with its driver.
struct HomedArm {
  HomedArm(const World& w, int k, const char* name)
      : world(w), index(k), robot(irb6::make_arm(name)), driver(*robot, parameters()) {}

  edp::DriverParameters parameters() const {
    edp::DriverParameters p;
    p.synchronisation = edp::Synchronisation::homing;
    p.homing = irb6::homing_of(robot->parameters());
    p.T_WE = robot->tool_in_wrist();
    p.force.T_WS = robot->sensor_in_wrist();
    return p;
  }
  HardwareCommand step() {
    if (driver.at_boundary()) {
      EffectorCommand c;
      c.session = c.number = 1;
      if (!sent) c.instruction = Instruction::synchro;
      sent = true;
      driver.take(c);
    }
    return driver.step(world.reading(index));
  }

  const World& world;
  int index;
  std::unique_ptr<irb6::Arm> robot;
  edp::Driver driver;
  bool sent{};
};

class Homing : public testing::Test {
 protected:
  Homing() {
    parameters_.arms[0].start = kFront;
    parameters_.arms[1].start = kTrackFront;
  }

  /// Runs until no arm is homing any more.
  void home() {
    world_ = std::make_unique<World>(parameters_, 3);
    arms_.push_back(std::make_unique<HomedArm>(*world_, 0, "irb6_postument"));
    arms_.push_back(std::make_unique<HomedArm>(*world_, 1, "irb6_track"));
    constexpr int kMost = 200'000;
    constexpr int kSettle = 200;
    int done = 0;
    for (int k = 0; k < kMost && done < kSettle; ++k) {
      const std::array commands{arms_[0]->step(), arms_[1]->step()};
      world_->step(commands);
      done += k > 0 && state(0) != DriverState::homing && state(1) != DriverState::homing;
    }
    ASSERT_EQ(done, kSettle) << "homing does not end";
  }
  DriverState state(std::size_t arm) const { return arms_[arm]->driver.state(); }

  WorldParameters parameters_{rig::irb6_cell()};
  std::unique_ptr<World> world_;
  std::vector<std::unique_ptr<HomedArm>> arms_;
};

TEST_F(Homing, FindsTheTrueJointsOfBothArms) {
  home();
  for (std::size_t k = 0; k < arms_.size(); ++k) {
    const HomedArm& arm = *arms_[k];
    ASSERT_EQ(state(k), DriverState::ready) << describe(arm.driver.fault());
    const AxisVector& truth = world_->truth(arm.index).joints;
    const AxisVector motors = arm.robot->motors_from_joints(truth);
    for (int axis = 0; axis < arm.robot->axes(); ++axis)
      EXPECT_NEAR(arm.driver.reply().motors[static_cast<std::size_t>(axis)], motors[axis],
                  2.5 / arm.robot->axis(axis).increments_per_rad)
          << axis;
    // Near the place where the motors read 0, as in the original.
    EXPECT_LT((truth - arm.robot->synchronised()).cwiseAbs().maxCoeff(), 0.1);
  }
}

TEST_F(Homing, DoesNotFindAnErrorOfTheZeroPositions) {
  const double error = 0.01;
  parameters_.arms[0].links = {{.link = "wrist_fork", .zero_error = error},
                               {.link = "wrist", .zero_error = -error}};
  home();
  const HomedArm& arm = *arms_[0];
  ASSERT_EQ(state(0), DriverState::ready) << describe(arm.driver.fault());
  const AxisVector told = Eigen::Map<const Eigen::VectorXd>(kFront.data(), 6);
  AxisVector start = told;
  start[3] += error;
  start[5] -= error;
  EXPECT_EQ(world_->start_joints(0), start);
  const AxisVector zero = arm.robot->motors_from_joints(start) - arm.robot->motors_from_joints(told);
  EXPECT_GT(zero.cwiseAbs().maxCoeff(), 0.5);
  const AxisVector motors = arm.robot->motors_from_joints(world_->truth(0).joints) - zero;
  for (int axis = 0; axis < arm.robot->axes(); ++axis)
    EXPECT_NEAR(arm.driver.reply().motors[static_cast<std::size_t>(axis)], motors[axis],
                2.5 / arm.robot->axis(axis).increments_per_rad)
        << axis;
}

TEST_F(Homing, MissingSwitchOfOneArmFaultsItAndNotTheOther) {
  parameters_.arms[0].switches[2].fault = SwitchFault::missing;
  parameters_.arms[1].switches[4].fault = SwitchFault::stuck;
  home();
  EXPECT_EQ(arms_[0]->driver.fault().code, FaultCode::synchro_switch_missing);
  EXPECT_EQ(arms_[0]->driver.fault().axis, 2);
  EXPECT_EQ(arms_[1]->driver.fault().code, FaultCode::synchro_switch_stuck);
  EXPECT_EQ(arms_[1]->driver.fault().axis, 4);
}

}  // namespace
}  // namespace mrroc::sim
