#include "base/representation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "test/base/random_pose.hpp"

namespace mrroc {
namespace {

using test::distance;

constexpr std::array kSpatial{Representation::frame, Representation::xyz_euler_zyz,
                              Representation::xyz_angle_axis};

TEST(Representation, EveryPoseRoundTripsInEachOfThem) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 20'000; ++k) {
    const Pose T = test::random_pose(random);
    for (const Representation r : kSpatial) {
      const std::optional<Pose> back = pose_from_numbers(r, numbers_from_pose(r, T));
      ASSERT_TRUE(back);
      EXPECT_LT(distance(*back, T), 1e-9);
    }
  }
}

TEST(Representation, EulerAnglesAreTurnsAboutZThenYThenZ) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 2000; ++k) {
    EulerZyzPose r;
    r << test::random_vector(random, 1), test::uniform(random, -3.1, 3.1), test::uniform(random, 0.01, 3.1),
        test::uniform(random, -3.1, 3.1);
    const Matrix3 R = (Eigen::AngleAxisd(r[3], Vector3::UnitZ()) * Eigen::AngleAxisd(r[4], Vector3::UnitY()) *
                       Eigen::AngleAxisd(r[5], Vector3::UnitZ()))
                          .toRotationMatrix();
    const Pose T = pose_from_euler_zyz(r);
    EXPECT_LT((T.R - R).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((euler_zyz_from_pose(T) - r).norm(), 1e-10);
  }
}

TEST(Representation, WhereTheEulerAnglesAreNotUniquePsiIsZero) {
  for (const double theta : {0.0, std::numbers::pi})
    for (const double phi : {-3.0, -1.0, 0.0, 0.5, 3.0}) {
      EulerZyzPose r = EulerZyzPose::Zero();
      r << 1, 2, 3, phi, theta, 0.7;
      const Pose T = pose_from_euler_zyz(r);
      const EulerZyzPose back = euler_zyz_from_pose(T);
      EXPECT_EQ(back[5], 0);
      EXPECT_LT(distance(pose_from_euler_zyz(back), T), 1e-14);
    }
}

TEST(Representation, FrameIsWrittenRowByRow) {
  const Pose T{Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitZ()).toRotationMatrix(),
               Vector3(1, 2, 3)};
  const PoseNumbers n = numbers_from_pose(Representation::frame, T);
  const PoseNumbers expected{0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1};
  for (std::size_t k = 0; k < n.size(); ++k) EXPECT_NEAR(n[k], expected[k], 1e-16);
}

TEST(Representation, OneBadNumberMakesItNoPose) {
  std::mt19937_64 random(3);
  for (const Representation r : kSpatial)
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
      for (int k = 0; k < numbers_used(r, 6); ++k) {
        PoseNumbers n = numbers_from_pose(r, test::random_pose(random));
        n[static_cast<std::size_t>(k)] = bad;
        EXPECT_FALSE(pose_from_numbers(r, n)) << static_cast<int>(r) << " " << k;
      }
}

TEST(Representation, FrameThatIsNoHomogeneousMatrixIsRefused) {
  std::mt19937_64 random(4);
  for (std::size_t k = 0; k < 16; ++k) {
    if (k % 4 == 3 && k < 12) continue;  // the position may be anything
    PoseNumbers n = numbers_from_pose(Representation::frame, test::random_pose(random));
    n[k] += 0.01;
    EXPECT_FALSE(pose_from_numbers(Representation::frame, n)) << k;
  }
}

// is_proper() lets this much through, and many multiplications would make it more.
TEST(Representation, AFrameThatIsNearlyARotationBecomesOne) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 1000; ++k) {
    const Pose T = test::random_pose(random);
    PoseNumbers n = numbers_from_pose(Representation::frame, T);
    for (const std::size_t row : {0U, 4U, 8U})
      for (std::size_t column = 0; column < 3; ++column)
        n[row + column] += test::uniform(random, -1e-7, 1e-7);
    const auto taken = pose_from_numbers(Representation::frame, n);
    ASSERT_TRUE(taken);
    EXPECT_LT((taken->R.transpose() * taken->R - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((taken->R - T.R).cwiseAbs().maxCoeff(), 5e-7);
    EXPECT_EQ(taken->p, T.p);
  }
}

TEST(Representation, AnglesWithoutMeaningAreRefusedNotUsed) {
  PoseNumbers n{};
  n[3] = 1e200;
  EXPECT_FALSE(pose_from_numbers(Representation::xyz_angle_axis, n));
}

TEST(Representation, NumbersPerAxisAreNoPoseInSpace) {
  for (const auto r : {Representation::motors, Representation::joints, static_cast<Representation>(77)}) {
    EXPECT_FALSE(pose_from_numbers(r, PoseNumbers{}));
    EXPECT_EQ(numbers_from_pose(r, Pose{}), PoseNumbers{});
  }
  EXPECT_EQ(numbers_used(Representation::motors, 7), 7);
  EXPECT_EQ(numbers_used(static_cast<Representation>(77), 7), 0);
}

TEST(Representation, AxesKeepTheirOrder) {
  const PoseNumbers n{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const AxisVector v = axes_from_numbers(n, 7);
  ASSERT_EQ(v.size(), 7);
  EXPECT_EQ(v[6], 7);
  EXPECT_EQ(numbers_from_axes(v), (PoseNumbers{1, 2, 3, 4, 5, 6, 7}));
}

}  // namespace
}  // namespace mrroc
