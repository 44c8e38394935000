// The sensors of a platform: what they measure, how well, and when they do not.
#include "sim/platform/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <vector>

#include "test/sim/platform/platform.hpp"

namespace mrroc::sim {
namespace {

using test::ideal_platform;

constexpr double kStep = kPlatformStep;
constexpr double kTurn = 2 * std::numbers::pi;

struct Spread {
  double mean{}, deviation{};
};

Spread spread(const std::vector<double>& x) {
  Spread s;
  for (const double each : x) s.mean += each / static_cast<double>(x.size());
  for (const double each : x)
    s.deviation += (each - s.mean) * (each - s.mean) / static_cast<double>(x.size());
  s.deviation = std::sqrt(s.deviation);
  return s;
}

TEST(PlatformSensors, EncodersCountWholeIncrementsForwardAndBack) {
  PlatformSensors sensors(ideal_platform(), 1, kStep);
  for (int k = -3000; k < 3000; ++k) {
    const double turned = 0.0007 * k;
    const PlatformReading r = sensors.measure(k + 3000, {.turned = {turned, -turned, turned, 0}}, false);
    EXPECT_NEAR(r.encoder[0], 4000 / kTurn * turned, 1) << k;
    EXPECT_NEAR(r.encoder[1], -4000 / kTurn * turned, 1) << k;
    EXPECT_EQ(r.encoder[3], 0);
  }
}

TEST(PlatformSensors, TheRateHasNoiseAndTheYawIsItsIntegralSinceTheReset) {
  PlatformParameters p = ideal_platform();
  p.imu = {.noise = 0.005, .bias = 0.003, .bias_walk = 0};
  PlatformSensors sensors(p, 9, kStep);
  const double bias = sensors.bias();
  EXPECT_LE(std::abs(bias), 0.003);
  EXPECT_NE(bias, 0);
  std::vector<double> rates;
  double yaw = 0;
  for (int k = 0; k < 20'000; ++k) {
    const bool reset = k == 5000;
    const PlatformReading r = sensors.measure(k, {.turn = 0.8 * kStep}, reset);
    ASSERT_TRUE(r.imu_valid);
    rates.push_back(r.yaw_rate);
    yaw = reset ? 0 : yaw + kStep * r.yaw_rate;
    ASSERT_NEAR(r.yaw, yaw, 1e-9) << k;
  }
  const Spread s = spread(rates);
  EXPECT_NEAR(s.mean, 0.8 + bias, 0.0002);
  EXPECT_NEAR(s.deviation, 0.005, 0.0002);
}

TEST(PlatformSensors, TheBiasOfTheRateWalks) {
  PlatformParameters p = ideal_platform();
  p.imu.bias_walk = 1e-3;
  std::vector<double> ends;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    PlatformSensors sensors(p, seed, kStep);
    for (int k = 0; k < 2000; ++k) std::ignore = sensors.measure(k, {}, false);
    ends.push_back(sensors.bias());
  }
  const Spread s = spread(ends);
  EXPECT_NEAR(s.mean, 0, 4 * 0.002 / 20);
  EXPECT_NEAR(s.deviation, 0.002, 0.0003) << "root of 4 s";
}

TEST(PlatformSensors, LoadCellsHaveAnOffsetAndNoiseInProportion) {
  PlatformParameters p = ideal_platform();
  p.load_cells = {.noise = 0.01, .bias = 2};
  PlatformSensors sensors(p, 4, kStep);
  std::vector<double> light, heavy;
  for (int k = 0; k < 20'000; ++k) {
    const PlatformReading r = sensors.measure(k, {.load = {50, 200, 100, 100}}, false);
    light.push_back(r.load[0]);
    heavy.push_back(r.load[1]);
  }
  EXPECT_NEAR(spread(light).deviation, 0.5, 0.02);
  EXPECT_NEAR(spread(heavy).deviation, 2, 0.08);
  EXPECT_LT(std::abs(spread(light).mean - 50), 2.05);
  EXPECT_NE(spread(light).mean - 50, spread(heavy).mean - 200);
}

/// Readings 0 to 29 of a platform that turns and rolls evenly, of which something breaks in steps 10 to 19.
std::vector<PlatformReading> broken(StepInterval PlatformFaults::*fault) {
  PlatformParameters p = ideal_platform();
  p.faults.wheel = 1;
  p.faults.*fault = {.from = 10, .to = 20};
  PlatformSensors sensors(p, 1, kStep);
  std::vector<PlatformReading> readings;
  for (int k = 0; k < 30; ++k) {
    const double turned = 0.1 * k;
    readings.push_back(sensors.measure(
        k, {.turned = {turned, turned, turned, turned}, .turn = 0.001, .load = {100.0 + k, 100, 100, 100}},
        false));
  }
  return readings;
}

bool in_fault(const PlatformReading& r) { return r.step >= 10 && r.step < 20; }

TEST(PlatformSensors, AStuckEncoderLosesWhatItDoesNotCount) {
  const auto readings = broken(&PlatformFaults::encoder_stuck);
  for (const PlatformReading& r : readings) {
    if (in_fault(r)) {
      EXPECT_EQ(r.encoder[1], readings[9].encoder[1]) << r.step;
    }
    EXPECT_NEAR(r.encoder[0], 63.66 * static_cast<double>(r.step), 1.1);
  }
  EXPECT_NEAR(readings[29].encoder[1], 63.66 * 19, 3);
}

TEST(PlatformSensors, ASilentImuGoesOnAddingUp) {
  for (const PlatformReading& r : broken(&PlatformFaults::imu_silent)) {
    EXPECT_EQ(r.imu_valid, !in_fault(r)) << r.step;
    if (r.imu_valid) {
      EXPECT_NEAR(r.yaw, 0.001 * static_cast<double>(r.step + 1), 1e-12);
    }
  }
  for (const PlatformReading& r : broken(&PlatformFaults::imu_nan)) {
    EXPECT_TRUE(r.imu_valid);
    EXPECT_EQ(std::isnan(r.yaw) && std::isnan(r.yaw_rate), in_fault(r)) << r.step;
  }
}

TEST(PlatformSensors, LoadCellsBreakInThreeWays) {
  for (const PlatformReading& r : broken(&PlatformFaults::load_stuck))
    EXPECT_EQ(r.load[0], 100.0 + static_cast<double>(in_fault(r) ? 9 : r.step)) << r.step;
  for (const PlatformReading& r : broken(&PlatformFaults::load_wrong)) {
    EXPECT_EQ(r.load[1], in_fault(r) ? 200 : 100) << r.step;
    EXPECT_EQ(r.load[2], 100);
  }
  for (const PlatformReading& r : broken(&PlatformFaults::load_silent))
    EXPECT_EQ(r.load_valid, !in_fault(r)) << r.step;
}

}  // namespace
}  // namespace mrroc::sim
