#include "sim/force_sensor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/statistics.hpp"

namespace mrroc::sim {
namespace {

const Wrench kLoad = Wrench::from({1, -2, 30}, {0.1, 0.2, -0.3});

TEST(ForceSensor, AddsAConstantBiasAndNoiseOfTheGivenDeviation) {
  const ForceSensorParameters p;
  ForceSensorParameters silent = p;
  silent.force_noise = silent.torque_noise = silent.force_resolution = silent.torque_resolution = 0;
  const Wrench bias = ForceSensor(silent, 7).measure(kLoad) - kLoad;
  ForceSensor sensor(p, 7);
  std::array<Statistics, 6> s;
  for (int k = 0; k < 20000; ++k) {
    const Wrench reading = sensor.measure(kLoad);
    for (std::size_t a = 0; a < 6; ++a) s[a].add(reading.v[a]);
  }
  for (std::size_t a = 0; a < 6; ++a) {
    const double noise = a < 3 ? p.force_noise : p.torque_noise;
    EXPECT_NEAR(s[a].mean(), kLoad.v[a] + bias.v[a], noise / 25);
    EXPECT_NEAR(s[a].deviation(), noise, noise / 20);
  }
}

// Forces and torques have biases of their own, drawn evenly from the whole range of their parameters.
TEST(ForceSensor, TheBiasFillsItsRangeAndDoesNotLeaveIt) {
  ForceSensorParameters p{.force_noise = 0, .torque_noise = 0, .force_resolution = 0, .torque_resolution = 0};
  p.force_bias = 2;
  p.torque_bias = 0.05;
  std::array<double, 6> least{}, most{};
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Wrench offset = ForceSensor(p, seed).measure(kLoad) - kLoad;
    for (std::size_t a = 0; a < 6; ++a) {
      least[a] = std::min(least[a], offset.v[a]);
      most[a] = std::max(most[a], offset.v[a]);
    }
  }
  for (std::size_t a = 0; a < 6; ++a) {
    const double bias = a < 3 ? 2 : 0.05;
    EXPECT_LE(most[a], bias * (1 + 1e-9)) << a;
    EXPECT_GE(most[a], 0.9 * bias) << a;
    EXPECT_GE(least[a], -bias * (1 + 1e-9)) << a;
    EXPECT_LE(least[a], -0.9 * bias) << a;
  }
}

TEST(ForceSensor, ReadsMultiplesOfItsResolution) {
  const ForceSensorParameters p;
  ForceSensor sensor(p, 3);
  const Wrench reading = sensor.measure(kLoad);
  for (const Axis a : kAxes) {
    const double steps = reading[a] / (a < Axis::ax ? p.force_resolution : p.torque_resolution);
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
  }
}

TEST(ForceSensor, SaturatesAtItsRange) {
  ForceSensor sensor({}, 1);
  const Wrench reading = sensor.measure(Wrench::from({100, -100, 300}, {-9, 9, 9}));
  const std::array<double, 6> range{65, -65, 200, -5, 5, 5};
  for (std::size_t a = 0; a < 6; ++a) EXPECT_NEAR(reading.v[a], range[a], 0.0125);
}

TEST(ForceSensor, TheSameSeedGivesTheSameReadingsAndAnotherOneOthers) {
  ForceSensor one({}, 5), same({}, 5), other({}, 6);
  for (int k = 0; k < 10; ++k) {
    const Wrench reading = one.measure(kLoad);
    EXPECT_EQ(reading, same.measure(kLoad));
    EXPECT_NE(reading, other.measure(kLoad));
  }
}

}  // namespace
}  // namespace mrroc::sim
