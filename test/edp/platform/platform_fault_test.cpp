// Malfunctions: each is found, told with its wheel or its figures, and stops the platform.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "edp/platform/failing_tracker.hpp"
#include "edp/platform/follower.hpp"
#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

/// A platform that drives straight on, 0.5 m/s.
struct Malfunction : testing::Test {
  PlatformRig rig;
  void SetUp() override {
    ASSERT_TRUE(rig.synchronise());
    Way way = rig.way();
    rig.macrostep(rig.set(way.next(0.5, 0, 40)));
    for (int k = 0; k < 5; ++k) rig.macrostep(rig.set(way.next(0.5, 0, 300)));
    rig.wait(50);
    ASSERT_EQ(rig.driver.state(), DriverState::executing);
  }
  /// Expects the fault within some macrosteps, and that the drives brake at once until the platform stands, all but one of
  /// which the encoder may be wrong.
  void expect(FaultCode code, int axis, int within) {
    int macrosteps = 0;
    for (; macrosteps < within && rig.driver.state() != DriverState::faulted; ++macrosteps) rig.wait(1);
    ASSERT_EQ(rig.driver.state(), DriverState::faulted) << to_string(code);
    EXPECT_EQ(rig.driver.fault().code, code) << rig.driver.fault().text.view();
    EXPECT_EQ(rig.driver.fault().axis, axis);
    EXPECT_EQ(class_of(code), FaultClass::fatal);
    const bool of_a_wheel = code == FaultCode::wheel_blocked || code == FaultCode::encoder_fault;
    rig.after_each_step = [this, axis, of_a_wheel] {
      for (std::size_t k = 0; k < kWheels; ++k) {
        EXPECT_LE(rig.last.torque[k], 1.3) << "it drove forwards; at rest a wheel plays by an increment";
        EXPECT_GE(rig.last.torque[k], -kBrakingTorque);
        if (of_a_wheel && static_cast<int>(k) == axis) {
          EXPECT_EQ(rig.last.torque[k], 0);
        }
      }
    };
    const PlatformReply reply = rig.wait(30);
    EXPECT_EQ(reply.fault.code, code);
    EXPECT_EQ(reply.executing, 0);
    EXPECT_LT(std::abs(rig.ground.v), 0.01);
    rig.after_each_step = {};
    rig.wait(60);
    EXPECT_FALSE(rig.last.enabled) << "short-circuited";
  }
};

TEST_F(Malfunction, ATrackerThatFailsAFewTimesIsCountedAndItsPlanGoesOn) {
  const PerWheel torque = rig.last.torque;
  rig.platform.faults.tracker_fails = true;
  const PlatformReply reply = rig.wait(4);
  EXPECT_EQ(reply.state, DriverState::executing);
  EXPECT_EQ(reply.solver_failures, 4);
  for (std::size_t k = 0; k < kWheels; ++k) EXPECT_NEAR(reply.torque[k], torque[k], 1) << "as was planned";
  rig.platform.faults.tracker_fails = false;
  EXPECT_EQ(rig.wait(20).state, DriverState::executing);
}

TEST_F(Malfunction, ATrackerThatGoesOnFailingStopsThePlatform) {
  rig.platform.faults.tracker_fails = true;
  expect(FaultCode::solver_failed, -1, 5);
}

TEST(Follower, APlanIsForgottenWhenAnotherWayBegins) {
  FakePlatform platform;
  Follower follower(platform.tracker("plain"), platform.properties());
  EstimatorResult x;
  Reference ahead{};
  for (PathPoint& point : ahead) point.p.x = 1;
  follower.begin(x);
  EXPECT_FALSE(follower.step(x, {}, {}, ahead));
  EXPECT_GT(follower.torque()[0], 1);
  x.estimate.p = {1, 2, 3};
  follower.begin(x);
  platform.faults.tracker_fails = true;
  EXPECT_FALSE(follower.step(x, {}, {}, ahead));
  EXPECT_EQ(follower.torque(), PerWheel{}) << "nothing has been planned";
  EXPECT_EQ(follower.result().torque, PerWheel{});
  EXPECT_EQ(follower.result().health.iterations, 0);
  for (const PlanarPose& p : follower.result().horizon) EXPECT_EQ(p.x, 1) << "it stands there";
}

TEST_F(Malfunction, ATrackerThatFailsOnPurposeDoesSoInItsStepsOnly) {
  const std::int64_t now = rig.wait(1).estimate.step;
  FailingTracker tracker(rig.platform.tracker(rig.platform.trackers().front()),
                         {.from = now + 10, .to = now + 30});
  EstimatorResult x;
  const std::array<PathPoint, kHorizonPoints> reference{};
  tracker.begin(x);
  for (int k = 0; k < 5; ++k) {
    x.estimate.step = now + 10 * k;
    const Health health = tracker.step(x, {}, {}, reference).health;
    EXPECT_EQ(health.solver_failed, k == 1 || k == 2) << k;
    EXPECT_EQ(health.ok, !health.solver_failed) << k;
  }
}

TEST_F(Malfunction, TorquesThatAreNoneAreNeverSent) {
  rig.after_each_step = [this] {
    for (const double torque : rig.last.torque) EXPECT_LE(std::abs(torque), kMaxTorque);
  };
  rig.platform.faults.torque_not_finite = true;
  rig.wait(3);
  rig.platform.faults.torque_not_finite = false;
  rig.platform.faults.torque_too_large = true;
  expect(FaultCode::solver_failed, -1, 5);
}

TEST_F(Malfunction, AnEstimatorThatGoesOnFailingStopsThePlatform) {
  rig.platform.faults.estimator_fails = true;
  EXPECT_EQ(rig.wait(4).solver_failures, 4);
  expect(FaultCode::estimate_lost, -1, 1);
}

TEST_F(Malfunction, AnEstimateThatIsNotFiniteIsNeverUsed) {
  rig.platform.faults.estimate_not_finite = true;
  EXPECT_TRUE(std::isfinite(rig.wait(3).estimate.p.x));
  expect(FaultCode::estimate_lost, -1, 2);
}

TEST_F(Malfunction, AnUncertainPositionIsLost) {
  rig.platform.faults.sd = 0.45;
  EXPECT_EQ(rig.wait(50).state, DriverState::executing);
  rig.platform.faults.sd = 0.55;
  expect(FaultCode::estimate_lost, -1, 1);
  EXPECT_FALSE(rig.driver.synchronised());
}

TEST_F(Malfunction, PositionsThatContradictTheEstimateForLongLoseIt) {
  rig.platform.faults.inconsistent = true;
  EXPECT_EQ(rig.wait(24 * 5).state, DriverState::executing) << "a pose every five macrosteps";
  expect(FaultCode::estimate_lost, -1, 10);
}

TEST_F(Malfunction, ABlockedWheelIsFound) {
  rig.ground.blocked[1] = true;
  expect(FaultCode::wheel_blocked, 0, 60);  // the fake body stands then, so the first wheel tells
}

TEST_F(Malfunction, AnEncoderThatStandsStillIsFound) {
  rig.ground.encoder_stuck[2] = true;
  int macrosteps = 0;
  for (; macrosteps < 60 && rig.driver.state() != DriverState::faulted; ++macrosteps) rig.wait(1);
  EXPECT_TRUE(rig.driver.fault().code == FaultCode::encoder_fault ||
              rig.driver.fault().code == FaultCode::wheel_blocked);
  EXPECT_EQ(rig.driver.fault().axis, 2);
}

/// A wheel that stands while the platform is to be slow.
struct SlowMalfunction : testing::Test {
  PlatformRig rig;
  void SetUp() override {
    ASSERT_TRUE(rig.synchronise());
    Way way = rig.way();
    for (int k = 0; k < 6; ++k) rig.macrostep(rig.set(way.next(kSlowest, 0, 300)));
    rig.wait(300);
    ASSERT_EQ(rig.driver.state(), DriverState::executing);
  }
  static constexpr double kSlowest = 0.05;  // [m/s], of a plan
};

TEST_F(SlowMalfunction, ABlockedWheelIsFound) {
  rig.ground.blocked[1] = true;
  rig.wait(300);
  EXPECT_EQ(rig.driver.fault().code, FaultCode::wheel_blocked);
}

TEST_F(SlowMalfunction, AnEncoderThatStandsStillIsFound) {
  rig.ground.encoder_stuck[2] = true;
  rig.wait(300);
  EXPECT_EQ(rig.driver.state(), DriverState::faulted);
  EXPECT_EQ(rig.driver.fault().axis, 2);
}

TEST_F(SlowMalfunction, NothingIsFoundOfAPlatformThatIsAsItShouldBe) {
  EXPECT_EQ(rig.wait(600).state, DriverState::executing);
}

TEST_F(Malfunction, AnEncoderThatContradictsTheEstimateIsFound) {
  rig.platform.faults.wheels_elsewhere = true;
  EXPECT_EQ(rig.wait(9).state, DriverState::executing);
  expect(FaultCode::encoder_fault, 2, 1);
}

TEST_F(Malfunction, AnImuThatIsSilentOrNoNumberIsFound) {
  rig.ground.imu_silent = true;
  rig.driver.take(rig.keep());
  rig.step();
  rig.step();
  EXPECT_EQ(rig.driver.state(), DriverState::executing);
  rig.step();
  EXPECT_EQ(rig.driver.state(), DriverState::faulted) << "with the third reading";
  EXPECT_EQ(rig.last.torque[0], -kBrakingTorque) << "in the same step";
  EXPECT_EQ(rig.driver.fault().code, FaultCode::sensor_silent);
}

TEST_F(Malfunction, AnImuWithoutNumbersIsFound) {
  rig.ground.imu_not_finite = true;
  expect(FaultCode::sensor_silent, -1, 1);
}

TEST_F(Malfunction, LoadCellsThatAreWrongStopNothing) {
  const PerWheel load = rig.wait(1).load;
  for (const double scale : {0.5, 1.5, -3.}) {
    rig.ground.load_scale = scale;
    const PlatformReply reply = rig.wait(20);
    EXPECT_EQ(reply.state, DriverState::executing);
    EXPECT_NEAR(reply.load[2], load[2], 1e-6) << "as at rest";
  }
}

// Short-circuited motors fade with the speed: from 0.5 m/s these would need 100 steps and more for the last millimetres.
TEST_F(Malfunction, AnEmergencyStopBrakesByTorquesUntilTheWheelsStand) {
  rig.driver.trip({.code = FaultCode::emergency_stop});
  double fastest = rig.ground.v;
  int braked = 0;
  rig.after_each_step = [&] {
    braked += rig.last.enabled ? 1 : 0;
    for (const double torque : rig.last.torque) EXPECT_LE(std::abs(torque), kBrakingTorque);
    EXPECT_LE(rig.ground.v, std::max(fastest, 0.01)) << "it does not drive on";
    EXPECT_GT(rig.ground.v, -0.01) << "nor back";
    fastest = rig.ground.v;
  };
  rig.step();
  EXPECT_TRUE(rig.last.enabled) << "in the next step";
  EXPECT_EQ(rig.last.torque[0], -kBrakingTorque);
  while (!rig.driver.at_boundary()) rig.step();
  const PlatformReply reply = rig.wait(30);
  EXPECT_EQ(reply.state, DriverState::faulted);
  EXPECT_EQ(reply.fault.code, FaultCode::emergency_stop);
  EXPECT_GT(braked, 50);
  EXPECT_LT(braked, 180);
  EXPECT_FALSE(rig.last.enabled) << "then the motors are short-circuited";
  EXPECT_LT(std::abs(rig.ground.v), 1e-3);
}

TEST_F(Malfunction, AnEmergencyStopAfterAFaultChangesNothingOfHowItBrakes) {
  rig.platform.faults.wheels_elsewhere = true;
  rig.wait(10);
  ASSERT_EQ(rig.driver.fault().code, FaultCode::encoder_fault);
  ASSERT_EQ(rig.driver.fault().axis, 2);
  rig.driver.trip({.code = FaultCode::emergency_stop});
  for (int k = 0; k < 20; ++k) {
    rig.step();
    EXPECT_EQ(rig.last.torque, PerWheel({-kBrakingTorque, -kBrakingTorque, 0, -kBrakingTorque}));
  }
}

TEST_F(Malfunction, AWheelThatBreaksDuringAnEmergencyStopBrakesNoMore) {
  rig.driver.trip({.code = FaultCode::emergency_stop});
  rig.step();
  EXPECT_EQ(rig.last.torque[1], -kBrakingTorque);
  rig.driver.trip({.code = FaultCode::encoder_fault, .axis = 1});
  rig.step();
  EXPECT_TRUE(rig.last.enabled);
  EXPECT_EQ(rig.last.torque[1], 0);
}

TEST_F(Malfunction, DrivesThatAreSilentDuringAnEmergencyStopAreLeftToThemselves) {
  rig.driver.trip({.code = FaultCode::emergency_stop});
  rig.step();
  ASSERT_TRUE(rig.last.enabled);
  rig.driver.trip({.code = FaultCode::hardware_silent});
  rig.after_each_step = [this] { EXPECT_FALSE(rig.last.enabled); };
  for (int k = 0; k < 50; ++k) rig.step();
}

TEST_F(Malfunction, AnEmergencyStopDoesNotBrakeForEverWhenAWheelSeemsToTurn) {
  rig.driver.trip({.code = FaultCode::emergency_stop});
  rig.ground.push = 4 * kBrakingTorque / kRadius / kMass + 0.1;  // down a slope that the drives cannot hold
  for (int k = 0; k < WheelBrake::kLongest - 1; ++k) rig.step();
  EXPECT_TRUE(rig.last.enabled);
  rig.step();
  EXPECT_FALSE(rig.last.enabled);
}

TEST_F(Malfunction, OnlyResetLeadsOnFromWhereThePlatformIs) {
  rig.driver.trip({.code = FaultCode::emergency_stop});
  rig.wait(20);
  const PlatformReply refused = rig.macrostep(rig.set(rig.way().next(0.1, 0, 20)));
  EXPECT_EQ(refused.fault.code, FaultCode::reset_required);
  EXPECT_EQ(refused.fault.text.view(), "emergency_stop");
  EXPECT_EQ(rig.macrostep(rig.command(Instruction::reset)).state, DriverState::ready);
  rig.number = 0;
  const PlatformReply reply = rig.macrostep(rig.set(rig.way().next(0.2, 0, 20)));
  EXPECT_EQ(reply.verdict, Verdict::executed) << reply.fault.text.view();
  EXPECT_EQ(reply.accepted, 1);
}

TEST_F(Malfunction, AResetEndsTheFaultThatWasBeforeItAndNoneAfter) {
  rig.driver.trip({.code = FaultCode::emergency_stop});
  rig.wait(20);
  ASSERT_EQ(rig.macrostep(rig.command(Instruction::reset)).state, DriverState::ready);
  rig.wait(10);
  rig.driver.trip({.code = FaultCode::over_current});
  const PlatformReply reply = rig.wait(10);
  EXPECT_EQ(reply.state, DriverState::faulted);
  EXPECT_EQ(reply.fault.code, FaultCode::over_current);
  rig.number = 0;
  EXPECT_EQ(rig.macrostep(rig.command(Instruction::reset)).state, DriverState::ready)
      << "it takes another one";
}

TEST_F(Malfunction, APositionThatWasLostWantsSynchroAgain) {
  rig.platform.faults.sd = 1;
  expect(FaultCode::estimate_lost, -1, 1);
  rig.platform.faults.sd = 0.01;
  EXPECT_EQ(rig.macrostep(rig.command(Instruction::reset)).state, DriverState::not_synchronised);
  rig.number = 0;
  EXPECT_TRUE(rig.synchronise());
}

TEST_F(Malfunction, StepsThatWereMissedAreFilledInUntilTheyAreTooMany) {
  rig.ground.step += 133;
  EXPECT_EQ(rig.wait(20).state, DriverState::executing);
  rig.ground.step += 400;
  expect(FaultCode::estimate_lost, -1, 1);
}

TEST(PlatformDriverParameters, WhatMakesNoSenseIsRefusedByName) {
  const auto refused = [](auto change, const char* name) {
    PlatformDriverParameters p = PlatformRig::parameters();
    FakePlatform platform;
    change(p, platform);
    try {
      const PlatformDriver driver(platform, p);
      ADD_FAILURE() << name;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  };
  using P = PlatformDriverParameters;
  using F = FakePlatform;
  refused([](P& p, F&) { p.estimator = "bad"; }, "estimator 'bad', but plain, other");
  refused([](P& p, F&) { p.tracker = "bad"; }, "tracker");
  refused([](P& p, F&) { p.synchro_rest = 0; }, "synchro_rest");
  refused([](P& p, F&) { p.synchro_timeout = std::nan(""); }, "synchro_timeout");
  refused([](P& p, F&) { p.silence = 0; }, "silence");
  refused([](P& p, F&) { p.brake_after = 0; }, "brake_after");
  refused([](P& p, F&) { p.nominal.mu_x = 0; }, "friction");
  refused([](P& p, F&) { p.nominal.split = 1; }, "split");
  refused([](P&, F& f) { f.q.wheel_radius = 0; }, "wheel_radius");
  refused([](P&, F& f) { f.q.increments_per_turn = 0; }, "increments_per_turn");
  refused([](P&, F& f) { f.q.max_torque = -1; }, "max_torque");
  refused([](P&, F& f) { f.q.braking_torque = 21; }, "braking_torque");
  refused([](P&, F& f) { f.q.horizon_period = 0; }, "horizon_period");
}

}  // namespace
}  // namespace mrroc::edp::test
