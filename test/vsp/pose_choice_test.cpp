// Choice between the two poses of a flat object, and its certainty: the numbers behind the decision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "test/vsp/plane_camera.hpp"
#include "vsp/planar_pose.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kHalf = 0.05;  // of a square's edge [m]
constexpr std::array<std::array<double, 2>, 4> kSquare{
    {{-kHalf, -kHalf}, {kHalf, -kHalf}, {kHalf, kHalf}, {-kHalf, kHalf}}};

class PoseChoice : public testing::Test {
 protected:
  PoseChoice() {
    for (const auto& [x, y] : kSquare) points_.emplace_back(x, y, 0);
  }
  void see(const Pose& T_CG, double noise) {
    std::normal_distribution<> n(0, noise);
    pixels_.clear();
    for (const Vector3& p : points_)
      pixels_.emplace_back(project(camera_, T_CG * p) + Vector2(n(random_), n(random_)));
  }
  PlanarPoses poses(const PlanarPoseParameters& k = {}) const {
    return planar_pose(camera_, points_, pixels_, k).value();
  }
  double squares(const Pose& T_CG) const {
    double sum = 0;
    for (std::size_t k = 0; k < points_.size(); ++k)
      sum += (project(camera_, T_CG * points_[k]) - pixels_[k]).squaredNorm();
    return sum;
  }

  CameraModel camera_ = test::web_camera();
  std::vector<Vector3> points_;
  std::vector<Vector2> pixels_;
  std::mt19937 random_{3};
};

// Four points have eight coordinates, two more than a pose.
TEST_F(PoseChoice, TheOtherPoseIsRefutedByTheVariancesBetweenThem) {
  for (int k = 0; k < 20; ++k) {
    see(test::facing(0.8, 0.4 + 0.01 * k, 0.3 * k, 0.2 * k), 0.3);
    const PlanarPoses found = poses({.significance = 0});
    ASSERT_TRUE(found.other) << k;
    EXPECT_FALSE(found.ambiguous);
    const double least = squares(found.best.T_CG), more = squares(found.other->T_CG) - least;
    ASSERT_GT(more, 0);
    for (const double noise : {0.5 * std::sqrt(least / 2), 3 * std::sqrt(least / 2)}) {
      const double variances = more / std::max(least / 2, noise * noise);
      EXPECT_TRUE(poses({.noise_px = noise, .significance = 1.01 * variances}).ambiguous) << k;
      EXPECT_FALSE(poses({.noise_px = noise, .significance = 0.99 * variances}).ambiguous) << k;
    }
  }
}

TEST_F(PoseChoice, ErrorsAreThoseOfThePoseThatIsTold) {
  for (int k = 0; k < 20; ++k) {
    see(test::facing(0.8, 0.4, 0.3 * k, 0.2 * k), 0.3);
    const PlanarPoses found = poses();
    std::vector<PlanarPose> both{found.best};
    if (found.other) both.push_back(*found.other);
    for (const PlanarPose& pose : both) {
      EXPECT_NEAR(pose.rms_px, std::sqrt(squares(pose.T_CG) / 4), 1e-9);
      double worst = 0;
      for (std::size_t n = 0; n < 4; ++n)
        worst = std::max(worst, (project(camera_, pose.T_CG * points_[n]) - pixels_[n]).norm());
      EXPECT_NEAR(pose.worst_px, worst, 1e-9);
      EXPECT_LT(pose.T_CG.R.col(2).dot(pose.T_CG.p), 0) << "its face looks at the camera";
    }
    if (found.other) {
      EXPECT_LE(found.best.rms_px, found.other->rms_px);
    }
  }
}

TEST_F(PoseChoice, PosesThatDifferByLessThanTheSameAngleAreOne) {
  see(test::facing(0.8, 0.4, 1, 0.2), 0.1);
  const PlanarPoses found = poses({.significance = 1e9});
  ASSERT_TRUE(found.other);
  EXPECT_TRUE(found.ambiguous);
  const double angle = angle_axis_from_rotation(found.best.T_CG.R.transpose() * found.other->T_CG.R).norm();
  EXPECT_TRUE(poses({.significance = 1e9, .same_angle = angle}).other);
  const PlanarPoses one = poses({.significance = 1e9, .same_angle = 1.001 * angle});
  EXPECT_FALSE(one.other);
  EXPECT_FALSE(one.ambiguous);
}

TEST_F(PoseChoice, TheCovarianceIsOfTheLargerOfWhatIsSeenAndWhatIsBelieved) {
  see(test::facing(0.6, 0.5, 1, 0.2), 0.2);
  const PlanarPose seen = poses({.noise_px = 1e-6}).best;
  const double variance = squares(seen.T_CG) / 2;
  ASSERT_GT(variance, 1e-4);
  const double noise = std::sqrt(variance);
  const Matrix6 little = poses({.noise_px = 0.99 * noise}).best.covariance;
  EXPECT_LT((little - seen.covariance).norm(), 1e-9 * little.norm());
  const Matrix6 much = poses({.noise_px = 3 * noise}).best.covariance;
  EXPECT_LT((much - 9 * seen.covariance).norm(), 1e-6 * much.norm());
}

// Nowhere near it, a step that makes nothing better is made smaller.
TEST_F(PoseChoice, AMinimumIsFoundHoweverTheSquareIsSeen) {
  for (int k = 0; k < 200; ++k) {
    std::uniform_real_distribution<> any(-1, 1);
    see(test::facing(0.2 + 0.1 * std::abs(any(random_)), 1.2 * std::abs(any(random_)), 3 * any(random_),
                     3 * any(random_), 0.05 * any(random_), 0.04 * any(random_)),
        2);
    const auto found = planar_pose(camera_, points_, pixels_);
    if (!found) continue;
    const double least = squares(found->best.T_CG);
    for (int n = 0; n < 12; ++n) {
      const Vector6 by = (n % 2 == 0 ? 1e-4 : -1e-4) * Vector6::Unit(n / 2);
      const Pose near{rotation_from_angle_axis(by.tail<3>()) * found->best.T_CG.R,
                      found->best.T_CG.p + by.head<3>()};
      EXPECT_GE(squares(near), least) << k << ' ' << n;
    }
    EXPECT_TRUE(is_proper(found->best.T_CG));
  }
}

}  // namespace
}  // namespace mrroc::vsp
