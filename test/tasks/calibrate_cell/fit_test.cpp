#include "tasks/calibrate_cell/fit.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mrroc::calibrate_cell {
namespace {

class Fit : public testing::Test {
 protected:
  std::mt19937 random_{1};
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  Vector3 anywhere(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  Vector3 noise(double sigma) {
    std::normal_distribution<double> normal(0, sigma);
    return {normal(random_), normal(random_), normal(random_)};
  }
  Pose any_pose() { return {rotation_from_angle_axis(anywhere(1.5)), anywhere(2)}; }
};

const std::vector<Vector3> kFourSides{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {0, -1, 0}};

TEST_F(Fit, BallIsFoundFromFourTouchesWithARadiusThatIsNotKnown) {
  for (int k = 0; k < 100; ++k) {
    const Vector3 centre = anywhere(1);
    std::vector<Vector3> points;
    for (const Vector3& n : kFourSides)
      points.emplace_back(centre + 0.0398 * (n + anywhere(0.1)).normalized());
    const auto ball = fit_ball(points, centre + anywhere(0.01), 0.04);
    ASSERT_TRUE(ball);
    EXPECT_NEAR((ball->centre - centre).norm(), 0, 1e-9);
    EXPECT_NEAR(ball->radius, 0.0398, 1e-9);
  }
}

TEST_F(Fit, BallAveragesNoiseAndTellsIt) {
  double error = 0, rms = 0;
  constexpr int kRuns = 300;
  constexpr double kSigma = 1e-4;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<Vector3> points;
    for (int k = 0; k < 16; ++k)
      points.emplace_back(0.04 * kFourSides[static_cast<std::size_t>(k % 4)] + noise(kSigma));
    const auto ball = fit_ball(points, Vector3(0.005, 0, 0), 0.04);
    ASSERT_TRUE(ball);
    error += ball->centre.squaredNorm() / kRuns;
    rms += ball->rms * ball->rms / kRuns;
  }
  EXPECT_NEAR(std::sqrt(rms), kSigma, 0.1 * kSigma);
  EXPECT_LT(std::sqrt(error), 1.2 * kSigma);
}

TEST_F(Fit, BallIsRefusedWhenTouchesLeaveADirectionOpen) {
  const std::vector<Vector3> three(kFourSides.begin(), kFourSides.begin() + 3);
  EXPECT_FALSE(fit_ball(three, Vector3::Zero(), 1)) << "too few";
  std::vector<Vector3> circle;
  for (int k = 0; k < 12; ++k) circle.emplace_back(std::cos(0.5 * k), std::sin(0.5 * k), 0);
  EXPECT_FALSE(fit_ball(circle, Vector3(0, 0, 0.001), 1)) << "all in a plane through the middle";
  const std::vector<Vector3> one_side(8, Vector3(0, 0, -1));
  EXPECT_FALSE(fit_ball(one_side, Vector3::Zero(), 1)) << "always the same side";
  const std::vector<Vector3> wrong(8, Vector3::Constant(NAN));
  EXPECT_FALSE(fit_ball(wrong, Vector3::Zero(), 1));
}

TEST_F(Fit, PoseIsFoundExactlyWithoutNoise) {
  for (int k = 0; k < 200; ++k) {
    const Pose T_AB = any_pose();
    std::vector<Vector3> a, b;
    const int n = 3 + k % 4;
    for (int point = 0; point < n; ++point) {
      b.push_back(anywhere(0.3));
      if (k % 2 == 0) b.back().z() = 0.1;  // of one plane: no mirror image is taken
      a.push_back(T_AB * b.back());
    }
    const auto fit = fit_pose(a, b);
    if (!fit) continue;  // by chance on a line
    const PoseDistance d = distance(fit->T_AB, T_AB);
    EXPECT_LT(d.mm, 1e-6);
    EXPECT_LT(d.deg, 1e-5);
    EXPECT_NEAR(fit->T_AB.R.determinant(), 1, 1e-12);
    EXPECT_LT(fit->rms, 1e-9);
  }
}

TEST_F(Fit, PoseAveragesNoiseOverThePoints) {
  double few = 0, many = 0;
  for (int run = 0; run < 200; ++run)
    for (const std::size_t n : {4U, 64U}) {
      const Pose T_AB = any_pose();
      std::vector<Vector3> a, b;
      for (std::size_t point = 0; point < n; ++point) {
        b.emplace_back(0.2 * (kFourSides[point % 4] + anywhere(0.1)));
        a.emplace_back(T_AB * b.back() + noise(1e-4));
      }
      const auto fit = fit_pose(a, b);
      ASSERT_TRUE(fit);
      (n == 4 ? few : many) += distance(fit->T_AB, T_AB).deg / 200;
    }
  EXPECT_LT(many, few / 3) << "by the root of 16";
  EXPECT_GT(few, 1e-3) << "there is noise";
}

TEST_F(Fit, PoseIsRefusedForPointsAboutWhichTheFramesMightTurn) {
  const Pose T_AB = any_pose();
  const auto refused = [&](const std::vector<Vector3>& b) {
    std::vector<Vector3> a;
    for (const Vector3& p : b) a.push_back(T_AB * p);
    return !fit_pose(a, b);
  };
  EXPECT_TRUE(refused({{0, 0, 0}, {0.1, 0, 0}})) << "two";
  EXPECT_TRUE(refused({{0, 0, 0}, {0.1, 0, 0}, {0.3, 0, 0}, {0.2, 0, 0}})) << "on a line";
  EXPECT_TRUE(refused({{0, 0, 0}, {0.1, 0.001, 0}, {0.3, 0, 0.001}})) << "nearly on a line";
  EXPECT_FALSE(refused({{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}));
  EXPECT_FALSE(fit_pose(std::vector<Vector3>(4), std::vector<Vector3>(3))) << "other numbers of points";
}

TEST_F(Fit, DistanceOfPosesIsInMillimetresAndDegrees) {
  const Pose A = any_pose();
  const Pose B = A * Pose{rotation_from_angle_axis({0, 0.5 * M_PI / 180, 0}), {0, 0.003, 0.004}};
  const PoseDistance d = distance(A, B);
  EXPECT_NEAR(d.mm, 5, 1e-9);
  EXPECT_NEAR(d.deg, 0.5, 1e-9);
}

}  // namespace
}  // namespace mrroc::calibrate_cell
