// The pen's automaton on traces of pose and force as the force law makes them.
#include "vsp/pen_state/pen_state_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/pose.hpp"
#include "test/vsp/pen.hpp"

namespace mrroc::vsp {
namespace {

using test::kDt;
using test::kSteps;
using test::Pen;
using enum PenState;
using States = std::vector<PenState>;

TEST(PenState, AStrokePassesThroughAllStatesInTheirOrder) {
  for (const Vector3& turn : {Vector3(std::numbers::pi, 0, 0), Vector3(0, 0, 0), Vector3(1, -0.5, 2)}) {
    Pen pen(turn);
    pen.touch();
    EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface}));
    pen.rest(1, 2);
    pen.move(-0.01, 0, 0.5);
    EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface, lift_off, above_paper}));
    EXPECT_EQ(pen.lift_offs_read, 1);
    EXPECT_EQ(pen.last_read, above_paper);
  }
}

TEST(PenState, AnImpactIsSeenWithinTwoMacrosteps) {
  Pen pen;
  pen.move(0.01, 0, 0.5);
  ASSERT_EQ(pen.sensor.state(), lowering);
  pen.go([](double t) { return 0.01 * std::exp(-t / 0.01); },
         [](double t) { return 3 * (1 - std::exp(-t / 0.004)); }, 0.04);
  EXPECT_EQ(pen.sensor.state(), paper_surface);
}

TEST(PenState, ASoftLandingIsSeenToo) {
  Pen pen;
  pen.move(0.006, 0, 0.3);
  pen.go([](double t) { return 0.006 * std::exp(-t / 0.1); },
         [](double t) { return 2 * (1 - std::exp(-t / 0.3)); }, 1.5);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface}));
}

TEST(PenState, ABounceIsNoLiftOff) {
  Pen pen;
  pen.move(0.01, 0, 0.5);
  pen.go([](double t) { return 0.01 * std::exp(-t / 0.01); },
         [](double t) { return 4 * (1 - std::exp(-t / 0.004)); }, 0.02);
  pen.go([](double t) { return -0.02 * std::sin(50 * t) * std::exp(-t / 0.08); },
         [](double t) { return 1 + 3 * std::cos(50 * t) * std::exp(-t / 0.08); }, 0.3);
  pen.rest(1, 1);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface}));
  EXPECT_EQ(pen.lift_offs_read, 0);
}

TEST(PenState, AHandThatBrakesInTheAirTouchesNothing) {
  // Led by the force law the pen moves at B F: braking changes the force of the hand by v / B, slowly.
  Pen pen;
  pen.go([](double t) { return 0.01 * std::min(1.0, t / 0.2); },
         [](double t) { return 0.5 * std::min(1.0, t / 0.2); }, 0.6);
  ASSERT_EQ(pen.sensor.state(), lowering);
  pen.go([](double t) { return 0.01 * std::max(0.0, 1 - t / 0.2); },
         [](double t) { return 0.5 * std::max(0.0, 1 - t / 0.2); }, 0.3);
  pen.rest(0, 1);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, above_paper}));
}

TEST(PenState, AJerkInTheAirThatLooksLikeATouchIsForgottenWhenThePenIsLowered) {
  Pen pen;
  pen.move(0.01, 0, 0.3);
  pen.go([](double) { return 0; }, [](double t) { return t < 0.03 ? 3 : 0; }, 0.6);
  ASSERT_EQ(pen.sensor.state(), PenState::paper_surface);  // nothing tells it from an impact
  pen.move(0.01, 0, 0.5);
  EXPECT_EQ(pen.sensor.state(), PenState::lowering);
  EXPECT_EQ(pen.lift_offs_read, 0);
  pen.touch();
  EXPECT_EQ(pen.sensor.state(), PenState::paper_surface);
}

TEST(PenState, APenThatPressesAtRestIsOnThePaperWhateverWasBefore) {
  Pen pen;
  pen.touch();
  pen.move(-0.01, 0, 0.5);  // to another sheet, 5 mm higher
  ASSERT_EQ(pen.sensor.state(), PenState::above_paper);
  pen.rest(1, 0.6);  // nothing but what F_d = 1 N would leave in the air
  EXPECT_EQ(pen.sensor.state(), PenState::above_paper);
  pen.rest(2, 1);
  EXPECT_EQ(pen.sensor.state(), PenState::paper_surface);
}

// A twitch of the hand: fast for a moment, and at rest in the mean. The rest counts from where the lowering begins,
// however long the pen has rested above the paper before.
TEST(PenState, ALoweringThatIsAtRestForHalfASecondHasEnded) {
  for (const double before : {0., 0.3, 2.}) {
    Pen pen;
    pen.rest(0, before);
    pen.move(0.02, 0, 0.008);
    ASSERT_EQ(pen.sensor.state(), lowering);
    pen.rest(0, 0.48);
    EXPECT_EQ(pen.sensor.state(), lowering) << "after " << before << " s of rest";
    pen.rest(0, 0.04);
    EXPECT_EQ(pen.sensor.state(), above_paper) << "after " << before << " s of rest";
    EXPECT_EQ(pen.states, (States{above_paper, lowering, above_paper}));
  }
}

TEST(PenState, LoweringThatTurnsBackEndsAboveThePaper) {
  Pen pen;
  pen.move(0.01, 0, 0.3);
  pen.move(-0.01, 0, 0.3);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, above_paper}));
}

TEST(PenState, APauseInLoweringLosesNothing) {
  Pen pen;
  pen.move(0.01, 0, 0.3);
  pen.rest(0, 5);  // longer than any time of the automaton
  pen.touch();
  EXPECT_EQ(pen.states.back(), paper_surface);
  EXPECT_EQ(pen.lift_offs_read, 0);
}

TEST(PenState, AForceAloneLiftsNothingOff) {  // a hand that trembles pulls with more than any threshold
  Pen pen;
  pen.touch();
  pen.go([](double) { return 0; }, [](double t) { return 1 + 9 * std::sin(50 * t); }, 2);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface}));
}

TEST(PenState, ASlowSteadyLiftIsALiftOff) {  // the paper does not follow a rising pen
  for (const double speed : {0.0005, 0.001, 0.003}) {
    Pen pen;
    pen.touch();
    pen.rest(1, 3);
    pen.move(-speed, 1, 0.004 / speed);
    EXPECT_EQ(pen.lift_offs_read, 1) << speed;
    EXPECT_EQ(pen.sensor.state(), above_paper) << speed;
  }
}

TEST(PenState, AJumpWithAnotherForceIsNoImpact) {  // its history of force is that of the frame before
  Pen pen;
  pen.move(0.01, 0, 0.4);
  ASSERT_EQ(pen.sensor.state(), lowering);
  pen.depth += 0.3;
  pen.move(0.01, 5, 0.4);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, above_paper}));
}

TEST(PenState, ATremorTouchesNothingAndLiftsNothing) {
  for (const double frequency : {4., 6.3, 8., 12.}) {
    const double omega = 2 * std::numbers::pi * frequency;
    // Law (28): a force of the hand moves the pen by v = F / (1/B + I s).
    const double force = 5, mass = 20, damper = 200;
    const double speed = force / std::hypot(damper, mass * omega), lag = std::atan2(mass * omega, damper);
    const auto v = [&](double t) { return speed * std::sin(omega * t - lag); };
    const auto F = [&](double t) { return -force * std::sin(omega * t); };
    Pen pen;
    pen.go(v, F, 3);  // above the paper
    pen.go([&](double t) { return 0.012 + v(t); }, F, 0.5);
    EXPECT_EQ(std::ranges::count(pen.states, paper_surface), 0) << frequency;
    Pen drawn;
    drawn.touch();
    drawn.go(
        v, [&](double t) { return 1 + F(t); }, 5);
    EXPECT_EQ(drawn.lift_offs_read, 0) << frequency;
    EXPECT_EQ(drawn.sensor.state(), paper_surface) << frequency;
  }
}

TEST(PenState, OnPaperThatIsKnownATouchNeedsNoImpact) {
  Pen pen;
  pen.touch();
  pen.rest(1, 1);
  pen.move(-0.01, 0, 1);
  ASSERT_EQ(pen.sensor.state(), above_paper);
  pen.move(0.01, 0, 0.95);
  pen.rest(0, 0.1);
  EXPECT_EQ(pen.sensor.state(), paper_surface);
}

TEST(PenState, FarAboveKnownPaperNothingIsATouch) {
  Pen pen;
  pen.touch();
  pen.rest(1, 1);
  pen.move(-0.015, 0, 1);
  pen.move(0.01, 0, 0.3);
  pen.go([](double) { return 0; }, [](double t) { return 5 * (1 - std::exp(-t / 0.004)); }, 0.1);  // a blow
  pen.rest(0, 1);
  EXPECT_EQ(pen.sensor.state(), above_paper);
  EXPECT_EQ(std::ranges::count(pen.states, paper_surface), 1);
}

TEST(PenState, ASheetThatIsNotLevelIsFollowed) {
  Pen pen;
  pen.touch();
  const double slope = 0.03, speed = 0.02;
  pen.go([&](double) { return slope * speed; },
         [&](double t) {
           pen.aside = speed * t;
           return 1;
         },
         5);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface}));
  EXPECT_NEAR(pen.sensor.reading().value[0], 0, 2e-4);
}

TEST(Trend, PassesASlopeWithADelayAndNoTremor) {
  for (const double frequency : {4., 5., 7.3, 12.}) {
    Trend trend(125);
    trend.begin(0);
    double swing = 0;
    for (int k = 0; k < 2000; ++k) {
      const double t = k * kDt;
      trend.add(3 * t + std::sin(2 * std::numbers::pi * frequency * t));
      if (k > 500) swing = std::max(swing, std::abs(trend.value() - 3 * (t - 0.25)));
    }
    EXPECT_LT(swing, 0.06) << frequency;  // 0.05, and half a sample of the slope
    EXPECT_NEAR(trend.rate() / kDt, 3, 0.05 * 2 * std::numbers::pi * frequency) << frequency;
  }
}

TEST(TouchedPlane, KnowsWhereItHasBeenTouchedAndLessElsewhere) {
  TouchedPlane plane({});
  EXPECT_FALSE(plane.known());
  EXPECT_TRUE(std::isinf(plane.deviation({0, 0, 0})));
  const auto z = [](double x, double y) { return 0.5 + 0.02 * x - 0.01 * y; };
  for (int k = 0; k < 1000; ++k) plane.add({1e-4 * k, 0, z(1e-4 * k, 0)}, kDt);
  const double on_line = plane.deviation({0.05, 0, 0}), aside = plane.deviation({0.05, 0.05, 0});
  EXPECT_LT(on_line, 5e-4);
  EXPECT_NEAR(aside, 0.05 * 0.02, 3e-4);  // the slope that nobody has touched yet
  EXPECT_NEAR(plane.depth({0.05, 0, 0}), z(0.05, 0), 2e-4);
  for (int k = 0; k < 1000; ++k) plane.add({1e-4 * k, 0.06, z(1e-4 * k, 0.06)}, kDt);
  EXPECT_LT(plane.deviation({0.05, 0.05, 0}), aside / 2);
  EXPECT_NEAR(plane.depth({0.05, 0.05, 0}), z(0.05, 0.05), 2e-4);
  plane.forget();
  EXPECT_FALSE(plane.known());
}

TEST(PenState, ALiftOffIsReadOnceThoughItLastsOneStep) {
  for (int phase = 0; phase < kSteps; ++phase) {
    Pen pen;
    for (int k = 0; k < phase; ++k) pen.step(0);
    pen.touch();
    pen.move(-0.01, 0, 0.4);
    EXPECT_EQ(pen.lift_offs_read, 1) << phase;
  }
}

TEST(PenState, DrawingOnWavyPaperIsNoLiftOff) {
  Pen pen;
  pen.touch();
  pen.go([](double t) { return 0.001 * std::sin(2 * t); },
         [&pen](double t) {
           pen.aside = 0.02 * t;
           return 1 + 0.3 * std::sin(20 * t);
         },
         6);
  EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface}));
  EXPECT_EQ(pen.lift_offs_read, 0);
}

TEST(PenState, TravelAboveThePaperTouchesNothing) {
  Pen pen;
  pen.go([](double) { return 0; },
         [&pen](double t) {
           pen.aside = 0.05 * std::sin(t);
           return 0.2 * std::sin(30 * t);
         },
         5);
  EXPECT_EQ(pen.states, (States{above_paper}));
}

TEST(PenState, AnArmThatHasNotComeToRestYetIsNotJudged) {
  PenStateSensor sensor;
  double depth = 0;
  for (int k = 0; k < 500; ++k) {  // sags while its brakes open, with a force that is not biased yet
    depth += 0.02 * kDt;
    StepSample s;
    s.T_0E[2] = depth;
    s.F_a[Axis::z] = 10.0 * (k % 50 > 25);
    sensor.step(s);
    ASSERT_EQ(sensor.state(), above_paper) << k;
  }
}

TEST(PenState, ANewFrameIsNoMotion) {
  Pen pen;
  pen.depth += 0.3;  // synchronised, or another tool
  pen.rest(0, 1);
  EXPECT_EQ(pen.states, (States{above_paper}));
}

TEST(PenState, ANewFrameOnThePaperBeginsAboveItAndJudgesNothingUntilThePenIsAtRest) {
  Pen pen;
  pen.touch();
  pen.rest(1.5, 1);
  ASSERT_EQ(pen.sensor.state(), paper_surface);
  pen.depth += 0.3;
  pen.step(1.5);
  EXPECT_EQ(pen.sensor.state(), above_paper);
  pen.move(0.02, 0, 0.5);  // moves on without having been at rest
  EXPECT_EQ(pen.sensor.state(), above_paper);
  EXPECT_EQ(pen.sensor.reading().value[0], 0) << "no plane is known in the new frame";
  pen.rest(0, 1);
  pen.touch();
  EXPECT_EQ(pen.states, (States{above_paper, lowering, paper_surface, above_paper, lowering, paper_surface}));
}

TEST(PenState, ReadingCarriesHeightSpeedAndForce) {
  Pen pen;
  EXPECT_FALSE(PenStateSensor().reading().valid);
  pen.touch();
  pen.rest(1, 2);
  SensorReading r = pen.sensor.reading();
  EXPECT_TRUE(r.valid);
  EXPECT_NEAR(r.value[0], 0, 1e-5);
  EXPECT_NEAR(r.value[1], 0, 1e-6);
  EXPECT_NEAR(r.value[2], 1, 1e-3);
  pen.move(-0.01, 0, 0.5);
  r = pen.sensor.reading();
  EXPECT_NEAR(r.value[0], 0.005, 1e-4);
  EXPECT_NEAR(r.value[1], -0.01, 1e-4);
  EXPECT_NEAR(r.value[2], 0, 1e-3);
}

}  // namespace
}  // namespace mrroc::vsp
