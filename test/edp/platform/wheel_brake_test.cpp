// Braking by torques, and encoders that cannot be true.
#include "edp/platform/wheel_brake.hpp"

#include <gtest/gtest.h>

namespace mrroc::edp {
namespace {

constexpr double kDt = 0.002;
constexpr double kIncrements = 4000;
constexpr double kMost = 8;

/// Wheels that turn as they are told, and the brake.
class WheelBrakeTest : public ::testing::Test {
 protected:
  /// @param steps  of which only the last one has a reading @return torques
  PerWheel turn(const std::array<int, kWheels>& increments, int steps = 1) {
    step_ += steps;
    for (std::size_t k = 0; k < kWheels; ++k) reading_.encoder[k] += increments[k] * steps;
    reading_.step = step_;
    meter_.step(reading_);
    return brake_.step(meter_);
  }
  static PlatformProperties properties() {
    PlatformProperties p;
    p.increments_per_turn = kIncrements;
    p.braking_torque = kMost;
    p.max_wheel_speed = 12;
    return p;
  }
  static constexpr double kSpeed =
      2 * 3.14159265358979 / kIncrements / kDt;  // of an increment a step [rad/s]

  PlatformReading reading_{};
  WheelMeter meter_{kIncrements, kDt};
  WheelBrake brake_{properties(), kDt};
  std::int64_t step_{};
};

TEST_F(WheelBrakeTest, EachWheelIsBrakedAgainstItsOwnSpeedUpToTheMost) {
  std::ignore = turn({0, 0, 0, 0});
  brake_.begin();
  PerWheel torque{};
  for (int k = 0; k < 10; ++k) torque = turn({1, -1, 2, 10});
  EXPECT_NEAR(torque[0], -WheelBrake::kGain * kSpeed, 1e-9);
  EXPECT_NEAR(torque[1], WheelBrake::kGain * kSpeed, 1e-9);
  EXPECT_EQ(torque[2], -kMost);
  EXPECT_EQ(torque[3], -kMost);
}

TEST_F(WheelBrakeTest, ReadingsThatWereMissedChangeNoTorque) {
  std::ignore = turn({0, 0, 0, 0});
  brake_.begin();
  PerWheel torque{};
  for (int k = 0; k < 10; ++k) torque = turn({1, 1, -1, -1}, 3);
  EXPECT_NEAR(torque[0], -WheelBrake::kGain * kSpeed, 1e-9);
  EXPECT_NEAR(torque[2], WheelBrake::kGain * kSpeed, 1e-9);
}

TEST_F(WheelBrakeTest, AnEncoderThatStandsWhileTheOtherOfItsSideTurnsEndsIt) {
  for (std::size_t stuck = 0; stuck < kWheels; ++stuck) {
    std::array<int, kWheels> increments{4, 4, 4, 4};
    increments[stuck] = 0;
    std::ignore = turn({4, 4, 4, 4});
    brake_.begin();
    int steps = 0;
    for (; brake_.engaged() && steps < 100; ++steps) std::ignore = turn(increments);
    EXPECT_LE(steps, 25) << stuck;
    EXPECT_EQ(turn(increments), PerWheel{});
  }
}

TEST_F(WheelBrakeTest, AWheelThatIsOutDoesNotBrakeAndItsEncoderEndsNothing) {
  for (int out = 0; out < static_cast<int>(kWheels); ++out)
    for (const int seen : {0, 1000}) {
      std::array<int, kWheels> increments{4, 4, 4, 4};
      for (int k = 0; k < 20; ++k) std::ignore = turn(increments);
      brake_.begin(out);
      increments[static_cast<std::size_t>(out)] = seen;
      for (int k = 0; k < 100; ++k) {
        const PerWheel torque = turn(increments);
        for (std::size_t w = 0; w < kWheels; ++w)
          EXPECT_EQ(torque[w], static_cast<int>(w) == out ? 0 : -kMost) << out << ' ' << seen << ' ' << k;
      }
    }
}

TEST_F(WheelBrakeTest, AnEncoderOfAWheelThatIsOutAndRunsAwayHidesNeitherRestNorTheWheelBesideIt) {
  for (int k = 0; k < 20; ++k) std::ignore = turn({4, 4, 4, 4});
  brake_.begin(0);
  for (int k = 0; k < 60; ++k) std::ignore = turn({1000, 4, 0, 4});
  EXPECT_TRUE(brake_.engaged()) << "the wheel beside stands: it is braked";
  int steps = 0;
  for (; brake_.engaged() && steps < 200; ++steps) std::ignore = turn({1000, 0, 0, 0});
  EXPECT_EQ(steps, WheelBrake::kRest);
}

TEST_F(WheelBrakeTest, AWheelThatStandsForAMomentOrBesideOneThatHardlyTurnsDoesNot) {
  std::ignore = turn({0, 0, 0, 0});
  brake_.begin();
  for (int k = 0; k < 200; ++k) std::ignore = turn({3, 3, k % 15 == 0 ? 1 : 0, 3});
  EXPECT_TRUE(brake_.engaged());
  for (int k = 0; k < 100; ++k) std::ignore = turn({k % 10 == 0 ? 1 : 0, 1, 0, 1});
  EXPECT_TRUE(brake_.engaged());
}

TEST_F(WheelBrakeTest, ASpeedThatNoWheelHasEndsIt) {
  std::ignore = turn({0, 0, 0, 0});
  brake_.begin();
  std::ignore = turn({5, 5, 5, 5});
  EXPECT_TRUE(brake_.engaged());
  EXPECT_EQ(turn({5, 1000, 5, 5}), PerWheel{});
  EXPECT_FALSE(brake_.engaged());
}

TEST_F(WheelBrakeTest, ItEndsWhenAllWheelsHaveStoodForATenthOfASecond) {
  std::ignore = turn({3, 3, 3, 3});
  brake_.begin();
  int steps = 0;
  for (; brake_.engaged() && steps < 1000; ++steps) std::ignore = turn({0, 0, 0, 0});
  EXPECT_EQ(steps, WheelBrake::kRest);
}

TEST_F(WheelBrakeTest, APlatformWithoutABrakingTorqueIsNeverBraked) {
  PlatformProperties none = properties();
  none.braking_torque = 0;
  WheelBrake brake(none, kDt);
  brake.begin();
  EXPECT_FALSE(brake.engaged());
}

}  // namespace
}  // namespace mrroc::edp
