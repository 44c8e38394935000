// The pen's automaton at the very thresholds, with numbers that are exact in binary; and what it forgets at a jump.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "vsp/pen_state/pen_state_sensor.hpp"

namespace mrroc::vsp {
namespace {

using enum PenState;

constexpr double kDt = 1.0 / 512;       // [s]
constexpr double kSpeed = 1.0 / 256;    // unit of speeds [m/s]
constexpr double kWay = kSpeed * kDt;   // in one step at this speed [m]
constexpr double kLittle = 1.0 / 1024;  // [N]

/// Without filters: v = w and F = M F are those of the last step.
PenStateParameters exact() {
  PenStateParameters k;
  k.dt = k.tremor_period = kDt;
  k.v_filter = k.F_filter = kDt / 2;
  k.lowering_speed = 4 * kSpeed;
  k.braked_speed = 2 * kSpeed;
  k.rest_speed = kSpeed;
  k.rest_time = k.rest_force_time = 4 * kDt;
  k.touch_height = 128 * kWay;
  k.lift_height = 256 * kWay;
  k.sink_depth = 64 * kWay;
  k.impact_force = k.rest_force = 1;
  k.impact_time = 2 * kDt;
  k.stop_share = 0.5;
  k.stop_force = 0.5;
  return k;
}

class PenExact : public testing::Test {
 protected:
  /// @param speed  in units, positive into the paper
  PenState go(double speed, double F, int steps = 1) {
    for (int k = 0; k < steps; ++k) {
      sample_.T_0E[2] += speed * kWay;
      sample_.F_a[Axis::z] = F;
      sensor_.step(sample_);
    }
    return sensor_.state();
  }
  void settle(const PenStateParameters& k = exact()) {
    sensor_ = PenStateSensor(k);
    sample_ = {};
    go(0, 0, 8);
    ASSERT_EQ(sensor_.state(), above_paper);
  }
  void lower(const PenStateParameters& k = exact()) {
    settle(k);
    ASSERT_EQ(go(8, 0, 8), lowering);
  }
  /// On the paper, at height 0.
  void land(const PenStateParameters& k = exact()) {
    lower(k);
    ASSERT_EQ(go(0, 2), paper_surface);
    go(0, 1, 20);
    ASSERT_EQ(sensor_.reading().value[0], 0);
  }
  /// Above paper that is known, lowered at a speed of 8 from far above to a height of so many ways.
  void lower_to(int ways) {
    land();
    ASSERT_EQ(go(-264, 0), lift_off);
    go(-8, 0, 95);
    ASSERT_EQ(go(0, 0, 2), above_paper);
    ASSERT_EQ(go(8, 0, (1024 - ways) / 8), lowering);
    ASSERT_EQ(sensor_.reading().value[0], ways * kWay);
  }

  PenStateSensor sensor_{exact()};
  StepSample sample_;
};

TEST_F(PenExact, SettlesAfterMoreThanTheRestTime) {
  go(0, 0, 4);
  EXPECT_EQ(go(8, 0, 2), above_paper);
  go(0, 0, 4);
  EXPECT_EQ(go(8, 0, 2), above_paper);
  go(0, 0, 5);
  EXPECT_EQ(go(8, 0), lowering);
}

TEST_F(PenExact, RestsBelowTheRestSpeed) {
  go(0, 0);
  go(1, 0, 20);
  go(-1, 0, 20);
  EXPECT_EQ(go(8, 0), above_paper);
  go(0.75, 0, 5);
  EXPECT_EQ(go(8, 0), lowering);
}

TEST_F(PenExact, LowersAboveTheLoweringSpeed) {
  settle();
  EXPECT_EQ(go(4, 0, 9), above_paper);
  EXPECT_EQ(go(4.25, 0), lowering);
}

TEST_F(PenExact, LoweringEndsWhenItGoesUpFasterThanTheBrakedSpeed) {
  lower();
  EXPECT_EQ(go(-2, 0, 9), lowering);
  EXPECT_EQ(go(-2.25, 0), above_paper);
}

TEST_F(PenExact, LoweringEndsAfterMoreThanTheRestTime) {
  lower();
  EXPECT_EQ(go(0, 0, 4), lowering);
  EXPECT_EQ(go(1, 0), lowering) << "moves again";
  EXPECT_EQ(go(0.5, 0, 4), lowering);
  EXPECT_EQ(go(-0.5, 0), above_paper);
}

TEST_F(PenExact, PressesAboveTheRestForceForMoreThanItsTime) {
  settle();
  EXPECT_EQ(go(0, 1, 40), above_paper) << "the very force";
  EXPECT_EQ(go(0, 1 + kLittle, 4), above_paper) << "the very time";
  EXPECT_EQ(go(1, 1 + kLittle, 9), above_paper) << "the very speed: it does not rest";
  EXPECT_EQ(go(-0.5, 1 + kLittle, 4), above_paper);
  EXPECT_EQ(go(-0.5, 1 + kLittle), paper_surface);
}

// Going up a little begins the fall again: there is no stop, and the force grows too slowly for an impact.
TEST_F(PenExact, PressingEndsALoweringToo) {
  for (const double F : {1.0, 1 + kLittle}) {
    lower();
    for (const double rising : {0.5, 0.75, 0.875, F}) ASSERT_EQ(go(-1, rising), lowering);
    EXPECT_EQ(go(0.5, F, 4), lowering);
    EXPECT_EQ(go(0.5, F), F > 1 ? paper_surface : above_paper);
  }
}

TEST_F(PenExact, AnImpactRaisesTheForceByMoreThanItsForceInItsTime) {
  lower();
  EXPECT_EQ(go(8, 1), lowering);
  EXPECT_EQ(go(8, 0, 3), lowering);
  EXPECT_EQ(go(8, 0.5), lowering);
  EXPECT_EQ(go(8, 1), lowering) << "in two steps by the very force";
  EXPECT_EQ(go(8, 1.25), lowering) << "more, in three steps";
  EXPECT_EQ(go(8, 0, 3), lowering);
  EXPECT_EQ(go(8, 0.75), lowering);
  EXPECT_EQ(go(8, 1 + kLittle), paper_surface);
}

// A force that grows by a 32nd of a newton in every step.
TEST_F(PenExact, AnImpactTakesFromOneToFiftySteps) {
  const auto touches = [this](int steps, double in_steps) {
    PenStateParameters k = exact();
    k.impact_time = steps * kDt;
    k.impact_force = in_steps / 32;
    lower(k);
    for (int n = 1; n <= 100; ++n)
      if (go(8, n / 32.0) == paper_surface) return true;
    return false;
  };
  for (const int steps : {1, 2, 7, 49, 50}) {
    EXPECT_TRUE(touches(steps, steps - 0.5)) << steps;
    EXPECT_FALSE(touches(steps, steps)) << steps;
  }
  EXPECT_TRUE(touches(0, 0.5)) << "one step at least";
  EXPECT_FALSE(touches(0, 1));
  EXPECT_TRUE(touches(60, 49.5)) << "fifty at most";
  EXPECT_FALSE(touches(60, 50));
}

// It has gone at 8: at less than 4, and pressed with more than 0.5 above the least force.
TEST_F(PenExact, AStopIsBelowItsShareOfTheSpeedAndAboveItsForce) {
  lower();
  go(8, -0.25, 2);
  EXPECT_EQ(go(4, 0.5, 3), lowering);
  EXPECT_EQ(go(3.75, 0.25, 3), lowering);
  EXPECT_EQ(go(3.75, 0.25 + kLittle), paper_surface);
}

TEST_F(PenExact, AStopIsOneOfALoweringAboveItsSpeed) {
  settle();
  ASSERT_EQ(go(4.25, 0), lowering);
  EXPECT_EQ(go(2, 0.75), paper_surface);
}

TEST_F(PenExact, WhatWasLoweredBeforeItWentUpIsNoPartOfAStop) {
  lower();
  EXPECT_EQ(go(-1, -0.5, 2), lowering) << "the fall begins again here, with this force";
  EXPECT_EQ(go(4, 0.5), lowering) << "0.5 and 4 are no part of a stop";
  EXPECT_EQ(go(1.5, 0), lowering) << "nothing was faster than lowering";
  EXPECT_EQ(go(5, -0.5), lowering);
  EXPECT_EQ(go(2, 0.25), paper_surface);
}

TEST_F(PenExact, TouchesKnownPaperBelowTheTouchHeight) {
  lower_to(136);
  EXPECT_EQ(go(1, 0, 8), lowering) << "at the very height";
  EXPECT_EQ(go(1, 0), paper_surface);
}

TEST_F(PenExact, TouchesKnownPaperBelowTheBrakedSpeed) {
  lower_to(128);
  EXPECT_EQ(go(2, 0, 4), lowering) << "the very speed";
  EXPECT_EQ(go(1.75, 0), paper_surface);
}

TEST_F(PenExact, LiftsOffAboveTheLiftHeight) {
  land();
  EXPECT_EQ(go(-256, 1), paper_surface);
  EXPECT_EQ(sensor_.reading().state, static_cast<int>(paper_surface));
  land();
  EXPECT_EQ(go(-257, 1), lift_off);
  EXPECT_EQ(go(-1, 1), above_paper);
  EXPECT_EQ(sensor_.reading().state, static_cast<int>(lift_off));
  EXPECT_EQ(sensor_.reading().state, static_cast<int>(above_paper));
}

TEST_F(PenExact, SinksByMoreThanItsDepthAndFasterThanItLowers) {
  land();
  EXPECT_EQ(go(64, 1), paper_surface) << "the very depth";
  land();
  EXPECT_EQ(go(65, 1), lowering);
  PenStateParameters k = exact();
  k.sink_depth = kWay;
  land(k);
  EXPECT_EQ(go(4, 1), paper_surface) << "the very speed";
  land(k);
  EXPECT_EQ(go(4.25, 1), lowering);
}

TEST_F(PenExact, ASensorThatJumpedIsAsNew) {
  std::mt19937 random(6);
  std::uniform_real_distribution<> any(-1, 1);
  for (int run = 0; run < 20; ++run) {
    PenStateParameters k;
    k.rest_time = 0.02;
    k.rest_force_time = 0.01;
    k.tremor_period = 0.03;
    PenStateSensor old(k);
    const auto trace = [&](double z, auto take) {
      StepSample s;
      s.T_0E = {0.1, 0.2, z, 0.3, -0.2, 0.1};
      for (int part = 0; part < 12; ++part) {
        const double v = part % 4 == 0 ? 0 : 0.03 * any(random),
                     F = part % 3 == 0 ? 3 * any(random) : any(random);
        for (int n = 0; n < 12 + run; ++n) {
          s.T_0E[2] += 0.002 * v;
          s.T_0E[0] += 0.0001 * any(random);
          s.F_a[Axis::z] = F + 0.1 * any(random);
          take(s);
        }
      }
    };
    trace(0, [&](const StepSample& s) { old.step(s); });
    (void)old.reading();
    PenStateSensor fresh(k);
    int step = 0;
    trace(1, [&](const StepSample& s) {
      old.step(s);
      fresh.step(s);
      ASSERT_EQ(old.state(), fresh.state()) << run << ' ' << step;
      const SensorReading a = old.reading(), b = fresh.reading();
      ASSERT_EQ(a.state, b.state) << run << ' ' << step;
      for (std::size_t n = 0; n < 3; ++n) ASSERT_EQ(a.value[n], b.value[n]) << run << ' ' << step << ' ' << n;
      ++step;
    });
  }
}

// Of forces within forty steps, after a jump that is at rest for five: what was before it is no past of the pen.
TEST_F(PenExact, ForcesFromBeforeAJumpAreNoPartOfAnImpact) {
  PenStateParameters k = exact();
  k.impact_time = 40 * kDt;
  k.tremor_period = 20 * kDt;
  settle(k);
  for (int n = 0; n < 60; ++n) go(0, n % 2 == 0 ? 20 : -20);
  sample_.T_0E[2] += 1;
  ASSERT_EQ(go(0, -20, 6), above_paper);
  ASSERT_EQ(go(8, -20, 3), lowering) << "no force has risen";
  EXPECT_EQ(go(8, -19 + kLittle), paper_surface) << "and no tremor hides it";
}

TEST_F(PenExact, AStopCountsNothingFromBeforeAJump) {
  lower();
  go(8, -5, 2);
  sample_.T_0E[2] += 1;
  go(0, 0);
  ASSERT_EQ(go(0.5, 0, 6), above_paper) << "it never goes up";
  ASSERT_EQ(go(5, 0), lowering);
  EXPECT_EQ(go(2, 0.25), lowering) << "a force of 0.25, not of 5.25";
  EXPECT_EQ(go(2, 0.75), paper_surface);
}

// From its first point every sheet is level there.
TEST(TouchedPlaneExact, GoesThroughItsOnlyPoint) {
  TouchedPlane plane({});
  std::mt19937 random(7);
  std::uniform_real_distribution<> any(-1, 1);
  for (int run = 0; run < 50; ++run) {
    const Vector3 p(any(random), any(random), any(random));
    plane.add(p, 0.002);
    EXPECT_EQ(plane.depth(p), p.z()) << run;
    EXPECT_EQ(plane.depth(p + Vector3(0.1, -0.2, 3)), p.z()) << run;
    TouchedPlane fresh({});
    fresh.add(p, 0.002);
    EXPECT_EQ(plane.deviation(p + Vector3(0.1, -0.2, 3)), fresh.deviation(p + Vector3(0.1, -0.2, 3))) << run;
    plane.forget();
  }
}

}  // namespace
}  // namespace mrroc::vsp
