#include "tasks/visual_servo/aggregation.hpp"

#include <gtest/gtest.h>

#include "test/base/random_pose.hpp"

namespace mrroc::visual_servo {
namespace {

using mrroc::test::distance;
using mrroc::test::random_pose;
using mrroc::test::uniform;

constexpr std::array kMethods{Aggregation::mean, Aggregation::switching, Aggregation::weights};

Matrix6 random_covariance(std::mt19937_64& random) {
  Matrix6 A;
  for (int k = 0; k < 36; ++k) A(k) = uniform(random, -1, 1);
  return 1e-6 * (A * A.transpose() + 0.1 * Matrix6::Identity());
}

/// Errors as two cameras see the same thing: near to one another.
CameraError near(std::mt19937_64& random, const Pose& e, double size) {
  Pose d = random_pose(random, size);
  d.R = rotation_from_angle_axis(mrroc::test::random_vector(random, size));
  return {e * d, random_covariance(random)};
}

TEST(Aggregation, OfTwoEqualErrorsIsThatError) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 300; ++k) {
    const Pose e = random_pose(random);
    for (const Aggregation method : kMethods)
      EXPECT_LT(
          distance(aggregate(method, {e, random_covariance(random)}, {e, random_covariance(random)}).e, e),
          1e-12);
  }
}

TEST(Aggregation, DoesNotDependOnTheOrderOfTheCameras) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 300; ++k) {
    const Pose e = random_pose(random);
    const CameraError a = near(random, e, 0.3), b = near(random, e, 0.3);
    for (const Aggregation method : {Aggregation::mean, Aggregation::switching})
      EXPECT_LT(distance(aggregate(method, a, b).e, aggregate(method, b, a).e), 1e-12);
    const CameraError close = near(random, a.e, 1e-3);
    EXPECT_LT(
        distance(aggregate(Aggregation::weights, a, close).e, aggregate(Aggregation::weights, close, a).e),
        2e-6);
  }
}

TEST(Aggregation, DoesNotDependOnTheFrameInWhichTheErrorsAreGiven) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 300; ++k) {
    const Pose e = random_pose(random), U = random_pose(random);
    CameraError a = near(random, e, 0.3), b = near(random, e, 0.3);
    for (const Aggregation method : {Aggregation::mean, Aggregation::weights}) {
      const Pose here = aggregate(method, a, b).e;
      EXPECT_LT(distance(aggregate(method, {U * a.e, a.covariance}, {U * b.e, b.covariance}).e, U * here),
                1e-9);
    }
  }
}

TEST(Aggregation, MeanLiesHalfwayAndTurnsHalfway) {
  const Pose a{rotation_from_angle_axis({0, 0, 0.2}), {0, 0, 0.1}};
  const Pose b{rotation_from_angle_axis({0, 0, 0.6}), {0, 0, 0.3}};
  const Pose half{rotation_from_angle_axis({0, 0, 0.4}), {0, 0, 0.2}};
  EXPECT_LT(distance(aggregate(Aggregation::mean, {a, Matrix6::Zero()}, {b, Matrix6::Zero()}).e, half),
            1e-12);
}

TEST(Aggregation, SwitchingTakesTheSmallerError) {
  const CameraError near_one{{Matrix3::Identity(), {0.1, 0, 0}}, Matrix6::Identity()};
  const CameraError far_one{{Matrix3::Identity(), {0, 0.2, 0}}, Matrix6::Identity()};
  const CameraError turned{{rotation_from_angle_axis({0, 0, 1}), {0.1, 0, 0}}, Matrix6::Identity()};
  for (const CameraError& other : {far_one, turned})
    EXPECT_EQ(aggregate(Aggregation::switching, near_one, other).e.p, near_one.e.p);
  EXPECT_EQ(aggregate(Aggregation::switching, turned, near_one).e.R, near_one.e.R);
}

TEST(Aggregation, OfTheMeanTheVarianceIsAQuarterOfTheSum) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 100; ++k) {
    const Pose e = random_pose(random);
    const CameraError a = near(random, e, 0.1), b = near(random, e, 0.1);
    const CameraError c = aggregate(Aggregation::mean, a, b);
    EXPECT_LT((4 * c.covariance - a.covariance - b.covariance).norm(), 1e-15);
    EXPECT_LT(distance(a.e * (a.e.inverse() * c.e) * (a.e.inverse() * c.e), b.e), 1e-12) << "half of the way";
  }
}

TEST(Aggregation, TheSmallerErrorKeepsItsOwnVariance) {
  std::mt19937_64 random(6);
  const CameraError small{{Matrix3::Identity(), {0.01, 0, 0}}, random_covariance(random)};
  const CameraError large{{Matrix3::Identity(), {0, 0.02, 0}}, random_covariance(random)};
  EXPECT_EQ(aggregate(Aggregation::switching, small, large).covariance, small.covariance);
  EXPECT_EQ(aggregate(Aggregation::switching, large, small).covariance, small.covariance);
}

TEST(Aggregation, ARadianCountsAsMuchAsTheLever) {
  EXPECT_NEAR(length_of({rotation_from_angle_axis({0, 0.5, 0}), {0, 0, 0}}), 0.5 * kLever, 1e-12);
  EXPECT_NEAR(length_of({rotation_from_angle_axis({0, 0, 0.15}), {0, 0.04, 0}}), 0.05, 1e-12);
}

TEST(Aggregation, WeightsAreTheInverseCovariances) {
  const Pose a{Matrix3::Identity(), {0, 0, 0}}, b{Matrix3::Identity(), {1, 1, 1}};
  Vector6 three;
  three << 3, 1, 1. / 3, 1, 1, 1;
  const Matrix6 A = Matrix6::Identity(), B = three.asDiagonal();
  const CameraError c = aggregate(Aggregation::weights, {a, A}, {b, B});
  EXPECT_LT((c.e.p - Vector3(0.25, 0.5, 0.75)).norm(), 1e-12);
  EXPECT_LT((c.covariance.inverse() - A.inverse() - B.inverse()).norm(), 1e-9);
}

TEST(Aggregation, WeightsGoFromOneCameraToTheOtherAsTheyBecomeUnsure) {
  std::mt19937_64 random(4);
  for (int k = 0; k < 100; ++k) {
    const Pose e = random_pose(random);
    const CameraError a = near(random, e, 0.05), b = near(random, e, 0.05);
    EXPECT_LT(distance(aggregate(Aggregation::weights, {a.e, 1e9 * a.covariance}, b).e, b.e), 1e-6);
    EXPECT_LT(distance(aggregate(Aggregation::weights, a, {b.e, 1e9 * b.covariance}).e, a.e), 1e-6);
  }
}

TEST(Aggregation, WithoutUsableCovariancesWeightsAreEqual) {
  const CameraError a{{Matrix3::Identity(), {0.1, 0, 0}}, Matrix6::Zero()};
  const CameraError b{{Matrix3::Identity(), {0.3, 0, 0}}, Matrix6::Zero()};
  EXPECT_NEAR(aggregate(Aggregation::weights, a, b).e.p.x(), 0.2, 1e-12);
}

}  // namespace
}  // namespace mrroc::visual_servo
