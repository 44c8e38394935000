// The inverse kinematics where it has no solution, or infinitely many.
#include <limits>

#include "test/robots/irb6/arms.hpp"

namespace mrroc::irb6::test {
namespace {

using Inverse = Irb6;
INSTANTIATE_TEST_SUITE_P(Arms, Inverse, kTrackKept, arm_case_name);

TEST_P(Inverse, SaysHowFarAPoseIsOutOfReach) {
  const Lengths& a = arm_.parameters().lengths;
  for (int k = 0; k < 1000; ++k) {
    // Hand level, shoulder to wrist pitch axis along a ray at the elevation e.
    const double e = uniform(-1.5, 1.5), beyond = uniform(1e-6, 3);
    const double q1 = uniform(-2.5, 2.5);
    const double reach = a.a2 + a.a3 + beyond;
    AxisVector near = arm_.front();
    near[first_] = q1;
    near[first_ + 3] = -near[first_ + 1] - near[first_ + 2] - kPi / 2;
    Pose T = arm_.forward(near);  // theta4 = 0
    const double radius = reach * std::cos(e) + a.d5;
    const double y_track = first_ == 1 ? near[0] : 0;
    T.p << radius * std::cos(q1), radius * std::sin(q1) + y_track, a.z_offset + reach * std::sin(e);

    const edp::InverseSolution s = arm_.inverse(T, near);
    ASSERT_FALSE(s.reached);
    ASSERT_NEAR(s.missing, beyond, 1e-9);
    ASSERT_TRUE(s.joints.allFinite());
    ASSERT_NEAR((arm_.forward(s.joints).p - T.p).norm(), beyond, 1e-9)
        << "the arm does not stretch towards it";
  }
}

// Hand level, so close above the shoulder that the arm cannot fold to either end of the hand.
TEST_P(Inverse, RefusesAPoseTooCloseToTheShoulder) {
  const Lengths& a = arm_.parameters().lengths;
  AxisVector near = arm_.front();
  near[first_ + 3] = -near[first_ + 1] - near[first_ + 2] - kPi / 2;
  Pose T = arm_.forward(near);
  T.p << 0.005, first_ == 1 ? near[0] : 0, a.z_offset;
  const edp::InverseSolution s = arm_.inverse(T, near);
  EXPECT_FALSE(s.reached);
  EXPECT_NEAR(s.missing, a.a3 - a.a2 - a.d5 - 0.005, 1e-12);
}

TEST_P(Inverse, ReachesTheVeryEdge) {
  AxisVector q = arm_.front();
  for (const double elbow : {-kPi / 2, kPi / 2}) {
    q[first_ + 2] = elbow;  // stretched, folded
    const edp::InverseSolution s = arm_.inverse(arm_.forward(q), q);
    EXPECT_TRUE(s.reached);
    EXPECT_LT(difference(arm_.forward(s.joints), arm_.forward(q)), 1e-7);
  }
}

TEST_P(Inverse, IsNeverNotANumber) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const std::array strange{std::nan(""), kInf, -kInf, 1e308,  -1e308, 1e154,
                           1e16,         1e6,  -1e5,  1e-308, 0.0,    -0.0};
  for (int k = 0; k < kCases / 4; ++k) {
    Pose T = arm_.forward(random_joints());
    AxisVector near = random_joints();
    for (int n = static_cast<int>(uniform(1, 4)); n > 0; --n) {
      const double x = strange[static_cast<std::size_t>(uniform(0, strange.size() - 1e-9))];
      switch (static_cast<int>(uniform(0, 3))) {
        case 0:
          T.p[static_cast<int>(uniform(0, 3))] = x;
          break;
        case 1:
          T.R(static_cast<int>(uniform(0, 3)), static_cast<int>(uniform(0, 3))) = x;
          break;
        default:
          near[static_cast<int>(uniform(0, arm_.axes()))] = x;
      }
    }
    const edp::InverseSolution s = arm_.inverse(T, near);
    ASSERT_TRUE(s.joints.allFinite()) << s.joints.transpose();
    ASSERT_FALSE(std::isnan(s.missing));
    ASSERT_EQ(s.reached, s.missing == 0);
    const auto sensible = [](const auto& x) { return ((x.array().abs() < 1e6).all()); };
    if (!sensible(T.p) || !sensible(T.R) || !sensible(near)) {
      ASSERT_EQ(s.missing, kInf);
    }
  }
}

TEST_P(Inverse, RefusesJointsOfAnotherRobot) {
  const Pose T = arm_.forward(arm_.front());
  const edp::InverseSolution s = arm_.inverse(T, AxisVector::Zero(arm_.axes() - 1));
  EXPECT_FALSE(s.reached);
  EXPECT_EQ(s.joints, AxisVector::Zero(arm_.axes()));
}

// Hand along the normal of the arm's plane: only the sum or difference of T and N matters.
TEST_P(Inverse, KeepsTAtASingularWrist) {
  for (int k = 0; k < 1000; ++k) {
    AxisVector q = random_joints();
    q[first_ + 4] = k % 2 == 0 ? 0 : kPi;
    AxisVector near = q;
    near[first_ + 5] += uniform(-0.02, 0.02);
    const Pose T = arm_.forward(q);
    const edp::InverseSolution s = arm_.inverse(T, near);
    ASSERT_TRUE(s.reached && s.singular);
    ASSERT_LE((s.joints - q).cwiseAbs().maxCoeff(), 1e-9);

    near[first_ + 3] += 0.03;  // the pose is reached with this T as well
    const edp::InverseSolution other = arm_.inverse(T, near);
    if (!other.reached) continue;
    const auto theta4 = [this](const AxisVector& v) { return v.segment(first_ + 1, 3).sum(); };
    ASSERT_NEAR(theta4(other.joints), theta4(near), 1e-12);
    ASSERT_LE(difference(arm_.forward(other.joints), T), 1e-9);
  }
}

TEST_P(Inverse, IsNotSingularElsewhere) {
  for (int k = 0; k < 1000; ++k) {
    const AxisVector q = random_joints();
    ASSERT_FALSE(arm_.inverse(arm_.forward(q), q).singular);
  }
}

TEST_P(Inverse, KeepsTheColumnWithTheWristAboveIt) {
  const Lengths& a = arm_.parameters().lengths;
  AxisVector q = AxisVector::Zero(arm_.axes());
  // theta3 = 0, theta4 = 0 and the lower arm leaning back as far as the wrist reaches forward are too far for
  // these lengths, so the hand points back: theta4 = pi.
  q[first_] = 0.7;
  q[first_ + 1] = -kPi + std::acos((a.a3 - a.d5) / a.a2 > 1 ? 1 : (a.a3 - a.d5) / a.a2);
  const double theta3 = std::acos(std::clamp((a.d5 - a.a2 * std::cos(q[first_ + 1])) / a.a3, -1.0, 1.0));
  q[first_ + 2] = theta3 - q[first_ + 1] - kPi / 2;
  q[first_ + 3] = kPi - theta3;
  q[first_ + 4] = 1;
  const Pose T = arm_.forward(q);
  ASSERT_LT(std::hypot(T.p.x(), T.p.y()), 1e-10);
  const edp::InverseSolution s = arm_.inverse(T, q);
  EXPECT_TRUE(s.reached && s.singular);
  EXPECT_LE((s.joints - q).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace mrroc::irb6::test
