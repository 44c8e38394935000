// The set point by itself, where a driver does not lead it easily: stops that change hands, and goals that are given up.
#include "edp/step_generator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/axis_command.hpp"
#include "edp/deceleration.hpp"
#include "test/base/random_pose.hpp"
#include "test/edp/fake_arm.hpp"

namespace mrroc::edp::test {
namespace {

using MotionPhase = StepGenerator::MotionPhase;
using mrroc::test::distance;

constexpr double kDt = 0.002;
constexpr int kStopSteps = 40;
const Pose kTool{Matrix3::Identity(), Vector3(0.2, 0, 0.1)};

/// The gantry, whose inverse kinematics finds nothing while it is blind.
class Blinkered final : public Robot {
 public:
  bool blind{};

  [[nodiscard]] std::string_view name() const noexcept override { return arm_.name(); }
  [[nodiscard]] int axes() const noexcept override { return arm_.axes(); }
  [[nodiscard]] const AxisProperties& axis(int k) const noexcept override { return arm_.axis(k); }
  [[nodiscard]] Pose forward(const AxisVector& q) const noexcept override { return arm_.forward(q); }
  [[nodiscard]] InverseSolution inverse(const Pose& T, const AxisVector& near) const noexcept override {
    InverseSolution s = arm_.inverse(T, near);
    s.reached = s.reached && !blind;
    return s;
  }
  [[nodiscard]] AxisVector motors_from_joints(const AxisVector& q) const noexcept override {
    return arm_.motors_from_joints(q);
  }
  [[nodiscard]] AxisVector joints_from_motors(const AxisVector& m) const noexcept override {
    return arm_.joints_from_motors(m);
  }

 private:
  FakeArm arm_;
};

class StepGeneratorTest : public ::testing::Test {
 protected:
  static MotionRules rules(const Robot& robot) {
    MotionRules r{&robot, {}, kDt, kStopSteps};
    r.limits.linear_acceleration = r.limits.angular_acceleration = r.limits.motor_acceleration = 1e6;
    return r;
  }
  void SetUp() override { set_point.stand_at(AxisVector::Zero(FakeArm::kAxes)); }

  /// Begins a motion in the task frame on which the motors go otherwise in each step, and is in the middle of it.
  void turn() {
    ArmCommand a;
    a.frame = {u(0.1), u(0.05), u(), u(), u(), u(1)};
    a.n_s = 200;
    a.n_Q = 199;
    ASSERT_FALSE(set_point.start(a, kTool));
    steps(100);
  }
  /// Begins a way along x of the base.
  void shift(double way, int n_s, Interpolation mu) {
    ArmCommand a;
    a.mu = mu;
    a.reference = Reference::relative;
    a.representation = Representation::xyz_angle_axis;
    a.pose = {way};
    a.n_s = a.n_Q = static_cast<std::uint16_t>(n_s);
    ASSERT_FALSE(set_point.start(a, kTool));
  }
  void steps(int n) {
    for (int k = 0; k < n; ++k) ASSERT_FALSE(set_point.step({})) << k;
  }
  [[nodiscard]] double x() const { return set_point.set_point().T_0E.p.x(); }
  [[nodiscard]] const AxisVector& speed() const { return set_point.set_point().motor_increment; }

  Blinkered arm;
  StepGenerator set_point{rules(arm), kTool};
};

/// How a stop went on: the largest difference of a motor's speed from an even stop, after step 6 [rad].
double unevenness(Blinkered& arm, StepGenerator& set_point, int blind_in_step) {
  AxisVector before = set_point.set_point().motor_increment;
  double most = 0;
  for (int k = 1; k < kStopSteps; ++k) {
    arm.blind = k == blind_in_step;
    EXPECT_FALSE(set_point.step({})) << "a stop goes on";
    const AxisVector& now = set_point.set_point().motor_increment;
    if (k >= 6) most = std::max(most, (now - speed_ratio(k, kStopSteps) * before).cwiseAbs().maxCoeff());
    before = now;
  }
  EXPECT_FALSE(set_point.step({}));
  EXPECT_EQ(set_point.phase(), MotionPhase::standing);
  EXPECT_TRUE(set_point.set_point().motor_increment.isZero(0));
  return most;
}

TEST_F(StepGeneratorTest, MotorsThatHaveTakenOverAStopKeepItThoughTheTaskFrameCouldGoOnAgain) {
  turn();
  set_point.stop();
  EXPECT_GT(unevenness(arm, set_point, 0), 1e-6) << "in the task frame the motors are not even";
  turn();
  set_point.stop();
  EXPECT_LT(unevenness(arm, set_point, 6), 1e-12);
}

TEST_F(StepGeneratorTest, AfterAnErrorTheMotorsStopEvenlyFromTheSpeedThatTheyHaveAndTheGoalIsForgotten) {
  shift(0.06, 100, Interpolation::tcim_pose);
  steps(50);
  const AxisVector before = speed();
  arm.blind = true;
  const std::optional<Fault> wrong = set_point.step({});
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->code, FaultCode::unreachable_pose);
  for (int k = 1; k < kStopSteps; ++k) {
    EXPECT_LT((speed() - remaining_speed(k, kStopSteps) * before).cwiseAbs().maxCoeff(), 1e-12) << k;
    EXPECT_EQ(set_point.phase(), MotionPhase::stopping);
    ASSERT_FALSE(set_point.step({}));
  }
  EXPECT_EQ(set_point.phase(), MotionPhase::standing);
  EXPECT_FALSE(set_point.at_goal());
  arm.blind = false;
  const double stands = x();
  steps(100);
  EXPECT_EQ(x(), stands) << "it does not return to where it was told to be";
}

TEST_F(StepGeneratorTest, InTheTaskFrameAStopBrakesAtOnceHoweverNearTheGoalIs) {
  for (int late = 1; late <= 119; ++late) {
    StepGenerator own = set_point;
    shift(0.06, 100, Interpolation::tcim_pose);
    steps(late);
    set_point.finish();
    set_point.stop();
    const double before = x();
    ASSERT_FALSE(set_point.step({}));
    const double first = x() - before;
    const AxisVector fast = speed();
    int moved = 1;
    for (; set_point.phase() != MotionPhase::standing; ++moved) {
      ASSERT_FALSE(set_point.step({}));
      ASSERT_LT(moved, kStopSteps);
    }
    EXPECT_EQ(moved, kStopSteps) << late;
    EXPECT_FALSE(set_point.at_goal());
    EXPECT_NEAR(x() - before, first / remaining_speed(1, kStopSteps) * stopping_way(kStopSteps), 1e-9)
        << "by the whole way of a stop, after " << late << " steps";
    EXPECT_GT(fast.cwiseAbs().maxCoeff(), 0);
    set_point = own;
  }
}

TEST_F(StepGeneratorTest, AMotionThatBrakesBeforeItsGoalDoesSoAlsoAfterOneThatReturnedToIts) {
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose}) {
    const double start = x();
    shift(0.01, 100, mu);  // 0.05 m/s: it passes its goal a little
    steps(100);
    set_point.finish();
    double farthest = x();
    for (int k = 0; k < 100 && set_point.phase() != MotionPhase::standing; ++k) {
      steps(1);
      farthest = std::max(farthest, x());
    }
    EXPECT_TRUE(set_point.at_goal());
    EXPECT_GT(farthest, start + 0.01 + 1e-5);
    EXPECT_NEAR(x(), start + 0.01, 1e-9);
    shift(0.06, 100, mu);  // 0.3 m/s
    steps(100);
    set_point.finish();
    EXPECT_FALSE(set_point.at_goal()) << "it is still on its way";
    farthest = x();
    int k = 0;
    for (; k < 100 && set_point.phase() != MotionPhase::standing; ++k) {
      steps(1);
      farthest = std::max(farthest, x());
    }
    EXPECT_EQ(k, kStopSteps / 2 + 1) << "half of the stop's steps later, and one in which it is seen";
    EXPECT_TRUE(set_point.at_goal());
    EXPECT_NEAR(x(), start + 0.07, 1e-9);
    EXPECT_LT(farthest, start + 0.07 + 1e-9);
  }
}

TEST_F(StepGeneratorTest, AnotherMotionOnTheWayBackToAGoalEndsAtItsOwn) {
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose}) {
    const double start = x();
    shift(0.01, 100, mu);
    steps(100);
    set_point.finish();
    for (int k = 0; k < 100 && set_point.phase() != MotionPhase::arriving; ++k) steps(1);
    ASSERT_EQ(set_point.phase(), MotionPhase::arriving);
    steps(2);
    shift(0.02, 100, mu);
    EXPECT_EQ(set_point.phase(), MotionPhase::executing);
    steps(100);
    set_point.finish();
    for (int k = 0; k < 200 && set_point.phase() != MotionPhase::standing; ++k) steps(1);
    EXPECT_TRUE(set_point.at_goal());
    EXPECT_NEAR(x(), start + 0.03, 1e-9) << "counted from the goal, not from where it was";
  }
}

TEST_F(StepGeneratorTest, ATaskFrameThatGetsAnotherToolStopsOnItsWayToTheGoalAndReturnsTheWrist) {
  const Pose goal =
      arm.forward(set_point.set_point().axes.joints) * Pose{Matrix3::Identity(), Vector3(0.06, 0, 0)};
  shift(0.06, 100, Interpolation::tcim_pose);
  steps(105);
  set_point.finish();
  ASSERT_EQ(set_point.phase(), MotionPhase::arriving);
  steps(1);
  const Pose wrist = arm.forward(set_point.set_point().axes.joints);
  set_point.set_tool({rotation_from_angle_axis({0, 0, 1}), Vector3(0, 0.1, 0.1)});
  EXPECT_EQ(set_point.phase(), MotionPhase::stopping);
  EXPECT_LT(distance(set_point.set_point().T_0E * set_point.tool_inverse(), wrist), 1e-9)
      << "the wrist stays";
  for (int k = 0; k < 200 && set_point.phase() != MotionPhase::standing; ++k) steps(1);
  EXPECT_LT(distance(arm.forward(set_point.set_point().axes.joints), goal), 1e-9);
}

TEST_F(StepGeneratorTest, AGoalThatCannotBeReachedAnyMoreIsNotReturnedTo) {
  shift(0.01, 100, Interpolation::tcim_pose);  // 0.05 m/s: it would return
  steps(100);
  set_point.finish();
  ASSERT_EQ(set_point.phase(), MotionPhase::stopping);
  arm.blind = true;
  for (int k = 0; k < 200 && set_point.phase() != MotionPhase::standing; ++k) steps(1);
  EXPECT_FALSE(set_point.at_goal());
  const double stands = x();
  EXPECT_GT(std::abs(stands - kTool.p.x() - 0.01), 1e-6);
  steps(50);
  EXPECT_EQ(x(), stands);
}

TEST_F(StepGeneratorTest, WhatStandsNeitherFinishesNorStops) {
  for (int k = 0; k < 2; ++k) {
    set_point.finish();
    set_point.stop();
    EXPECT_EQ(set_point.phase(), MotionPhase::standing);
    steps(3);
    EXPECT_TRUE(speed().isZero(0));
    set_point.stand_at(AxisVector::Constant(FakeArm::kAxes, 3));
    EXPECT_EQ(set_point.set_point().axes.motors, AxisVector::Constant(FakeArm::kAxes, 3));
    EXPECT_LT(distance(set_point.set_point().T_0E,
                       arm.forward(arm.joints_from_motors(AxisVector::Constant(FakeArm::kAxes, 3))) * kTool),
              1e-12);
  }
}

}  // namespace
}  // namespace mrroc::edp::test
