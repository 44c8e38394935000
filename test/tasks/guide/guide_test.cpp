#include "tasks/guide/guide.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/representation.hpp"

namespace mrroc::guide {
namespace {

using X = Arm::X;

constexpr double kAge = 0.008;  // [s] of a macrostep

Setup line_setup() {
  Setup k;
  k.fixture = {{Matrix3::Identity(), {0.9, 0, 1}}, Curve({{-0.06, 0}, {0.06, 0}}, false, 0)};
  k.T_WE = {Matrix3::Identity(), {0, 0, 0.25}};
  return k;
}

/// The tool is there, and points down.
X image(const Vector3& p, const Setup& k = line_setup()) {
  X x;
  x.c.k = std::make_shared<const Setup>(k);
  const Vector6 r = angle_axis_from_pose({rotation_from_angle_axis({3.14159265358979, 0, 0}), p});
  std::ranges::copy(r, x.e.T_0E.begin());
  x.e.position_known = true;
  return x;
}

const Motion<Arm>& row(int m) { return kGuide[static_cast<std::size_t>(m) - 1]; }

TaskFrameCommand command(int m, X x, double age) {
  x.c = row(m).f_entry(x);
  x.i = x.i_0 + std::llround(age / kAge);
  return row(m).f_ce(x).arm.frame;
}

TEST(Guide, TakesHoldOfAToolThatIsNear) {
  EXPECT_TRUE(row(1).f_tau(image({0.9, 0.004, 1})));
  EXPECT_FALSE(row(1).f_tau(image({0.9, 0.006, 1})));
  EXPECT_FALSE(row(1).f_tau(image({0.97, 0, 1}))) << "not beyond its end";
}

TEST(Guide, IsFreeBeforeAndAfterTheFixtureHolds) {
  for (const int m : {1, kAway})
    for (const Axis a : {Axis::x, Axis::y, Axis::z})
      EXPECT_EQ(command(m, image({0.9, 0.01, 1}), 1)[a], c(0, Law{}.free_inertia, Law{}.free_mobility)) << m;
}

TEST(Guide, HoldsAcrossWithItsStiffnessAndLeavesTheToolFreeAlong) {
  const TaskFrameCommand frame = command(kGuided, image({0.92, 0.001, 0.9995}), 0);
  EXPECT_EQ(frame.x.force, 0);
  EXPECT_EQ(frame.x.mobility, Law{}.free_mobility);
  EXPECT_NEAR(frame.y.force, -20, 1e-6) << "20 N/mm";
  EXPECT_NEAR(frame.z.force, 10, 1e-6);
  EXPECT_EQ(frame.z.mobility, Law{}.mobility);
  EXPECT_EQ(frame.az, u()) << "it does not turn";
}

TEST(Guide, PushesBackAtBothEnds) {
  EXPECT_LT(command(kGuided, image({0.965, 0, 1}), 0).x.force, -15);
  EXPECT_GT(command(kGuided, image({0.835, 0, 1}), 0).x.force, 15);
}

TEST(Guide, GrowsAndGoesInItsTimes) {
  const X x = image({0.9, 0.001, 1});
  double before = 0;
  for (double t = 0; t < 1; t += 0.1) {
    const double in = -command(kEnter, x, t).y.force, out = -command(kLeave, x, 1 - t).y.force;
    EXPECT_GE(in, before);
    EXPECT_NEAR(in, out, 0.3) << t << ": a macrostep more or less";
    before = in;
  }
  EXPECT_NEAR(-command(kEnter, x, 1).y.force, 20, 0.1);
  EXPECT_EQ(command(kLeave, x, 1).y.force, 0);
}

TEST(Guide, GoesOnWhenTheFixtureHasGrownAndItsForceIsSmallEnough) {
  const auto entered = [](double off, double age) {
    X x = image({0.9, off, 1});
    x.i = std::llround(age / kAge);
    return row(kEnter).f_tau(x);
  };
  EXPECT_TRUE(entered(0.001, 1));
  EXPECT_FALSE(entered(0.001, 0.9));
  EXPECT_FALSE(entered(0.004, 5)) << "80 N would come at once: the operator still holds against it";
}

TEST(Guide, EndsAndLetsGoWhenTold) {
  for (const int m : {kGuided, kAway}) {
    X x = image({0.9, 0, 1});
    x.i = 10'000;
    EXPECT_FALSE(row(m).f_tau(x));
    x.T.go_on[0] = true;
    EXPECT_TRUE(row(m).f_tau(x));
  }
}

TEST(Guide, TurnsTheToolsFrameIntoTheCurveAndKeepsTheWrist) {
  guide::Setup k = line_setup();
  Points round;
  for (int n = 0; n < 720; ++n)
    round.emplace_back(0.04 * std::cos(n * M_PI / 360), 0.04 * std::sin(n * M_PI / 360));
  k.fixture = {{Matrix3::Identity(), {0.9, 0, 1}}, Curve(round, true, 0)};
  X x = image({0.9, 0.04, 1}, k);
  x.c = row(kEnter).f_entry(x);
  const EffectorCommand y = row(kGuided).f_ce(x);
  ASSERT_TRUE(y.robot_model.set_tool);
  const Pose T_WE = *pose_from_numbers(y.robot_model.tool_representation, y.robot_model.tool);
  EXPECT_EQ(T_WE.p, k.T_WE.p) << "the tip stays";
  const Matrix3 R_0E = pose_of(x.e).R * k.T_WE.R.transpose() * T_WE.R;
  EXPECT_LT((R_0E.col(0) - Vector3(-1, 0, 0)).norm(), 1e-3) << "x is the tangent";
  EXPECT_LT((R_0E.col(2) - Vector3(0, 0, 1)).norm(), 1e-9);
}

TEST(Guide, FollowsItsPlaceAndHowFastItGoes) {
  X x = image({0.9, 0, 1});
  x.c = row(kEnter).f_entry(x);
  EXPECT_NEAR(x.c.s, 0.06, 1e-9);
  for (int n = 1; n < 50; ++n) {
    const Memory before = x.c;
    x = image({0.9 + 0.0004 * n, 0, 1});
    x.c = before;
    x.c.k = std::make_shared<const guide::Setup>(line_setup());
    x.c = row(kGuided).f_cc(x);
  }
  EXPECT_NEAR(x.c.s, 0.06 + 0.0004 * 49, 1e-6);
  EXPECT_NEAR(x.c.way, 0.0004, 1e-6);
}

}  // namespace
}  // namespace mrroc::guide
