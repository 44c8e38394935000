// States of a window: which linearisations are kept, and how far a step is taken.
#include "robots/rex/window_states.hpp"

#include <gtest/gtest.h>

#include "robots/rex/parameters.hpp"
#include "robots/rex/wheels.hpp"

namespace mrroc::rex::test {
namespace {

constexpr int kNewest = kWindowStages - 1;
constexpr double kSpeed = 0.5;  // [m/s]

/// A full window of a platform that drives straight on, and the states that its model says.
class WindowStatesTest : public testing::Test {
 protected:
  WindowStatesTest() {
    window.begin({.p = {}, .load = standing_load(kMass, {})});
    for (int k = 0; k < kWindowStages; ++k) window.add(reading());  // the stage at rest has left
    arrival.z.setZero();
    arrival.z[kVelocity] = kSpeed;
    arrival.z.segment<4>(kWheelSpeed).setConstant(kSpeed / kWheelRadius);
    arrival.z.segment<3>(kSlipIndex) << 0.7, 0.6, 0;
    arrival.P = kDeviation * kDeviation * StageMatrix::Identity();
    states.set(0, arrival.z);
    for (int k = 0; k < kNewest; ++k) states.set(k + 1, window.transition_from(k, states[k]).z);
    states.linearise(window);
  }

  [[nodiscard]] edp::StageReading reading() const {
    edp::StageReading r{.step = window.newest().step + kPlatformSteps, .load = standing_load(kMass, {})};
    r.theta_dot = rolling_speeds(kSpeed, 0);
    r.torque.fill(kBearingFriction * kSpeed / kWheelRadius);
    return r;
  }
  /// The pictures are stages 5 and 9.
  [[nodiscard]] OdometryReading odometry() const {
    OdometryReading motion{.step_before = window[5].step, .step = window[9].step, .valid = true};
    motion.A = {1, 0, 0, 4 * kPlatformPeriod * kSpeed, 0, 1, 0, 0, 0, 0, 1, 0};
    return motion;
  }
  void expect_all_linearised_where_they_are() const {
    for (int k = 0; k < kNewest; ++k) {
      const StageTransition anew = window.transition_from(k, states[k]);
      EXPECT_EQ(states.transition(k).z, anew.z) << k;
      EXPECT_EQ(states.transition(k).F, anew.F) << k;
      EXPECT_EQ(states.transition(k).deviation, anew.deviation) << k;
    }
    for (int k = 0; k <= kNewest; ++k) {
      const StageResiduals anew = window.residuals_at(k, states[k]);
      ASSERT_EQ(states.residuals(k).count, anew.count) << k;
      EXPECT_EQ(states.residuals(k).r.head(anew.count), anew.r.head(anew.count)) << k;
    }
  }

  /// Moves all states aside, and takes a step towards where they were. @param times  1: exactly there  @return halvings
  int take_back(double times) {
    StageVector aside = StageVector::Zero();
    aside[1] = kAside;
    for (int k = 0; k <= kNewest; ++k) states.set(k, states[k] + aside);
    states.linearise(window);
    WindowStates::Change step;
    step.fill(-times * aside);
    return states.take(step, window, arrival, kDeviation * StageMatrix::Identity());
  }
  /// Expects the states so far aside.
  void expect_aside(double y) const {
    for (int k = 0; k <= kNewest; ++k) EXPECT_NEAR(states[k][1], y, 1e-12) << k;
    expect_all_linearised_where_they_are();
  }

  static constexpr double kDeviation = 0.01;
  static constexpr double kAside = 0.02;  // [m]
  StageWindow window{EstimatorNoise{}};
  StageBelief arrival{};
  WindowStates states;
};

TEST_F(WindowStatesTest, LinearisesAnewWhatIsOfAStateThatHasMoved) {
  expect_all_linearised_where_they_are();
  for (const int k : {11, 4, kNewest, 0}) {
    StageVector z = states[k];
    z[kHeading] += 0.1;
    z[kVelocity] -= 0.1;
    states.set(k, z);
    states.linearise(window);
    expect_all_linearised_where_they_are();
  }
}

TEST_F(WindowStatesTest, LinearisationsOfStagesThatStayAreThoseOfTheirStates) {
  for (int shifts = 0; shifts < 3; ++shifts) {
    window.add(reading());
    states.shift();
    states.set(kNewest, window.transition_from(kNewest - 1, states[kNewest - 1]).z);
    states.linearise(window);
    expect_all_linearised_where_they_are();
  }
}

TEST_F(WindowStatesTest, LinearisesAnewFromAPictureOnAndKeepsWhatIsBeforeIt) {
  const StageMatrix before = states.transition(5).F;
  ASSERT_EQ(window.add(odometry()), 5);
  states.renew(6);
  states.linearise(window);
  EXPECT_EQ(states.transition(5).F, before) << "nobody has said that it is another one";
  ASSERT_NE(window.transition_from(5, states[5]).F, before);
  states.renew(5);
  states.linearise(window);
  expect_all_linearised_where_they_are();
}

TEST_F(WindowStatesTest, CostIsNothingWhereModelAndMeasurementsAgree) {
  const StageMatrix root = kDeviation * StageMatrix::Identity();
  EXPECT_LT(states.cost(arrival, root), 1);
  arrival.z[0] += 3 * kDeviation;
  EXPECT_NEAR(states.cost(arrival, root), 9, 1);
}

TEST_F(WindowStatesTest, AStepThatLowersTheCostIsTakenWhole) {
  EXPECT_EQ(take_back(1), 0);
  expect_aside(0);
  EXPECT_EQ(take_back(1.9), 0) << "also one that goes too far";
  expect_aside(-0.9 * kAside);
}

TEST_F(WindowStatesTest, AStepThatRaisesTheCostIsHalvedUntilItLowersIt) {
  EXPECT_EQ(take_back(3), 1);
  expect_aside(-0.5 * kAside);
}

TEST_F(WindowStatesTest, AStepIsHalvedASecondTime) {
  EXPECT_EQ(take_back(6), 2);
  expect_aside(-0.5 * kAside);
}

TEST_F(WindowStatesTest, AStepIsHalvedAtMostTwice) {
  EXPECT_EQ(take_back(40), 2);
  expect_aside(-9 * kAside);
}

TEST_F(WindowStatesTest, AStepEndsWithinWhatAPlatformCanHave) {
  WindowStates::Change step;
  step.fill(StageVector::Zero());
  step[3][kSlipIndex] = 5;
  states.take(step, window, arrival, kDeviation * StageMatrix::Identity());
  EXPECT_LE(states[3][kSlipIndex], SlipBounds{}.most_friction);
}

}  // namespace
}  // namespace mrroc::rex::test
