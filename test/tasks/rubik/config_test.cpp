// The configuration of the cube's task: every number with its key and its bounds, the loads of the hands,
// and the limits of motion.
#include "tasks/rubik/config.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {
namespace {

TEST(RubikConfig, EveryNumberHasItsKeyAndItsBounds) {
  struct Number {
    const char* key;
    double least, most;
    std::function<double(const Parameters&)> value;
  };
  const std::vector<Number> numbers{
      {"torque", 0.5, 10, [](const Parameters& k) { return k.torque; }},
      {"most_torque", 0.5, 10, [](const Parameters& k) { return k.most_torque; }},
      {"mobility", 0.001, 0.5, [](const Parameters& k) { return k.mobility; }},
      {"attempts", 1, 10, [](const Parameters& k) { return k.attempts; }},
      {"timeout", 50, 10'000, [](const Parameters& k) { return k.timeout; }},
      {"progress", 0.001, 1, [](const Parameters& k) { return k.progress; }},
      {"stall", 25, 10'000, [](const Parameters& k) { return k.stall; }},
      {"held", 0.053, 0.09, [](const Parameters& k) { return k.held; }},
      {"slip", 0.001, 0.1, [](const Parameters& k) { return k.slip; }},
      {"open", 0.06, 0.08, [](const Parameters& k) { return k.open; }},
      {"jaw_step", 0.0005, 0.01, [](const Parameters& k) { return k.jaw_step; }},
      {"grip_step", 0.0001, 0.01, [](const Parameters& k) { return k.grip_step; }},
      {"opening_step", 0.0005, 0.02, [](const Parameters& k) { return k.opening_step; }}};
  const Parameters usual = read_parameters(Config());
  for (const Number& n : numbers) {
    const bool whole =
        n.key == std::string("attempts") || n.key == std::string("timeout") || n.key == std::string("stall");
    const auto read = [&](double value) -> std::optional<Parameters> {
      Config config;
      config.set(
          fmt::format("task.{}={}", n.key,
                      whole ? fmt::format("{}", static_cast<int>(value)) : fmt::format("{:.6f}", value)));
      try {
        return read_parameters(config);
      } catch (const ConfigError&) {
        return std::nullopt;
      }
    };
    EXPECT_EQ(n.value(usual), n.value(Parameters{})) << n.key;
    for (const double bound : {n.least, n.most}) {
      const auto k = read(bound);
      ASSERT_TRUE(k) << n.key;
      EXPECT_EQ(n.value(*k), bound) << n.key;
      for (const Number& other : numbers)
        if (other.key != n.key) {
          EXPECT_EQ(other.value(*k), other.value(usual)) << other.key << " by " << n.key;
        }
    }
    const double step = whole ? 1 : 1e-5;
    EXPECT_FALSE(read(n.least - step)) << n.key;
    EXPECT_FALSE(read(n.most + step)) << n.key;
  }
}

TEST(RubikConfig, AHandThatHoldsTheCubeHasBothWeightsAtTheirCommonCentre) {
  const Config config = Config::parse(
      "[task]\ncube_weight = 2\n[robots.arm1.tool]\npose = [0, 0, 0.2, 0, 0, 0]\nweight = 6\n"
      "mass_centre = [0.01, 0.02, 0.1]\n",
      "t");
  const Parameters k = read_parameters(config);
  const auto& [empty, holds] = k.load[index(Hand::postument)];
  EXPECT_EQ(empty.weight, 6);
  EXPECT_EQ(empty.mass_centre, Vector3(0.01, 0.02, 0.1));
  EXPECT_EQ(holds.weight, 8);
  const Vector3 cube(0, 0, 0.2 + depth(Hand::postument));
  EXPECT_LT((holds.mass_centre - (6 * empty.mass_centre + 2 * cube) / 8).norm(), 1e-12);
  EXPECT_EQ(k.load[index(Hand::track)][0].weight, 0) << "it is not said what it weighs";
}

TEST(RubikConfig, MotionLimitsAreOneNumberPerAxis) {
  const Config config =
      Config::parse("[robots.arm1.motion]\nvelocity = [1.0, 250.0]\nacceleration = [1.0, 10000.0]\n", "t");
  const ecp::MotionLimits limits = read_motion_limits(config, "arm1", 2);
  EXPECT_EQ(limits.velocity[1], 250);
  EXPECT_EQ(limits.acceleration[0], 1);
  EXPECT_EQ(limits.acceleration[1], 10'000);
  EXPECT_THROW(static_cast<void>(read_motion_limits(config, "arm1", 3)), ConfigError);
  for (const char* bad : {"velocity = [0.9, 2.0]\nacceleration = [1.0, 1.0]",
                          "velocity = [1.0, 251.0]\nacceleration = [1.0, 1.0]",
                          "velocity = [1.0, 2.0]\nacceleration = [0.9, 1.0]",
                          "velocity = [1.0, 2.0]\nacceleration = [1.0, 10001.0]"})
    EXPECT_THROW(static_cast<void>(read_motion_limits(
                     Config::parse(std::string("[robots.arm1.motion]\n") + bad + "\n", "t"), "arm1", 2)),
                 ConfigError)
        << bad;
}

}  // namespace
}  // namespace mrroc::rubik
