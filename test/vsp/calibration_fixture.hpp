// Random views of a chessboard, whole arrangements of camera, hand and board, and the refusals of a
// calibration.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/calibration/calibrate.hpp"

namespace mrroc::test {

/// @return the exact corners with a little noise: what is tested is what comes after finding them
inline vsp::BoardView seen_by(const CameraModel& camera, const Pose& T_CG, std::mt19937& random,
                              double noise) {
  std::normal_distribution<> n(0, noise > 0 ? noise : 1);
  vsp::BoardView view;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c) {
      view.corners.push_back(project(camera, T_CG * kBoard.corner(r, c)));
      if (noise > 0) view.corners.back() += Vector2(n(random), n(random));
    }
  return view;
}
inline vsp::BoardView seen(const Pose& T_CG, std::mt19937& random, double noise = 0.05) {
  return seen_by(web_camera(), T_CG, random, noise);
}

class CalibrationTest : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  Pose any_view(double tilt = 0.6) {
    return facing(uniform(0.4, 0.7), uniform(0.3, 1) * tilt, uniform(0, 6.3), uniform(-0.5, 0.5),
                  uniform(-0.1, 0.1), uniform(-0.07, 0.07));
  }
  Pose any_pose(double turn) {
    AngleAxisPose r;
    for (int k = 0; k < 3; ++k) r[k] = uniform(-0.5, 0.5);
    for (int k = 3; k < 6; ++k) r[k] = uniform(-turn, turn);
    return pose_from_angle_axis(r);
  }
  // Views of a camera at X (E_C T), board at Y (0_G T), or as the arrangement has it.
  std::vector<vsp::PosedView> posed(vsp::Arrangement arrangement, const Pose& X, const Pose& Y, int n) {
    std::vector<vsp::PosedView> views;
    for (int k = 0; k < n; ++k) {
      const Pose T_CG = any_view();
      const Pose A = X * T_CG * Y.inverse();
      views.push_back({seen(T_CG, random_), arrangement == vsp::Arrangement::eye_in_hand ? A.inverse() : A});
      views.back().view.name = std::to_string(k);
    }
    return views;
  }
  static std::string refusal(const std::function<void()>& action) {
    try {
      action();
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_calibration);
      return e.what();
    }
    return "";
  }
  std::mt19937 random_{3};
};

}  // namespace mrroc::test
