// The direct kinematics and its inverse over the whole workspace.
#include "test/robots/irb6/arms.hpp"

namespace mrroc::irb6::test {
namespace {

class Kinematics : public Irb6 {
 protected:
  /// @return index of the axis that the rule for the track keeps, -1: none but the track itself
  int kept_axis() const {
    if (arm_.parameters().track_rule == TrackRule::kept) return -1;
    return arm_.parameters().track_rule == TrackRule::column_kept ? first_ : first_ + 5;
  }
};
INSTANTIATE_TEST_SUITE_P(Arms, Kinematics, kTrackKept, arm_case_name);
INSTANTIATE_TEST_SUITE_P(ActiveTrack, Kinematics, kTrackActive, arm_case_name);

TEST_P(Kinematics, RoundTripsEveryPoseInTheLimits) {
  double worst_pose = 0, worst_joint = 0;
  for (int k = 0; k < kCases; ++k) {
    const AxisVector q = random_joints();
    const Pose T = arm_.forward(q);
    const edp::InverseSolution s = arm_.inverse(T, q);
    ASSERT_TRUE(s.reached) << q.transpose();
    ASSERT_EQ(s.missing, 0);
    worst_pose = std::max(worst_pose, difference(arm_.forward(s.joints), T));
    worst_joint = std::max(worst_joint, (s.joints - q).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(worst_pose, 1e-9);
  EXPECT_LE(worst_joint, 1e-9);
}

// Central differences of the direct kinematics, whose error is of the order of the step squared.
TEST_P(Kinematics, JacobianIsTheDerivativeOfTheDirectKinematics) {
  constexpr double kStep = 1e-5;
  double worst = 0;
  for (int k = 0; k < 500; ++k) {
    const AxisVector q = random_joints();
    const Jacobian J = arm_.jacobian(q);
    ASSERT_EQ(J.cols(), arm_.axes());
    const Matrix3 R_W0 = arm_.forward(q).R.transpose();
    for (int axis = 0; axis < arm_.axes(); ++axis) {
      AxisVector before = q, after = q;
      before[axis] -= kStep;
      after[axis] += kStep;
      const Pose from = arm_.forward(before), to = arm_.forward(after);
      Vector6 v;
      v << to.p - from.p, angle_axis_from_rotation(to.R * from.R.transpose());
      worst = std::max(worst, (v / (2 * kStep) - J.col(axis)).cwiseAbs().maxCoeff());
    }
    // The axis of the last joint is that of the wrist, whatever the pose.
    EXPECT_LE((R_W0 * J.col(arm_.axes() - 1).tail<3>() - Vector3::UnitZ()).norm(), 1e-12);
  }
  EXPECT_LE(worst, 1e-8);
}

// Any near pose will do: a pose that lies within the limits is reached within the limits.
TEST_P(Kinematics, FindsALegalSolutionFromAnyOtherPose) {
  double worst = 0;
  for (int k = 0; k < kCases; ++k) {
    const AxisVector q = random_joints();
    AxisVector near = random_joints();
    if (first_ == 1) near[0] = q[0];  // or the arm need not reach so far
    const Pose T = arm_.forward(q);
    const edp::InverseSolution s = arm_.inverse(T, near);
    ASSERT_TRUE(s.reached) << q.transpose() << " from " << near.transpose();
    ASSERT_TRUE(motors_legal(arm_, s.joints))
        << q.transpose() << " from " << near.transpose() << " gives " << s.joints.transpose();
    worst = std::max(worst, difference(arm_.forward(s.joints), T));
  }
  EXPECT_LE(worst, 1e-9);
}

// Joints far beyond what the linkages allow: leaning over the back, the elbow bent the other way, both signs
// of sin q5, several turns.
TEST_P(Kinematics, ReturnsTheGivenJointsOnEveryBranch) {
  std::array<int, 8> seen{};
  for (int k = 0; k < kCases; ++k) {
    AxisVector q(arm_.axes());
    for (double& v : q) v = uniform(-7, 7);
    const double theta3 = q[first_ + 1] + q[first_ + 2] + kPi / 2;
    const double theta4 = theta3 + q[first_ + 3];
    const Lengths& a = arm_.parameters().lengths;
    const double radius = a.a2 * std::cos(q[first_ + 1]) + a.a3 * std::cos(theta3) + a.d5 * std::cos(theta4);
    const double elbow = std::cos(q[first_ + 2]), roll = std::sin(q[first_ + 4]);
    if (std::abs(radius) < 0.01 || std::abs(elbow) < 0.01 || std::abs(roll) < 0.01) continue;

    // On the way: near is some hundredths of a radian off, as in a path.
    AxisVector near = q;
    for (int j = first_; j < near.size(); ++j)
      if (j != kept_axis()) near[j] += uniform(-0.004, 0.004);
    const edp::InverseSolution s = arm_.inverse(arm_.forward(q), near);
    ASSERT_TRUE(s.reached);
    ASSERT_LE((s.joints - q).cwiseAbs().maxCoeff(), 1e-9)
        << q.transpose() << " gives " << s.joints.transpose();
    ++seen[static_cast<std::size_t>((radius > 0) + 2 * (elbow > 0) + 4 * (roll > 0))];
  }
  for (const int n : seen) EXPECT_GT(n, kCases / 20);
}

TEST_P(Kinematics, GivesARotationAndAHeightAboveTheFloor) {
  for (int k = 0; k < 1000; ++k) {
    const Pose T = arm_.forward(random_joints());
    ASSERT_TRUE(is_proper(T));
    ASSERT_GT(T.p.z(), 0);
  }
}

TEST(KinematicsFigures, MatchTheOriginalsFrontPosition) {
  const Arm arm(kPostument);
  AxisVector q(6);
  q << 0, -kPi / 2, 0, kPi / 2, kPi / 2, -kPi / 2;
  EXPECT_LT((arm.forward(q).p - Vector3(0.67, 0, 0.265 + 0.95)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(KinematicsFigures, TheTrackMovesTheArmAlongY) {
  const Arm arm(kTrack);
  AxisVector q = arm.front();
  const Pose T = arm.forward(q);
  q[0] += 0.3;
  EXPECT_LT((arm.forward(q).p - T.p - Vector3(0, 0.3, 0)).norm(), 1e-15);
  EXPECT_EQ(arm.forward(q).R, T.R);
}

// Tool straight down: theta4 = 0 and q5 = 3/2 pi; q6 = +-pi/2 puts the x axis of E along +-x of the base.
TEST_P(Kinematics, PointsThePenDown) {
  for (const double sign : {1.0, -1.0}) {
    AxisVector near = arm_.front();
    near[first_ + 4] = 4.712;
    near[first_ + 5] = sign * kPi / 2;
    Pose T_0E = tool_down(0.90, 0, 0.92);
    T_0E.R = Vector3(sign, -sign, -1).asDiagonal();
    const edp::InverseSolution s = arm_.inverse(T_0E * arm_.tool_in_wrist().inverse(), near);
    ASSERT_TRUE(s.reached);
    EXPECT_TRUE(legal(arm_, s.joints)) << s.joints.transpose();
    EXPECT_NEAR(s.joints[first_], 0, 1e-12);
    EXPECT_NEAR(s.joints.segment(first_ + 1, 3).sum(), -kPi / 2, 1e-12);
    EXPECT_NEAR(s.joints[first_ + 4], 1.5 * kPi, 1e-12);
    EXPECT_NEAR(s.joints[first_ + 5], sign * kPi / 2, 1e-12);
    EXPECT_LT(difference(arm_.forward(s.joints) * arm_.tool_in_wrist(), T_0E), 1e-12);
  }
}

}  // namespace
}  // namespace mrroc::irb6::test
