// Accuracy of the calibrated place of a camera that moves with the hand, or sees the board in it: many
// calibrations.
#include <gtest/gtest.h>

#include <random>

#include "test/vsp/plane_camera.hpp"
#include "vsp/calibration/hand_eye.hpp"

namespace mrroc::vsp {
namespace {

constexpr Board kSmall{.columns = 3, .rows = 2};

class PlaceScatter : public testing::TestWithParam<Arrangement> {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  Pose any_pose() {
    AngleAxisPose r;
    for (int k = 0; k < 6; ++k) r[k] = uniform(-0.5, 0.5);
    return pose_from_angle_axis(r);
  }
  // Seen T_CG = X^-1 A Y, where A is the known pose or its inverse.
  PosedView view(const Pose& T_CG, const Pose& X, const Pose& Y, double noise) {
    const Pose A = X * T_CG * Y.inverse();
    PosedView v{{"v", {}}, GetParam() == Arrangement::eye_in_hand ? A.inverse() : A};
    std::normal_distribution<> n(0, noise);
    for (int r = 0; r < kSmall.rows; ++r)
      for (int c = 0; c < kSmall.columns; ++c)
        v.view.corners.emplace_back(project(camera_, T_CG * kSmall.corner(r, c)) +
                                    Vector2(n(random_), n(random_)));
    return v;
  }

  CameraModel camera_ = test::web_camera();
  std::mt19937 random_{5};
};

// Four views of six corners are 48 numbers for 12 unknowns: it matters how many are free.
TEST_P(PlaceScatter, IsTold) {
  const Pose X = any_pose(), Y = any_pose();
  std::vector<Pose> seen;
  for (int k = 0; k < 4; ++k) seen.push_back(test::facing(0.25, 0.5, 1.6 * k, 0.3 * k));
  Vector3 squares = Vector3::Zero();
  double told = 0;
  constexpr int kRuns = 150;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<PosedView> views;
    for (const Pose& T_CG : seen) views.push_back(view(T_CG, X, Y, 0.1));
    const PlaceCalibration place = calibrate_place(camera_, GetParam(), views, kSmall);
    squares += (place.camera.p - X.p).cwiseAbs2() / kRuns;
    told += place.sigma_m * place.sigma_m / kRuns;
    EXPECT_NEAR(place.rms_px, std::sqrt(2 * 36.0 / 48) * 0.1, 0.06);
  }
  EXPECT_NEAR(std::sqrt(told / squares.maxCoeff()), 1, 0.15);
}

// From the bad start that noisy pictures give to the least error: no small change makes it smaller.
TEST_P(PlaceScatter, ThePlaceIsTheOneWithTheLeastError) {
  for (int run = 0; run < 10; ++run) {
    const Pose X = any_pose(), Y = any_pose();
    std::vector<PosedView> views;
    for (int k = 0; k < 5; ++k)
      views.push_back(view(test::facing(0.3, uniform(0.2, 0.7), 1.3 * k, uniform(-1, 1)), X, Y, 0.5));
    const PlaceCalibration place = calibrate_place(camera_, GetParam(), views, kSmall);
    const auto cost = [&](const Pose& camera, const Pose& board) {
      double sum = 0;
      for (const PosedView& v : views) {
        const Pose A = GetParam() == Arrangement::eye_in_hand ? v.known.inverse() : v.known;
        const Pose T_CG = camera.inverse() * A * board;
        std::size_t n = 0;
        for (int r = 0; r < kSmall.rows; ++r)
          for (int c = 0; c < kSmall.columns; ++c)
            sum += (project(camera_, T_CG * kSmall.corner(r, c)) - v.view.corners[n++]).squaredNorm();
      }
      return sum;
    };
    const double least = cost(place.camera, place.board);
    EXPECT_NEAR(place.rms_px, std::sqrt(least / (5 * kSmall.corners())), 1e-9);
    for (int n = 0; n < 12; ++n) {
      const Vector6 by = (n % 2 == 0 ? 1e-5 : -1e-5) * Vector6::Unit(n / 2);
      const Pose step{rotation_from_angle_axis(by.tail<3>()), by.head<3>()};
      EXPECT_GT(cost(place.camera * step, place.board), least) << n;
      EXPECT_GT(cost(place.camera, place.board * step), least) << n;
    }
    EXPECT_TRUE(is_proper(place.camera) && is_proper(place.board));
  }
}

INSTANTIATE_TEST_SUITE_P(OfAHand, PlaceScatter,
                         testing::Values(Arrangement::eye_in_hand, Arrangement::board_in_hand));

}  // namespace
}  // namespace mrroc::vsp
