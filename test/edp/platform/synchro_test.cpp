// SYNCHRO: what is found at rest, and why it may fail.
#include <gtest/gtest.h>

#include <cmath>

#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

TEST(Synchro, FindsWhereThePlatformIs) {
  PlatformRig rig;
  EXPECT_FALSE(rig.wait(20).position_known);
  ASSERT_TRUE(rig.synchronise());
  const PlatformReply reply = rig.wait(1);
  EXPECT_TRUE(reply.position_known);
  EXPECT_NEAR(reply.estimate.p.x, rig.ground.p.x, 1e-6);
  EXPECT_NEAR(reply.estimate.p.y, rig.ground.p.y, 1e-6);
  EXPECT_NEAR(reply.estimate.p.phi, rig.ground.p.phi, 1e-6);
  EXPECT_NEAR(rig.driver.estimate().mass, kMass, 1e-6) << "weighed";
  EXPECT_NEAR(reply.load[0], kMass * 9.81 / 4, 1e-6);
}

TEST(Synchro, TheDrivesBrakeUntilSomebodyWantsThePlatformToMove) {
  PlatformRig rig;
  rig.after_each_step = [&] { EXPECT_FALSE(rig.last.enabled); };
  ASSERT_TRUE(rig.synchronise());
  rig.wait(50);
}

TEST(Synchro, ResetsTheImuOnceAndMeasuresItsDriftAfterwards) {
  PlatformRig rig;
  int resets = 0;
  rig.after_each_step = [&] { resets += rig.last.imu_reset; };
  ASSERT_TRUE(rig.synchronise());
  EXPECT_EQ(resets, 1);
  EXPECT_LT(std::abs(rig.ground.reading().yaw), 0.01);
}

TEST(Synchro, TakesTheMeanOfSeveralPositions) {
  PlatformRig rig;
  const PlanarPose p = rig.ground.p;
  rig.macrostep(rig.command(Instruction::synchro));
  for (int k = 0; k < 300 && rig.driver.state() == DriverState::homing; ++k) {
    PlatformCommand c = rig.keep();
    c.map.p.x = p.x + (rig.map.step / 50 % 2 == 0 ? 0.01 : -0.01);
    rig.macrostep(c);
  }
  ASSERT_EQ(rig.driver.state(), DriverState::ready);
  EXPECT_NEAR(rig.driver.estimate().estimate.p.x, p.x, 0.003);
}

TEST(Synchro, BeginsAnewWhenThePlatformIsPushed) {
  PlatformRig rig;
  int resets = 0;
  rig.after_each_step = [&] { resets += rig.last.imu_reset; };
  rig.macrostep(rig.command(Instruction::synchro));
  rig.wait(8);
  rig.ground.push = 20;
  rig.wait(3);
  rig.ground.push = 0;
  ASSERT_TRUE(rig.reach(DriverState::ready));
  EXPECT_GE(resets, 2);
  EXPECT_NEAR(rig.driver.estimate().estimate.p.x, rig.ground.p.x, 1e-3) << "no position of before is used";
}

void expect_fault(PlatformRig& rig, FaultCode code) {
  rig.macrostep(rig.command(Instruction::synchro));
  EXPECT_TRUE(rig.reach(DriverState::faulted, 110)) << to_string(code);
  EXPECT_EQ(rig.driver.fault().code, code) << rig.driver.fault().text.view();
  EXPECT_FALSE(rig.driver.synchronised());
  EXPECT_EQ(rig.macrostep(rig.command(Instruction::reset)).state, DriverState::not_synchronised);
}

TEST(Synchro, WithoutPositionsItFailsInTime) {
  PlatformRig rig;
  rig.map_seen = false;
  expect_fault(rig, FaultCode::position_unknown);
}

TEST(Synchro, PositionsThatContradictOneAnotherAreNotBelieved) {
  PlatformRig rig;
  rig.macrostep(rig.command(Instruction::synchro));
  for (int k = 0; k < 110 && rig.driver.state() == DriverState::homing; ++k) {
    PlatformCommand c = rig.keep();
    c.map.p.x += static_cast<double>(c.map.step / 50 % 3);
    rig.macrostep(c);
  }
  EXPECT_EQ(rig.driver.fault().code, FaultCode::position_unknown);
  EXPECT_EQ(rig.driver.fault().limit, PlatformSynchronisation::kPoses);
}

TEST(Synchro, APlatformThatNeverRestsIsNotSynchronised) {
  PlatformRig rig;
  rig.ground.push = 15;
  expect_fault(rig, FaultCode::position_unknown);
}

TEST(Synchro, WithoutItsSensorsItFails) {
  PlatformRig silent;
  silent.ground.imu_silent = true;
  expect_fault(silent, FaultCode::sensor_silent);
  PlatformRig loads;
  loads.ground.load_silent = true;
  expect_fault(loads, FaultCode::sensor_silent);
  PlatformRig hanging;
  hanging.ground.load_scale = -1;
  expect_fault(hanging, FaultCode::sensor_silent);
}

TEST(Synchro, ASessionThatEndsEndsIt) {
  PlatformRig rig;
  rig.macrostep(rig.command(Instruction::synchro));
  rig.driver.drop_owner();
  rig.wait(1);
  EXPECT_EQ(rig.driver.state(), DriverState::not_synchronised);
}

TEST(Synchro, OneThatItsSessionHasLeftInAnyMacrostepCannotFailAnyMore) {
  constexpr int kMost = 200;  // macrosteps
  int left = 0;
  for (;; ++left) {
    ASSERT_LT(left, kMost) << "an estimator that says nothing is a failure";
    PlatformRig rig;
    rig.platform.faults.estimate_not_finite = true;
    rig.macrostep(rig.command(Instruction::synchro));
    rig.wait(left);
    if (rig.driver.state() != DriverState::homing) break;
    rig.driver.drop_owner();
    for (int k = 0; k < 10; ++k) {
      rig.quiet();
      ASSERT_EQ(rig.driver.state(), DriverState::not_synchronised) << "left after " << left;
      ASSERT_FALSE(rig.driver.fault()) << "left after " << left;
    }
  }
  EXPECT_GT(left, 10) << "it has been left while it waited and while the estimator failed";
}

TEST(Synchro, MayBeRepeatedAfterAFault) {
  PlatformRig rig;
  rig.map_seen = false;
  expect_fault(rig, FaultCode::position_unknown);
  rig.map_seen = true;
  rig.number = 0;
  EXPECT_TRUE(rig.synchronise());
}

}  // namespace
}  // namespace mrroc::edp::test
