#include "sim/world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/statistics.hpp"
#include "test/rig/engines.hpp"
#include "test/rig/irb6_cell.hpp"
#include "test/sim/driver.hpp"

namespace mrroc::sim {
namespace {

constexpr double kRest = 0.0005;           // slower is at rest [m/s]
constexpr double kRestTurn = kRest / 0.2;  // the same 0.2 m from the axis [rad/s]

/// What holds with every engine.
class EveryEngine : public testing::TestWithParam<PhysicsEngine> {
 protected:
  static WorldParameters irb6_cell() {
    WorldParameters p = rig::irb6_cell();
    p.engine = GetParam();
    return p;
  }
  static WorldParameters one_arm() {
    WorldParameters p = irb6_cell();
    p.arms.resize(1);
    return p;
  }
};

INSTANTIATE_TEST_SUITE_P(World, EveryEngine, testing::ValuesIn(rig::engines()), rig::engine_name);

TEST_P(EveryEngine, BeginsWithPensUprightAboveTheMiddleOfTheirSheets) {
  const World world(irb6_cell());
  ASSERT_EQ(world.arms(), 2);
  for (int arm = 0; arm < 2; ++arm) {
    const ArmTruth& truth = world.truth(arm);
    EXPECT_LT((truth.T_0E.p - Vector3(0.90, 0, 0.94)).norm(), 1e-9);
    EXPECT_LT((truth.T_0E.R.col(2) - Vector3(0, 0, -1)).norm(), 1e-9);
    EXPECT_NEAR(truth.pen_height, 0.02, 1e-9);
    EXPECT_EQ(world.reading(arm).step, 0);
    EXPECT_EQ(world.reading(arm).encoder, (std::array<std::int32_t, kMaxAxes>{}));
  }
}

TEST_P(EveryEngine, BodiesAgreeWithTheKinematicsOfTheRobots) {
  Cell cell(irb6_cell());
  cell.drivers[0].command = {u(0.02), u(-0.03), u(0.01), u(0.2), u(-0.1), u(0.3)};
  cell.drivers[1].command = {u(-0.02), u(0.03), u(-0.01), u(-0.2), u(0.1), u(-0.3)};
  cell.run(1000);
  for (int arm = 0; arm < 2; ++arm) {
    const auto robot = irb6::make_arm(arm == 0 ? "irb6_postument" : "irb6_track");
    const ArmTruth& truth = cell.world.truth(arm);
    const Pose T_0E = robot->forward(truth.joints) * robot->tool_in_wrist();
    EXPECT_LT((T_0E.p - truth.T_0E.p).norm(), 1e-9);
    EXPECT_LT((T_0E.R - truth.T_0E.R).norm(), 1e-9);
    EXPECT_GT((truth.T_0E.p - Vector3(0.90, 0, 0.94)).norm(), 0.05);
  }
}

TEST_P(EveryEngine, BrakesHoldTheArmsWithoutDrift) {
  World world(irb6_cell());
  const auto joints = world.truth(0).joints;
  for (int k = 0; k < 2000; ++k) world.step({});
  for (int arm = 0; arm < 2; ++arm) {
    EXPECT_LT(world.truth(arm).tip_velocity.norm(), 1e-9);
    EXPECT_NEAR(world.truth(arm).pen_height, 0.02, 1e-7);
  }
  EXPECT_LT((world.truth(0).joints - joints).norm(), 1e-7);
}

TEST_P(EveryEngine, DrivesBrakeToRestByThemselvesWhenCommandsStop) {
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    Cell cell(irb6_cell());
    for (Driver& driver : cell.drivers) driver.command[axis] = u(-0.05);
    cell.run(500);
    ASSERT_GT(cell.world.truth(0).tip_velocity.norm(), 0.045);
    int moved = 0;
    for (int k = 0; k < 300; ++k) {
      cell.world.step({});
      for (int arm = 0; arm < 2; ++arm)
        if (cell.world.truth(arm).tip_velocity.norm() > kRest) moved = k + 1;
    }
    EXPECT_LT(moved, 50);
  }
}

TEST_P(EveryEngine, ATurnAboutTheTipIsSeenInTheTurnOfTheToolAndBrakedToRestToo) {
  Cell cell(irb6_cell());
  for (Driver& driver : cell.drivers) driver.command.az = u(0.2);
  cell.run(500);
  for (int arm = 0; arm < 2; ++arm) {
    const ArmTruth& truth = cell.world.truth(arm);
    EXPECT_LT((truth.tool_turn - 0.2 * truth.T_0E.R.col(2)).norm(), 0.02);
    EXPECT_LT(truth.tip_velocity.norm(), 0.005);
  }
  int moved = 0;
  for (int k = 0; k < 300; ++k) {
    cell.world.step({});
    for (int arm = 0; arm < 2; ++arm)
      if (cell.world.truth(arm).tool_turn.norm() > kRestTurn) moved = k + 1;
  }
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, 50);
}

TEST_P(EveryEngine, OnlyTheArmWithoutACommandBrakes) {
  Cell cell(irb6_cell());
  for (Driver& driver : cell.drivers) driver.command.x = u(0.02);
  cell.run(500);
  for (int k = 0; k < 200; ++k) {
    const HardwareCommand command = cell.drivers[0].step();
    cell.world.step({&command, 1});
  }
  EXPECT_NEAR(cell.world.truth(0).tip_velocity.norm(), 0.02, 0.003);
  EXPECT_LT(cell.world.truth(1).tip_velocity.norm(), kRest);
}

TEST_P(EveryEngine, ACommandThatIsNotFiniteBrakes) {
  World world(one_arm());
  HardwareCommand command{.enabled = true};
  command.pwm[1] = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 100; ++k) world.step({&command, 1});
  EXPECT_LT(world.truth(0).tip_velocity.norm(), kRest);
  EXPECT_NEAR(world.truth(0).pen_height, 0.02, 1e-6);
}

TEST_P(EveryEngine, EncodersFollowTheMotorsToWithinOneIncrement) {
  Cell cell(irb6_cell());
  for (Driver& driver : cell.drivers) driver.command = {u(0.02), u(0.02), u(0.01), u(0.1), u(0.1), u(0.2)};
  for (int arm = 0; arm < 2; ++arm) {
    const auto robot = irb6::make_arm(arm == 0 ? "irb6_postument" : "irb6_track");
    const AxisVector start = robot->motors_from_joints(cell.world.start_joints(arm));
    cell.run(300, [&] {
      const AxisVector motors = robot->motors_from_joints(cell.world.truth(arm).joints);
      for (int k = 0; k < robot->axes(); ++k) {
        const double exact = (motors[k] - start[k]) * robot->axis(k).increments_per_rad;
        EXPECT_NEAR(cell.world.reading(arm).encoder[static_cast<std::size_t>(k)], exact, 1);
      }
    });
  }
}

TEST_P(EveryEngine, SensorFeelsTheWeightOfTheStillToolInEveryOrientation) {
  const std::array<Twist, 3> turns{Twist::from({0, 0, -0.05}, {0.4, 0, 0}),
                                   Twist::from({0, 0, -0.05}, {0, 0.4, 0}),
                                   Twist::from({0, 0, -0.05}, {-0.3, 0.3, 0.5})};
  for (const Twist& turn : turns) {
    Cell cell(irb6_cell());
    for (Driver& driver : cell.drivers)
      for (const Axis a : kAxes) driver.command[a] = u(turn[a]);
    cell.run(1000);
    for (int k = 0; k < 500; ++k) cell.world.step({});
    for (int arm = 0; arm < 2; ++arm) {
      const auto robot = irb6::make_arm(arm == 0 ? "irb6_postument" : "irb6_track");
      const auto& table = robot->parameters();
      const ArmTruth& truth = cell.world.truth(arm);
      const Matrix3 R_0W = truth.T_0E.R * robot->tool_in_wrist().R.transpose();
      const Wrench at_G = Wrench::from(R_0W.transpose() * Vector3(0, 0, -table.tool_weight), Vector3::Zero());
      const Pose T_WG{Matrix3::Identity(), Eigen::Map<const Vector3>(table.tool_mass_centre.data())};
      const Wrench expected = xi_F(robot->sensor_in_wrist().inverse() * T_WG, at_G);
      for (const Axis a : kAxes) EXPECT_NEAR(truth.S_F[a], expected[a], 1e-4);
      EXPECT_LT(truth.T_0E.R(2, 2), 0.9 * -std::cos(0.8)) << "it did not turn";
    }
  }
}

TEST_P(EveryEngine, SensorFeelsInertialForcesOfTheTool) {
  Cell cell(one_arm());
  cell.run(500);
  cell.drivers[0].command.x = u(0.02);
  Statistics force;
  cell.run(100, [&] { force.add(cell.world.truth(0).S_F.linear().head<2>().norm()); });
  EXPECT_GT(force.most(), 1) << "1.1 kg that reach 20 mm/s within about 15 ms";
}

TEST_P(EveryEngine, PaperYieldsWithItsStiffness) {
  Cell cell(one_arm());
  cell.prepare();
  cell.drivers[0].command.z = c(4, 20, 0.005);
  cell.run(3000);
  Statistics force, depth;
  cell.run(500, [&] {
    force.add(cell.world.truth(0).paper_force);
    depth.add(-cell.world.truth(0).pen_height);
  });
  EXPECT_NEAR(force.mean(), 4, 0.1);
  EXPECT_NEAR(force.mean() / depth.mean(), 1e4, 200);
}

TEST_P(EveryEngine, ThePaperPushesWhatTheSensorFeels) {
  Cell cell(one_arm());
  cell.prepare();
  cell.drivers[0].command.z = c(4, 20, 0.005);
  cell.run(3000);
  Statistics paper, sensor;
  cell.run(500, [&] {
    paper.add(cell.world.truth(0).paper_force);
    sensor.add(10.8 - cell.world.truth(0).S_F[Axis::z]);
  });
  EXPECT_NEAR(paper.mean(), sensor.mean(), 1e-2);
}

TEST_P(EveryEngine, InkAppearsOnlyWhileThePenPressesThePaper) {
  Cell cell(one_arm());
  cell.prepare();
  std::size_t points = 0;
  const auto check = [&] {
    const auto& ink = cell.world.ink(0);
    EXPECT_EQ(ink.size() > points, cell.world.truth(0).paper_force > 0);
    const bool above = cell.world.truth(0).pen_height > 5e-5;
    EXPECT_FALSE(above && ink.size() > points);
    points = ink.size();
  };
  cell.drivers[0].command.z = g(0.02, 20, 0.005);
  cell.run(1500, check);
  EXPECT_GT(points, 0U);
  cell.drivers[0].command.z = u(-0.01);
  cell.run(500, check);
  const std::size_t lifted = points;
  cell.run(200, check);
  EXPECT_EQ(points, lifted);
}

TEST_P(EveryEngine, RunsAreIdenticalToTheBitAndSeedsMatter) {
  const auto run = [](std::uint64_t seed) {
    Cell cell(irb6_cell(), seed);
    cell.prepare();
    for (Driver& driver : cell.drivers)
      driver.command = {c(0, 20, 0.005), c(0, 20, 0.005), c(1, 20, 0.005), u(), u(), u()};
    cell.world.hand(0).lead_along({{{0, 0}, {20, 10}}});
    cell.run(2000);
    return cell.world.state_hash();
  };
  const std::uint64_t first = run(1);
  EXPECT_EQ(run(1), first);
  EXPECT_NE(run(2), first);
}

TEST_P(EveryEngine, ResetBeginsAnew) {
  World fresh(irb6_cell(), 4), used(irb6_cell(), 9);
  for (int k = 0; k < 50; ++k) used.step({});
  used.reset(4);
  EXPECT_EQ(used.steps(), 0);
  for (int k = 0; k < 20; ++k) {
    EXPECT_EQ(used.reading(1).S_F_m, fresh.reading(1).S_F_m);
    fresh.step({});
    used.step({});
  }
  EXPECT_EQ(used.state_hash(), fresh.state_hash());
}

TEST_P(EveryEngine, RefusesParametersThatMakeNoSense) {
  WorldParameters p = irb6_cell();
  p.substeps = 0;
  EXPECT_THROW(World{p}, std::invalid_argument);
  p = irb6_cell();
  p.arms[0].motors.pop_back();
  EXPECT_THROW(World{p}, std::invalid_argument);
  p = irb6_cell();
  p.arms[1].paper.T_0P.p.x() = 3;
  EXPECT_THROW(World{p}, std::invalid_argument);
  EXPECT_THROW(World{WorldParameters{}}, std::invalid_argument) << "no arm";
}

}  // namespace
}  // namespace mrroc::sim
