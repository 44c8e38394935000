// The pen's automaton on traces of pose and force as the force law makes them.
#include "vsp/pen_state/pen_state_sensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/pose.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kDt = 0.002;
constexpr int kSteps = 10;  // of a macrostep

/// A pen that moves along its axis, somewhere in the base, and everything that its sensor said.
class Pen {
 public:
  explicit Pen(const Vector3& turn = {std::numbers::pi, 0, 0})
      : T_{rotation_from_angle_axis(turn), {0.3, -0.2, 0.9}} {
    rest(0, 0.6);
  }

  /// @param v  speed into the paper [m/s]
  /// @param F  force along the pen [N]
  void move(double v, double F, double seconds) {
    go([v](double) { return v; }, [F](double) { return F; }, seconds);
  }
  void rest(double F, double seconds) { move(0, F, seconds); }
  template <class V, class F>
  void go(V speed, F force, double seconds) {
    const int steps = static_cast<int>(std::lround(seconds / kDt));
    for (int k = 0; k < steps; ++k) {
      const double t = k * kDt;
      depth += speed(t) * kDt;
      step(force(t));
    }
  }
  void step(double F) {
    StepSample s;
    Pose T = T_;
    T.p += T_.R.col(2) * depth + T_.R.col(0) * aside;
    Eigen::Map<AngleAxisPose>(s.T_0E.data()) = angle_axis_from_pose(T);
    s.F_a[Axis::z] = F;
    sensor.step(s);
    if (states.empty() || states.back() != sensor.state()) states.push_back(sensor.state());
    if (++steps_ % kSteps != 0) return;
    const auto read = static_cast<PenState>(sensor.reading().state);
    lift_offs_read += read == PenState::lift_off;
    last_read = read;
  }
  /// Lowers as in m = 4, hits the paper and presses with the force that stands afterwards.
  void touch(double F = 1) {
    move(0.01, 0, 0.5);
    go([](double t) { return 0.01 * std::exp(-t / 0.01); },
       [](double t) { return 3 * (1 - std::exp(-t / 0.004)); }, 0.05);
    go([](double) { return 0; }, [F](double t) { return F + (3 - F) * std::exp(-t / 0.05); }, 0.6);
  }

  PenStateSensor sensor;
  double depth{};
  double aside{};
  std::vector<PenState> states;  ///< each one that was entered
  int lift_offs_read{};
  PenState last_read{};

 private:
  Pose T_;
  int steps_{};
};

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
  pen.rest(6, 0.1);  // taken for a pull
  EXPECT_EQ(pen.sensor.state(), PenState::above_paper);
  pen.move(-0.002, 0, 1.0);  // slowly, to a place elsewhere
  pen.rest(2, 0.4);
  EXPECT_EQ(pen.sensor.state(), PenState::paper_surface);
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

TEST(PenState, APullLiftsOffAtOnce) {
  Pen pen;
  pen.touch();
  pen.rest(1, 1);
  pen.rest(6, 0.05);
  EXPECT_EQ(pen.lift_offs_read, 1);
  EXPECT_NE(std::ranges::find(pen.states, lift_off), pen.states.end());
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
