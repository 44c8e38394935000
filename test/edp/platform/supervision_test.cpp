// Wheels that are blocked or whose encoders are wrong; what is measured of a stage.
#include "edp/platform/supervision.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "edp/platform/stage_collector.hpp"

namespace mrroc::edp::test {
namespace {

constexpr PlatformProperties kPlatform{.name = "any",
                                       .wheel_radius = 0.2,
                                       .half_track = 0.5,
                                       .increments_per_turn = 4000,
                                       .max_torque = 20,
                                       .brake = 5,
                                       .max_wheel_speed = 10};

/// Judges the same stage again and again. @return after how many times there is a fault, 0: not within 50; and which
std::pair<int, Fault> judged(const StageReading& stage, const PlatformEstimate& estimate,
                             const PathPoint& wanted) {
  WheelSupervision supervision(kPlatform);
  for (int k = 1; k <= 50; ++k)
    if (const auto fault = supervision.step(stage, estimate, wanted)) return {k, *fault};
  return {0, {}};
}

StageReading turning(double speed) {
  StageReading s;
  s.theta_dot.fill(speed);
  s.imu_valid = true;
  return s;
}
PlatformEstimate believed(const StageReading& stage) {
  PlatformEstimate e;
  e.theta_dot = stage.theta_dot;
  return e;
}
const PathPoint kForwards{{}, 1, 0};
const PathPoint kSlowly{{}, 0.1, 0};  // 0.5 rad/s

TEST(WheelSupervision, AWheelThatStandsUnderTorqueIsBlocked) {
  for (const double sign : {1.0, -1.0}) {
    StageReading s = turning(0.049 * sign);
    s.torque[2] = 6.01 * sign;
    const auto [after, fault] = judged(s, believed(s), {{}, 0.1 * sign, 0});
    EXPECT_EQ(after, WheelSupervision::kBlocked);
    EXPECT_EQ(fault.code, FaultCode::wheel_blocked);
    EXPECT_EQ(fault.axis, 2);
    EXPECT_EQ(fault.value, 6.01 * sign);
    EXPECT_EQ(fault.limit, WheelSupervision::kTorque);
    s.torque[2] = 6 * sign;
    EXPECT_EQ(judged(s, believed(s), kForwards).first, 0) << "the very torque";
    s = turning(0.05 * sign);
    s.torque[2] = 7 * sign;
    EXPECT_EQ(judged(s, believed(s), kForwards).first, 0) << "the very speed: it does not stand";
  }
}

// 5 rad/s: 0.1 rad in an iteration.
TEST(WheelSupervision, AWheelThatMissesAQuickTurnIsFoundAtOnceAndItsSideTellsWhatIsWrong) {
  for (const double sign : {1.0, -1.0})
    for (const auto& [other, code] :
         {std::pair(3.99, FaultCode::wheel_blocked), std::pair(4.01, FaultCode::encoder_fault)}) {
      StageReading s = turning(5 * sign);
      s.theta_dot[1] = 0;
      s.theta_dot[3] = other * sign;
      s.torque[1] = 7 * sign;
      const auto [after, fault] = judged(s, believed(s), {{}, sign, 0});
      EXPECT_EQ(after, 3) << "a quarter of a radian";
      EXPECT_EQ(fault.code, code) << other;
      EXPECT_EQ(fault.axis, 1);
    }
}

// 1 rad/s: 13 iterations are a quarter of a radian; the last one tells nothing by itself.
TEST(WheelSupervision, MostOfTheIterationsTellWhetherItsSideTurned) {
  for (const int follows : {0, 5, 6, 7, 8, 13})
    for (const bool at_last : {false, true}) {
      if (at_last ? follows == 0 : follows == 13) continue;
      WheelSupervision supervision(kPlatform);
      StageReading s = turning(1);
      s.theta_dot[2] = 0;
      s.torque[2] = 7;
      std::optional<Fault> fault;
      for (int n = 0; n < 13 && !fault; ++n) {
        const int left = at_last ? n - (13 - follows) : follows - 1 - n;
        s.theta_dot[0] = left >= 0 ? 1 : 0.5;
        fault = supervision.step(s, believed(s), {{}, 0.2, 0});
      }
      ASSERT_TRUE(fault);
      EXPECT_EQ(fault->code, follows >= 7 ? FaultCode::encoder_fault : FaultCode::wheel_blocked)
          << follows << at_last;
    }
}

// The other one of its side turns as it should; the platform turns to the side of the wheel as soon as it stands.
TEST(WheelSupervision, AWheelThatDragsItsSideAtOnceIsBlocked) {
  for (std::size_t k = 0; k < kWheels; ++k)
    for (const double sign : {1.0, -1.0})
      for (const auto& [rate, late, code] :
           {std::tuple(0.061, 0., FaultCode::wheel_blocked), std::tuple(0.059, 0., FaultCode::encoder_fault),
            std::tuple(0., 9., FaultCode::encoder_fault), std::tuple(-0.5, 0., FaultCode::encoder_fault)}) {
        WheelSupervision supervision(kPlatform);
        const PathPoint wanted{{}, sign, 0};
        const double to_its_side = sign * (k % 2 == 0 ? 1 : -1);
        StageReading s = turning(5 * sign);
        for (int n = 0; n < 3; ++n) EXPECT_FALSE(supervision.step(s, believed(s), wanted));
        s.theta_dot[k] = 0;
        s.torque[k] = 7 * sign;
        s.yaw_rate = to_its_side * rate;
        std::optional<Fault> fault;
        for (int n = 0; n < 3 && !fault; ++n) {
          fault = supervision.step(s, believed(s), wanted);
          s.yaw_rate += to_its_side * late;  // by what the tracker does
        }
        ASSERT_TRUE(fault);
        EXPECT_EQ(fault->code, code) << k << ' ' << sign << ' ' << rate;
      }
}

TEST(WheelSupervision, AnImuThatIsSilentForAMomentIsNoPull) {
  for (int silent = 0; silent < 6; ++silent) {
    WheelSupervision supervision(kPlatform);
    const PathPoint wanted{{}, 1, 0.2};
    StageReading s = turning(5);
    s.yaw_rate = 0.2;
    std::optional<Fault> fault;
    for (int n = 0; n < 8 && !fault; ++n) {
      StageReading now = s;
      if (n >= 3) now.theta_dot[1] = 0, now.torque[1] = 7;
      if (n == silent) now.imu_valid = false, now.yaw_rate = 0;
      fault = supervision.step(now, believed(now), wanted);
    }
    ASSERT_TRUE(fault) << silent;
    EXPECT_EQ(fault->code, FaultCode::encoder_fault) << silent;
  }
}

TEST(WheelSupervision, AWheelThatIsBrakedMayStandAndOneThatIsNotPushedHardWhenItsSideDoes) {
  StageReading s = turning(5);
  s.theta_dot[1] = 0;
  s.torque[1] = -7;
  EXPECT_EQ(judged(s, believed(s), kForwards).first, 0) << "it slips";
  s.torque[1] = -6;
  EXPECT_EQ(judged(s, believed(s), kForwards).first, WheelSupervision::kWrong) << "nothing holds it";
  s.torque[1] = 5;
  EXPECT_EQ(judged(s, believed(s), kForwards).first, 3) << "its side turns";
  s.theta_dot[3] = 0.2;
  EXPECT_EQ(judged(s, believed(s), kForwards).first, 0) << "the whole side stands, as before a start";
}

// In a turn to the left, w > 0, the left wheels go back: v - w 0.5 m and v + w 0.5 m; from 0.06 m/s a wheel is to turn.
TEST(WheelSupervision, WhichWheelsAreToTurnIsToldByTheWay) {
  const auto blocked = [](std::size_t wheel, double v, double w) {
    StageReading s = turning(0);
    s.torque[wheel] = std::copysign(10, v + (wheel % 2 == 0 ? -w : w) * kPlatform.half_track);
    return judged(s, believed(s), {{}, v, w}).first != 0;
  };
  for (std::size_t k = 0; k < kWheels; ++k) {
    const bool left = k % 2 == 0;
    EXPECT_FALSE(blocked(k, 0, 0)) << k;
    EXPECT_FALSE(blocked(k, 0.0599, 0)) << k;
    EXPECT_TRUE(blocked(k, 0.0601, 0)) << k;
    EXPECT_TRUE(blocked(k, -0.0601, 0)) << k;
    EXPECT_TRUE(blocked(k, 0, 0.121)) << k;
    EXPECT_FALSE(blocked(k, 0, 0.119)) << k;
    EXPECT_EQ(blocked(k, 0.3, 0.5), !left) << k;
    EXPECT_EQ(blocked(k, 0.3, -0.5), left) << k;
  }
}

TEST(WheelSupervision, AnEncoderThatStandsWhileTheOtherOneOfItsSideTurnsIsWrong) {
  constexpr std::size_t kBeside[]{2, 3, 0, 1};
  for (std::size_t k = 0; k < kWheels; ++k)
    for (std::size_t other = 0; other < kWheels; ++other) {
      if (other == k) continue;
      StageReading s = turning(0.2);
      s.theta_dot[k] = 0.01;
      s.theta_dot[other] = -0.301;
      const auto [after, fault] = judged(s, believed(s), kForwards);
      EXPECT_EQ(after, other == kBeside[k] ? WheelSupervision::kWrong : 0) << k << ' ' << other;
      if (after == 0) continue;
      EXPECT_EQ(fault.code, FaultCode::encoder_fault);
      EXPECT_EQ(fault.axis, static_cast<int>(k));
      EXPECT_EQ(fault.value, 0.01);
      EXPECT_EQ(fault.limit, WheelSupervision::kTurns);
      s.theta_dot[other] = 0.3;
      EXPECT_EQ(judged(s, believed(s), kForwards).first, 0) << "the very speed";
      s.theta_dot[other] = 1;
      s.torque[k] = 7;
      EXPECT_EQ(judged(s, believed(s), kForwards).second.code, FaultCode::wheel_blocked);
      s.torque[k] = 0;
      EXPECT_EQ(judged(s, believed(s), {}).first, 0) << "it need not turn";
    }
}

TEST(WheelSupervision, AnEncoderThatContradictsTheEstimateIsWrong) {
  const auto after = [](double measured, double estimated) {
    StageReading s = turning(2);
    PlatformEstimate e = believed(s);
    s.theta_dot[1] = measured;
    e.theta_dot[1] = estimated;
    return judged(s, e, kForwards);
  };
  for (const double sign : {1.0, -1.0}) {
    const auto [n, fault] = after(2 + 0.801 * sign, 2);
    EXPECT_EQ(n, WheelSupervision::kWrong);
    EXPECT_EQ(fault.code, FaultCode::encoder_fault);
    EXPECT_EQ(fault.axis, 1);
    EXPECT_NEAR(fault.value, 0.801 * sign, 1e-12);
    EXPECT_EQ(fault.limit, WheelSupervision::kResidual);
    EXPECT_EQ(after(2 + 0.799 * sign, 2).first, 0);
    EXPECT_EQ(after(15 * sign, 15 * sign).first, 0) << "half more than the greatest speed";
    EXPECT_EQ(after(15.01 * sign, 15.01 * sign).first, WheelSupervision::kWrong);
  }
  EXPECT_EQ(after(2, std::numeric_limits<double>::quiet_NaN()).first, WheelSupervision::kWrong);
}

TEST(WheelSupervision, CountsInSuccessionOnly) {
  WheelSupervision supervision(kPlatform);
  StageReading stands = turning(0), wrong = turning(2);
  stands.torque[0] = 10;
  const StageReading good = turning(2);
  PlatformEstimate elsewhere = believed(wrong);
  elsewhere.theta_dot[3] = 0;
  const auto many = [&](const StageReading& s, const PlatformEstimate& e, int n) {
    for (int k = 0; k < n; ++k)
      if (supervision.step(s, e, kSlowly)) return true;
    return false;
  };
  const auto count_again = [&](auto between) {
    EXPECT_FALSE(many(stands, believed(stands), WheelSupervision::kBlocked - 1));
    between();
    EXPECT_FALSE(many(stands, believed(stands), WheelSupervision::kBlocked - 1));
    between();
    EXPECT_FALSE(many(wrong, elsewhere, WheelSupervision::kWrong - 1));
    between();
    EXPECT_FALSE(many(wrong, elsewhere, WheelSupervision::kWrong - 1));
    between();
  };
  count_again([&] { EXPECT_FALSE(many(good, believed(good), 1)); });
  count_again([&] { supervision.forget(); });
}

// --- a stage --------------------------------------------------------------------------------------------------

PlatformReading reading(std::int64_t step) {
  PlatformReading r{
      .step = step, .encoder = {10, 20, 30, 40}, .yaw = 0.5, .yaw_rate = 0.25, .imu_valid = true};
  r.load = {1, 2, 3, 4};
  r.load_valid = true;
  return r;
}

TEST(StageCollector, AStageHasTheLastReadingAndTheMeansOfItsSteps) {
  StageCollector sensors(kPlatform, 0.002);
  sensors.set_static_load({1, 2, 3, 4});
  for (int k = 0; k < 4; ++k) {
    sensors.measure(reading(k));
    sensors.command({.torque = {1.0 * k, 2, 3, -4}, .enabled = true});
  }
  const StageReading s = sensors.take(7);
  EXPECT_EQ(s.step, 7);
  EXPECT_EQ(s.torque, PerWheel({1.5, 2, 3, -4}));
  EXPECT_EQ(s.load, PerWheel({1, 2, 3, 4}));
  EXPECT_TRUE(s.enabled);
  EXPECT_TRUE(s.imu_valid);
  EXPECT_EQ(s.yaw, 0.5);
  EXPECT_EQ(s.yaw_rate, 0.25);
  EXPECT_EQ(s.theta, sensors.wheels().theta());
  EXPECT_NEAR(s.theta[1], 20 * 2 * M_PI / 4000, 1e-12);
  EXPECT_EQ(s.theta_dot, PerWheel{});
  sensors.measure(reading(4));
  sensors.command({.torque = {8, 0, 0, 0}, .enabled = true});
  EXPECT_EQ(sensors.take(8).torque, PerWheel({8, 0, 0, 0})) << "of this stage alone";
  EXPECT_EQ(sensors.take(9).torque, PerWheel{}) << "there was no step";
  EXPECT_EQ(sensors.take(9).load, PerWheel({1, 2, 3, 4})) << "as at rest";
}

TEST(StageCollector, ABrakedStageHasTheTorqueThatTheBrakeIsBelievedToGive) {
  StageCollector sensors(kPlatform, 0.002);
  PlatformReading r;
  for (int k = 0; k < 40; ++k) {
    r.step = k;
    r.encoder = {k, -k, 10 * k, 0};
    sensors.measure(r);
  }
  const PerWheel speed = sensors.wheels().theta_dot();
  EXPECT_NEAR(speed[0], 2 * M_PI / 4000 / 0.002, 1e-9);
  sensors.command({.enabled = false});
  sensors.command({.torque = {1, 1, 1, 1}, .enabled = true});
  const StageReading s = sensors.take(0);
  EXPECT_FALSE(s.enabled);
  EXPECT_NEAR(s.torque[0], (1 - 5 * speed[0]) / 2, 1e-9);
  EXPECT_NEAR(s.torque[1], (1 + 5 * speed[0]) / 2, 1e-9);
  EXPECT_NEAR(s.torque[2], (1 - 20) / 2., 1e-9) << "at most what a drive gives";
  EXPECT_NEAR(s.torque[3], 0.5, 1e-9);
  sensors.command({.enabled = true});
  EXPECT_TRUE(sensors.take(1).enabled);
}

TEST(StageCollector, WhatIsNotFiniteIsNoMeasurement) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  StageCollector sensors(kPlatform, 0.002);
  const auto valid = [&](auto change) {
    PlatformReading r = reading(0);
    change(r);
    sensors.measure(r);
    return std::pair(sensors.reading().imu_valid, sensors.reading().load_valid);
  };
  EXPECT_EQ(valid([](PlatformReading&) {}), std::pair(true, true));
  EXPECT_EQ(valid([](PlatformReading& r) { r.yaw = kNan; }), std::pair(false, true));
  EXPECT_EQ(valid([](PlatformReading& r) { r.yaw_rate = kNan; }), std::pair(false, true));
  EXPECT_EQ(valid([](PlatformReading& r) { r.imu_valid = false; }), std::pair(false, true));
  EXPECT_EQ(sensors.take(0).yaw, 0);
  EXPECT_EQ(sensors.take(0).yaw_rate, 0);
  for (std::size_t k = 0; k < kWheels; ++k)
    EXPECT_EQ(valid([k](PlatformReading& r) { r.load[k] = kNan; }), std::pair(true, false));
  EXPECT_EQ(valid([](PlatformReading& r) { r.load_valid = false; }), std::pair(true, false));
}

TEST(StageCollector, AnImuThatIsAbsentThreeTimesInSuccessionIsSilent) {
  StageCollector sensors(kPlatform, 0.002);
  const auto silent = [&](bool valid) {
    PlatformReading r = reading(0);
    r.imu_valid = valid;
    sensors.measure(r);
    return sensors.imu_silent();
  };
  for (int round = 0; round < 2; ++round) {
    EXPECT_FALSE(silent(false));
    EXPECT_FALSE(silent(false));
    EXPECT_FALSE(silent(true));
  }
  EXPECT_FALSE(silent(false));
  EXPECT_FALSE(silent(false));
  for (int k = 0; k < 9; ++k) EXPECT_TRUE(silent(false));
  EXPECT_FALSE(silent(true));
}

}  // namespace
}  // namespace mrroc::edp::test
