#include "vsp/planar_pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <numbers>
#include <random>

#include "base/target/board.hpp"
#include "test/vsp/plane_camera.hpp"

namespace mrroc::vsp {
namespace {

std::vector<Vector3> board_points() {
  std::vector<Vector3> points;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c) points.push_back(kBoard.corner(r, c));
  return points;
}

class PlanarPoseTest : public testing::Test {
 protected:
  std::vector<Vector2> seen(const Pose& T_CG, double noise) {
    std::normal_distribution<> n(0, noise > 0 ? noise : 1);
    std::vector<Vector2> pixels;
    for (const Vector3& p : points_) {
      pixels.push_back(project(camera_, T_CG * p));
      if (noise > 0) pixels.back() += Vector2(n(random_), n(random_));
    }
    return pixels;
  }
  Pose any_pose(double nearest, double farthest) {
    const double d = uniform(nearest, farthest);
    return test::facing(d, uniform(0.1, 0.8), uniform(0, 6.3), uniform(0, 6.3), uniform(-0.2, 0.2) * d,
                        uniform(-0.15, 0.15) * d);
  }
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }

  CameraModel camera_ = test::web_camera();
  std::vector<Vector3> points_ = board_points();
  std::mt19937 random_{1};
};

TEST_F(PlanarPoseTest, FindsEveryPoseFromExactPixels) {
  for (int k = 0; k < 300; ++k) {
    const Pose T = any_pose(0.3, 2);
    const auto found = planar_pose(camera_, points_, seen(T, 0));
    ASSERT_TRUE(found);
    EXPECT_LT((found->best.T_CG.p - T.p).norm(), 1e-6);
    EXPECT_LT((found->best.T_CG.R - T.R).norm(), 1e-6);
    EXPECT_LT(found->best.worst_px, 1e-4);
    EXPECT_FALSE(found->ambiguous);
  }
}

// Of a six-vector whose covariance is right, the mean squared Mahalanobis distance is 6.
TEST_F(PlanarPoseTest, CovarianceTellsHowFarOffThePoseIs) {
  double sum = 0;
  constexpr int kRuns = 400;
  for (int k = 0; k < kRuns; ++k) {
    const Pose T = any_pose(0.3, 1);
    const auto found = planar_pose(camera_, points_, seen(T, 0.1));
    ASSERT_TRUE(found);
    Vector6 error;
    error << found->best.T_CG.p - T.p, angle_axis_from_rotation(found->best.T_CG.R * T.R.transpose());
    sum += error.dot(found->best.covariance.ldlt().solve(error));
  }
  EXPECT_NEAR(sum / kRuns, 6, 0.8);
}

TEST_F(PlanarPoseTest, SmallFarObjectsAreAmbiguousAndNeverFlipUnnoticed) {
  points_ = {{-0.02, -0.02, 0}, {0.02, -0.02, 0}, {0.02, 0.02, 0}, {-0.02, 0.02, 0}};
  int ambiguous = 0;
  for (int k = 0; k < 300; ++k) {
    const Pose T = any_pose(1.5, 2);
    const auto found = planar_pose(camera_, points_, seen(T, 0.05), {.noise_px = 0.05});
    ASSERT_TRUE(found);
    const double angle = angle_axis_from_rotation(found->best.T_CG.R.transpose() * T.R).norm();
    ambiguous += found->ambiguous ? 1 : 0;
    EXPECT_TRUE(found->ambiguous || angle < 0.35) << k;
  }
  EXPECT_GT(ambiguous, 50);
}

// With a Jacobian that is not the projection's, the covariance would be of another camera.
TEST_F(PlanarPoseTest, CovarianceIsThatOfTheLensAlsoWhereItIsTangential) {
  camera_.distortion = {-0.2, 0.05, 0.02, -0.03, 0.01};
  for (int k = 0; k < 30; ++k) {
    const Pose T = any_pose(0.3, 0.6);
    const auto found = planar_pose(camera_, points_, seen(T, 0), {.noise_px = 1});
    ASSERT_TRUE(found);
    constexpr double kDelta = 1e-6;
    Matrix6 JtJ = Matrix6::Zero();
    for (const Vector3& p : points_) {
      Eigen::Matrix<double, 2, 6> J;
      for (int n = 0; n < 6; ++n) {
        const auto moved = [&](double by) {
          const Vector6 d = by * Vector6::Unit(n);
          return project(camera_, rotation_from_angle_axis(d.tail<3>()) * (T.R * p) + T.p + d.head<3>());
        };
        J.col(n) = (moved(kDelta) - moved(-kDelta)) / (2 * kDelta);
      }
      JtJ += J.transpose() * J;
    }
    EXPECT_LT((found->best.covariance * JtJ - Matrix6::Identity()).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST_F(PlanarPoseTest, AFaceThatLooksAwayIsNotSeen) {
  for (int k = 0; k < 50; ++k) {
    std::vector<Vector2> pixels = seen(any_pose(0.3, 1), 0);
    // Where the corners would be seen in a mirror: the board from behind.
    for (Vector2& p : pixels) p.x() = 2 * camera_.cx - p.x();
    const auto found = planar_pose(camera_, points_, pixels);
    if (found) {
      EXPECT_LT(found->best.T_CG.R.col(2).dot(found->best.T_CG.p), 0) << k;
      EXPECT_GT(found->best.rms_px, 1) << "no board is seen so";
    }
  }
}

TEST_F(PlanarPoseTest, TellsTheErrorOfThePixelsThatDoNotFit) {
  const Pose T = test::facing(0.5, 0.4, 1, 0.3);
  std::vector<Vector2> pixels = seen(T, 0);
  pixels[10] += Vector2(3, 4);
  const auto found = planar_pose(camera_, points_, pixels);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->best.worst_px, 5, 0.5);
  const double n = static_cast<double>(points_.size());
  EXPECT_NEAR(found->best.rms_px, 5 / std::sqrt(n), 0.1);
}

TEST_F(PlanarPoseTest, FourPointsAreEnough) {
  points_ = {{-0.05, -0.05, 0}, {0.05, -0.05, 0}, {0.05, 0.05, 0}, {-0.05, 0.05, 0}};
  const Pose T = test::facing(0.3, 0.6, 1, 0.3);
  const auto found = planar_pose(camera_, points_, seen(T, 0));
  ASSERT_TRUE(found);
  EXPECT_LT((found->best.T_CG.p - T.p).norm(), 1e-6);
}

TEST_F(PlanarPoseTest, RefusesWhatIsNoPlane) {
  const Pose T = any_pose(0.5, 1);
  const std::vector<Vector3> line{{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0, 0}};
  std::vector<Vector2> pixels;
  for (const Vector3& p : line) pixels.push_back(project(camera_, T * p));
  const auto found = planar_pose(camera_, line, pixels);
  EXPECT_TRUE(!found || found->best.covariance.allFinite());
  const std::vector<Vector2> board = seen(T, 0);
  EXPECT_FALSE(planar_pose(camera_, std::span(points_).first(3), std::span(board).first(3)));
  EXPECT_FALSE(planar_pose(camera_, points_, std::span(board).first(10)));
}

TEST_F(PlanarPoseTest, NothingIsSeenThatIsNearerThanAMillimetre) {
  camera_ = CameraModel{};
  const auto at = [this](double z) {
    points_.clear();
    for (const auto& [x, y] : {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
      points_.emplace_back(0.2 * z * x, 0.2 * z * y, 0);
    return planar_pose(camera_, points_, seen(test::facing(z, 0.6, 1, 0.3), 0));
  };
  for (const double z : {0.5, 0.05, 0.002}) {
    const auto found = at(z);
    ASSERT_TRUE(found) << z;
    EXPECT_NEAR(found->best.T_CG.p.z(), z, 1e-4 * z);
  }
  EXPECT_FALSE(at(0.0009));
}

}  // namespace
}  // namespace mrroc::vsp
