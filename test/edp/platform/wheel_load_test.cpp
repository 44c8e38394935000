// Which forces on the wheels the kernels of a platform are given.
#include "edp/platform/wheel_load.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "edp/platform/stage_collector.hpp"

namespace mrroc::edp::test {
namespace {

constexpr PerWheel kAtRest{110, 110, 100, 100};

TEST(WheelLoad, IsBelievedWithinAFifthOfTheWeight) {
  constexpr PerWheel kWandered{130, 120, 95, 80};
  EXPECT_EQ(believed_load(kWandered, kAtRest), kWandered);
  EXPECT_EQ(believed_load({130, 120, 95, 0}, kAtRest), PerWheel({130, 120, 95, 0}))
      << "a wheel is off the ground";
  EXPECT_EQ(believed_load({120, 110, 95, 0}, kAtRest), kAtRest);
  EXPECT_EQ(believed_load({210, 120, 95, 80}, kAtRest), kAtRest);
}

TEST(WheelLoad, OfACellThatTellsWhatNoGroundGivesIsNotBelieved) {
  EXPECT_EQ(believed_load({230, 120, 95, -20}, kAtRest), kAtRest);
  EXPECT_EQ(believed_load({130, 120, std::numeric_limits<double>::quiet_NaN(), 80}, kAtRest), kAtRest);
  EXPECT_EQ(believed_load({130, std::numeric_limits<double>::infinity(), 95, 80}, kAtRest), kAtRest);
}

TEST(WheelLoad, OfAStageIsTheMeanThatIsBelieved) {
  const PlatformProperties platform{.name = "any", .increments_per_turn = 4000, .max_torque = 20};
  StageCollector sensors(platform, 0.002);
  sensors.set_static_load(kAtRest);
  const auto stage = [&](const PerWheel& first, const PerWheel& second) {
    for (const PerWheel& load : {first, second}) sensors.measure({.load = load, .load_valid = true});
    return sensors.take(0).load;
  };
  EXPECT_EQ(stage({120, 120, 90, 90}, {100, 100, 110, 110}), PerWheel({110, 110, 100, 100}));
  EXPECT_EQ(stage({140, 120, 100, -30}, {140, 120, 100, 70}), PerWheel({140, 120, 100, 20}));
  EXPECT_EQ(stage({220, 120, 100, -30}, {220, 120, 100, 10}), kAtRest)
      << "the mean is negative, its sum is right";
}

}  // namespace
}  // namespace mrroc::edp::test
