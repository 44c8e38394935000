#include "base/pose.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "test/base/random_pose.hpp"

namespace mrroc {
namespace {

using test::distance;
using test::random_pose;

constexpr int kCases = 20'000;

TEST(Pose, InverseUndoesIt) {
  std::mt19937_64 random(1);
  for (int k = 0; k < kCases; ++k) {
    const Pose T = random_pose(random, 3);
    EXPECT_LT(distance(T * T.inverse(), Pose{}), 1e-14);
    const Vector3 point = test::random_vector(random, 2);
    EXPECT_LT((T.inverse() * (T * point) - point).norm(), 1e-14);
  }
}

TEST(Pose, AngleAxisRoundTripsForEveryAngle) {
  std::mt19937_64 random(2);
  for (int k = 0; k < kCases; ++k) {
    // From one thousandth of the encoders' resolution to half a turn, on a logarithmic scale.
    const double angle = std::numbers::pi * std::pow(10, test::uniform(random, -12, 0));
    const Vector3 aa = angle * test::random_direction(random);
    const Vector3 back = angle_axis_from_rotation(rotation_from_angle_axis(aa));
    EXPECT_LT((back - aa).norm(), 1e-15 + 1e-7 * angle * angle * (angle > 3.1) + 4e-15 * angle) << angle;
  }
}

TEST(Pose, SlowestRotationIsNotLost) {
  // 0.001 rad/s in steps of 2 ms: edp.md warns against taking it for the identity.
  const Vector3 step(0, 0, 2e-6);
  Matrix3 R = Matrix3::Identity();
  for (int k = 0; k < 100'000; ++k) R = R * rotation_from_angle_axis(step);
  EXPECT_NEAR(angle_axis_from_rotation(R).z(), 0.2, 1e-11);
}

TEST(Pose, SeriesAndClosedFormMeetWithoutAStep) {
  for (const double angle : {0.999e-4, 1.001e-4}) {
    const Vector3 aa = angle * Vector3(1, 2, 2) / 3;
    const Matrix3 reference = Eigen::AngleAxisd(angle, Vector3(1, 2, 2) / 3).toRotationMatrix();
    EXPECT_LT((rotation_from_angle_axis(aa) - reference).cwiseAbs().maxCoeff(), 2e-16);
  }
}

TEST(Pose, AtHalfATurnTheAxisWithPositiveFirstComponentIsChosen) {
  std::vector<Vector3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, -0.8, 0}, {0, 0.6, -0.8}, {0.6, 0, -0.8}};
  std::mt19937_64 random(8);
  for (int k = 0; k < 1000; ++k) {
    Vector3 axis = test::random_direction(random);
    if (axis.x() < 0) axis = -axis;
    if (axis.x() > 1e-6) axes.push_back(axis);
  }
  for (const Vector3& axis : axes)
    for (const double sign : {1.0, -1.0}) {
      const double angle = std::numbers::pi;
      // Half a turn about an axis and about its opposite are the same; rounding decides which one the sines tell.
      EXPECT_LT(
          (angle_axis_from_rotation(rotation_from_angle_axis(sign * angle * axis)) - angle * axis).norm(),
          1e-7)
          << sign * axis.transpose();
      const Matrix3 exact = 2 * axis * axis.transpose() - Matrix3::Identity();
      EXPECT_LT((angle_axis_from_rotation(exact) - angle * axis).norm(), 1e-7) << axis.transpose();
    }
}

TEST(Pose, JustBelowHalfATurnTheAxisKeepsItsSign) {
  std::mt19937_64 random(9);
  for (int k = 0; k < 1000; ++k) {
    const Vector3 aa = (std::numbers::pi - 1e-9) * test::random_direction(random);
    EXPECT_LT((angle_axis_from_rotation(rotation_from_angle_axis(aa)) - aa).norm(), 1e-7);
  }
}

TEST(Pose, RotationsAreOrthonormal) {
  std::mt19937_64 random(3);
  for (int k = 0; k < kCases; ++k)
    EXPECT_TRUE(is_proper({rotation_from_angle_axis(test::random_vector(random, 10)), Vector3::Zero()}));
}

TEST(Pose, OrthonormalRepairsRoundingAndLeavesRotationsAlone) {
  std::mt19937_64 random(4);
  for (int k = 0; k < kCases; ++k) {
    const Matrix3 R = test::random_rotation(random);
    Matrix3 bent = R;
    for (int n = 0; n < 9; ++n) bent(n) += test::uniform(random, -1e-6, 1e-6);
    const Matrix3 mended = orthonormal(bent);
    EXPECT_LT((mended.transpose() * mended - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((mended - R).cwiseAbs().maxCoeff(), 3e-6);
    EXPECT_LT((orthonormal(R) - R).cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(Pose, IsProperRefusesWhatIsNoRotation) {
  EXPECT_TRUE(is_proper(Pose{}));
  Matrix3 mirrored = Matrix3::Identity();
  mirrored(2, 2) = -1;
  EXPECT_FALSE(is_proper({mirrored, Vector3::Zero()}));
  EXPECT_FALSE(is_proper({1.00001 * Matrix3::Identity(), Vector3::Zero()}));
  EXPECT_FALSE(is_proper({Matrix3::Zero(), Vector3::Zero()}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_proper({Matrix3::Identity(), Vector3(0, nan, 0)}));
  Matrix3 R = Matrix3::Identity();
  R(1, 2) = nan;
  EXPECT_FALSE(is_proper({R, Vector3::Zero()}));
}

TEST(Frames, VelocityTransformAgreesWithTheMotionOfTheFrames) {
  // Q moves for a short time; U is bound to it. The numeric velocity of U is xi_V times that of Q.
  std::mt19937_64 random(5);
  const double h = 1e-6;
  for (int k = 0; k < 2000; ++k) {
    const Pose T_0Q = random_pose(random);
    const Pose T_QU = random_pose(random);
    const Twist v_Q = test::random_spatial<Twist>(random, 1);
    const Pose after = T_0Q * pose_from_angle_axis(h * v_Q.vector());
    const Vector6 numeric = angle_axis_from_pose((T_0Q * T_QU).inverse() * (after * T_QU)) / h;
    EXPECT_LT((xi_V(T_QU.inverse(), v_Q).vector() - numeric).norm(), 1e-5);
  }
}

TEST(Frames, PowerIsTheSameInEveryFrame) {
  std::mt19937_64 random(6);
  for (int k = 0; k < kCases; ++k) {
    const Pose T_UQ = random_pose(random);
    const Twist v = test::random_spatial<Twist>(random, 1);
    const Wrench F = test::random_spatial<Wrench>(random, 10);
    EXPECT_NEAR(xi_V(T_UQ, v).vector().dot(xi_F(T_UQ, F).vector()), v.vector().dot(F.vector()), 1e-12);
  }
}

TEST(Frames, TransformsFollowThePathOfFrames) {
  std::mt19937_64 random(7);
  for (int k = 0; k < kCases; ++k) {
    const Pose T_AB = random_pose(random);
    const Pose T_BC = random_pose(random);
    const Twist v = test::random_spatial<Twist>(random, 1);
    const Wrench F = test::random_spatial<Wrench>(random, 10);
    EXPECT_LT(distance(xi_V(T_AB * T_BC, v), xi_V(T_AB, xi_V(T_BC, v))), 1e-13);
    EXPECT_LT(distance(xi_F(T_AB * T_BC, F), xi_F(T_AB, xi_F(T_BC, F))), 1e-12);
    EXPECT_LT(distance(xi_star(T_AB.R * T_BC.R, v), xi_star(T_AB.R, xi_star(T_BC.R, v))), 1e-14);
  }
}

TEST(Frames, SkewIsTheVectorProduct) {
  const Vector3 a(1, -2, 3);
  const Vector3 b(-4, 0.5, 2);
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
}

}  // namespace
}  // namespace mrroc
