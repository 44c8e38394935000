// The motion from matches that are numbers, without pictures: its derivative, its consensus among outliers, its covariance.
#include "vsp/odometry/motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "test/vsp/stereo_room.hpp"
#include "vsp/odometry/consensus.hpp"
#include "vsp/odometry/reprojection.hpp"

namespace mrroc::vsp {
namespace {

class StereoMotionTest : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  double normal(double sd) { return std::normal_distribution<>(0, sd)(random_); }
  Pose motion() {
    Pose A = test::planar_motion(uniform(-0.1, 0.1), uniform(-0.13, 0.13));
    A.p += Vector3(0, normal(0.003), normal(0.003));
    return A;
  }
  Vector3 point() {
    const double x = uniform(1, 6);
    return {x, x * uniform(-0.4, 0.4), uniform(0, 1)};
  }
  std::vector<StereoMatch> matches(const Pose& A, std::size_t count, double noise, double outliers) {
    std::vector<StereoMatch> all(count);
    for (StereoMatch& m : all) {
      m.point = point();
      m.seen = reprojected(rig_, A, m.point);
      for (double& s : m.seen) s += normal(noise);
      if (uniform(0, 1) < outliers) m.seen[0] += uniform(5, 60), m.seen[2] += uniform(5, 60);
    }
    return all;
  }

  const StereoRig rig_ = test::stereo_rig();
  std::mt19937 random_{4};
};

TEST_F(StereoMotionTest, TheDerivativeIsThatOfDifferences) {
  for (int k = 0; k < 50; ++k) {
    const Pose A = motion();
    const Vector3 X = point();
    StereoJacobian J;
    reprojected(rig_, A, X, &J);
    for (int i = 0; i < 6; ++i) {
      constexpr double kStep = 1e-6;
      const Vector6 e = kStep * Vector6::Unit(i);
      const StereoPlace slope =
          (reprojected(rig_, moved(A, e), X) - reprojected(rig_, moved(A, -e), X)) / (2 * kStep);
      EXPECT_LT((J.col(i) - slope).norm(), 1e-4 * (1 + slope.norm())) << k << " " << i;
    }
  }
}

TEST_F(StereoMotionTest, NothingIsSeenBehindTheCameras) {
  EXPECT_FALSE(reprojected(rig_, {}, {-1, 0, 0.4}).allFinite());
}

TEST_F(StereoMotionTest, IsFoundAmongAsManyOutliersAsInliers) {
  for (int k = 0; k < 40; ++k) {
    const Pose A = motion();
    const auto all = matches(A, 100, 0.1, 0.5);
    const auto found = consensus(rig_, all);
    ASSERT_TRUE(found) << k;
    const StereoMotion fine = refined(rig_, all, *found);
    EXPECT_LT((fine.A.p - A.p).norm(), 2e-3) << k;
    EXPECT_LT(angle_axis_from_rotation(fine.A.R * A.R.transpose()).norm(), 1e-3) << k;
    EXPECT_GT(fine.inliers.size(), 30U);
    EXPECT_LT(fine.inliers.size(), 70U);
  }
}

TEST_F(StereoMotionTest, HasNoConsensusInFewOrRandomMatches) {
  EXPECT_FALSE(consensus(rig_, {}));
  EXPECT_FALSE(consensus(rig_, matches({}, 5, 0, 0)));
  auto all = matches({}, 60, 0, 0);
  for (StereoMatch& m : all)
    m.seen = {uniform(-300, 300), uniform(-200, 200), uniform(-300, 300), uniform(-200, 200)};
  const auto found = consensus(rig_, all);
  EXPECT_TRUE(!found || inliers(rig_, all, *found).size() < 12);
}

TEST_F(StereoMotionTest, OfErrorsThatAreIndependentTheCovarianceIsTwiceAsLargeAsNeeded) {
  constexpr int kMotions = 200;
  double normalised = 0;
  double rms = 0;
  for (int k = 0; k < kMotions; ++k) {
    const Pose A = motion();
    const StereoMotion m = refined(rig_, matches(A, 200, 0.2, 0), A);
    Vector6 e;
    e << m.A.p - A.p, angle_axis_from_rotation(m.A.R * A.R.transpose());
    normalised += e.dot(m.covariance.ldlt().solve(e)) / kMotions;
    rms += m.rms_px / kMotions;
  }
  EXPECT_NEAR(2 * normalised, 6, 0.8);
  EXPECT_NEAR(rms, 0.2 * std::sqrt(2), 0.01);
}

TEST_F(StereoMotionTest, TheCovarianceOfFaultlessMatchesIsNotZero) {
  const StereoMotion m = refined(rig_, matches({}, 100, 0, 0), {});
  EXPECT_GT(m.covariance.ldlt().vectorD().minCoeff(), 0);
  EXPECT_LT(m.A.p.norm(), 1e-9);
}

}  // namespace
}  // namespace mrroc::vsp
