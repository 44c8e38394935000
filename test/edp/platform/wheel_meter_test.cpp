// Turns and speeds of wheels from whole increments, and the measurements of a stage.
#include "edp/platform/wheel_meter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <tuple>

#include "edp/platform/stage_collector.hpp"
#include "test/edp/platform/fake_platform.hpp"

namespace mrroc::edp::test {
namespace {

constexpr double kStep = 0.002;  // [s]
constexpr double kRad = 2 * std::numbers::pi / kIncrements;

PlatformReading reading(std::int64_t step, double theta) {
  PlatformReading r;
  r.step = step;
  r.encoder.fill(static_cast<std::int32_t>(static_cast<std::int64_t>(std::floor(theta / kRad))));
  r.imu_valid = r.load_valid = true;
  r.load.fill(100);
  return r;
}

TEST(WheelMeter, CountsFromPowerUp) {
  WheelMeter wheels(kIncrements, kStep);
  wheels.step(reading(5, 3));
  EXPECT_NEAR(wheels.theta()[2], 3, kRad);
  EXPECT_EQ(wheels.theta_dot()[2], 0);
}

TEST(WheelMeter, SpeedDoesNotLagBehindAConstantAcceleration) {
  WheelMeter wheels(kIncrements, kStep);
  for (int k = 0; k < 200; ++k) {
    const double t = k * kStep;
    wheels.step(reading(k, 0.3 + 7 * t * t / 2));
    if (k > 30) {
      EXPECT_NEAR(wheels.theta_dot()[0], 7 * t, 0.25) << k;
    }
  }
}

TEST(WheelMeter, SpeedIsLessDisturbedByWholeIncrementsThanADifference) {
  WheelMeter wheels(kIncrements, kStep);
  double squares = 0;
  for (int k = 0; k < 2'000; ++k) {
    wheels.step(reading(k, 2.345 * k * kStep));
    if (k >= 30) squares += std::pow(wheels.theta_dot()[1] - 2.345, 2);
  }
  EXPECT_LT(std::sqrt(squares / 1970), 0.09) << "a difference: 0.3";
}

// Torques change in the third step of a macrostep: what was before tells little of the speed at its end.
TEST(WheelMeter, SpeedAtABoundaryIsThatOfTheLastTorques) {
  WheelMeter wheels(kIncrements, kStep);
  double theta = 0.3, speed = 4;
  for (int k = 0; k < 600; ++k) {
    wheels.step(reading(k, theta));
    if (k > 40 && k % kPlatformSteps == 0) {
      EXPECT_NEAR(wheels.theta_dot()[0], speed, 0.4) << k;
    }
    const double acceleration =
        (k - 2) / kPlatformSteps % 2 == 0 ? 50 : -50;  // [rad/s^2] of a wheel that slips
    theta += (speed + acceleration * kStep / 2) * kStep;
    speed += acceleration * kStep;
  }
}

TEST(WheelMeter, CounterMayWrapAround) {
  WheelMeter wheels(kIncrements, kStep);
  constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max();
  for (int k = 0; k <= 100; ++k) {
    PlatformReading r = reading(k, 0);
    r.encoder.fill(static_cast<std::int32_t>(kMost - 100 + 5 * static_cast<std::uint32_t>(k)));
    wheels.step(r);
  }
  EXPECT_NEAR(wheels.theta()[3], (kMost + 400.) * kRad, 1e-6);
  EXPECT_NEAR(wheels.theta_dot()[3], 5 * kRad / kStep, 1e-6);
}

TEST(WheelMeter, StepsThatWereMissedDoNotMakeItFaster) {
  WheelMeter wheels(kIncrements, kStep);
  for (const int k : {0, 10, 11, 15, 22, 30, 45}) wheels.step(reading(k, 40 * kRad * k));
  EXPECT_NEAR(wheels.theta_dot()[0], 40 * kRad / kStep, 0.05 * 40 * kRad / kStep);
}

class StageCollection : public testing::Test {
 protected:
  StageReading macrostep(const std::function<void(PlatformReading&)>& change,
                         const PlatformDrive& drive = {}) {
    for (int k = 0; k < kPlatformSteps; ++k) {
      PlatformReading r = reading(step_, 0.002 * static_cast<double>(step_));
      ++step_;
      change(r);
      collector.measure(r);
      if (k + 1 < kPlatformSteps) collector.command(drive);
    }
    const StageReading stage = collector.take(step_);
    collector.command(drive);
    return stage;
  }
  FakePlatform platform;
  StageCollector collector{platform.q, kStep};

 private:
  std::int64_t step_{};
};

TEST_F(StageCollection, LoadsAreMeansOfAMacrostepAndThoseAtRestWhenTheirSumIsWrong) {
  collector.set_static_load({90, 110, 90, 110});
  EXPECT_EQ(macrostep([](PlatformReading&) {}).load[0], 100);
  EXPECT_NEAR(macrostep([](PlatformReading& r) { r.load[1] = r.step % 2 == 0 ? 90 : 130; }).load[1], 110,
              1e-9);
  for (const double wrong : {79., 121., -100., 1e9})
    EXPECT_EQ(macrostep([&](PlatformReading& r) { r.load.fill(wrong); }).load[0], 90) << wrong;
  EXPECT_EQ(macrostep([](PlatformReading& r) {
              r.load = {200, 200, 10, -10};
            }).load[0],
            90)
      << "a wheel hangs";
  EXPECT_EQ(macrostep([](PlatformReading& r) { r.load_valid = false; }).load[1], 110);
  EXPECT_EQ(macrostep([](PlatformReading& r) { r.load[2] = std::nan(""); }).load[1], 110);
}

TEST_F(StageCollection, TorqueIsTheMeanOfWhatWasCommanded) {
  PlatformDrive drive;
  drive.enabled = true;
  drive.torque = {1, 2, 3, 4};
  std::ignore = macrostep([](PlatformReading&) {}, drive);
  const StageReading stage = macrostep([](PlatformReading&) {}, drive);
  EXPECT_TRUE(stage.enabled);
  EXPECT_NEAR(stage.torque[3], 4, 1e-9);
}

TEST_F(StageCollection, ABrakeGivesATorqueAgainstTheSpeed) {
  std::ignore = macrostep([](PlatformReading&) {});
  std::ignore = macrostep([](PlatformReading&) {});
  const StageReading stage = macrostep([](PlatformReading&) {});
  EXPECT_FALSE(stage.enabled);
  EXPECT_NEAR(stage.torque[0], -kBrake * 1, 0.5);  // at 1 rad/s
}

TEST_F(StageCollection, ImuIsSilentAfterThreeReadings) {
  const auto silent = [](PlatformReading& r) { r.imu_valid = r.step % 10 < 7; };
  EXPECT_FALSE(macrostep(silent).imu_valid);
  EXPECT_TRUE(collector.imu_silent());
  EXPECT_TRUE(macrostep([](PlatformReading& r) { r.imu_valid = r.step % 10 != 8; }).imu_valid);
  EXPECT_FALSE(collector.imu_silent());
  const StageReading stage = macrostep([](PlatformReading& r) { r.yaw_rate = std::nan(""); });
  EXPECT_FALSE(stage.imu_valid);
  EXPECT_EQ(stage.yaw_rate, 0);
  EXPECT_TRUE(collector.imu_silent());
}

}  // namespace
}  // namespace mrroc::edp::test
