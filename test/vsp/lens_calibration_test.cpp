// The calibration of a lens: its model, its errors, and the pictures that it refuses.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/vsp/calibration_fixture.hpp"
#include "vsp/calibration/calibrate.hpp"

namespace mrroc::vsp {
namespace {

using test::CalibrationTest;
using test::seen;
using test::seen_by;

TEST_F(CalibrationTest, FindsTheLens) {
  std::vector<BoardView> views;
  for (int k = 0; k < 20; ++k) views.push_back(seen(any_view(), random_));
  const LensCalibration lens = calibrate_lens(640, 480, views);
  EXPECT_LT(lens.rms_px, 0.1);
  EXPECT_NEAR(lens.model.fx, 600, 2);
  EXPECT_NEAR(lens.model.cx, 319.5, 2);
  EXPECT_NEAR(lens.model.cy, 239.5, 2);
  EXPECT_NEAR(lens.model.distortion[0], -0.28, 0.02);
  EXPECT_EQ(lens.view_px.size(), 20U);
}

TEST_F(CalibrationTest, TheLensIsThatOfAnyCameraWithItsErrors) {
  CameraModel camera;
  camera.width = 800;
  camera.height = 500;
  camera.fx = 720;
  camera.fy = 735;
  camera.cx = 410;
  camera.cy = 236;
  camera.distortion = {-0.2, 0.06, 0.002, -0.003, 0};
  std::vector<BoardView> views;
  for (int k = 0; k < 14; ++k) views.push_back(seen_by(camera, any_view(), random_, 0.1));
  const LensCalibration lens = calibrate_lens(800, 500, views);
  EXPECT_EQ(lens.model.width, 800);
  EXPECT_EQ(lens.model.height, 500);
  EXPECT_NEAR(lens.model.fx, 720, 3);
  EXPECT_NEAR(lens.model.fy, 735, 3);
  EXPECT_NEAR(lens.model.cx, 410, 3);
  EXPECT_NEAR(lens.model.cy, 236, 3);
  const std::array<double, 5> tolerance{0.02, 0.15, 0.001, 0.001, 1e-15};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(lens.model.distortion[k], camera.distortion[k], tolerance[k]) << k;
  EXPECT_NEAR(lens.rms_px, 0.1 * std::numbers::sqrt2, 0.01) << "of points, with two coordinates each";
  double squares = 0;
  for (const double px : lens.view_px) squares += px * px / 14;
  EXPECT_NEAR(std::sqrt(squares), lens.rms_px, 1e-6);
  EXPECT_GT(lens.sigma_f, 1e-5);
  EXPECT_LT(std::abs(lens.model.fx - 720), 5 * lens.sigma_f * 720);
  // Ten times the noise is ten times the uncertainty.
  views.clear();
  for (int k = 0; k < 14; ++k) views.push_back(seen_by(camera, any_view(), random_, 0.01));
  const double sharp = calibrate_lens(800, 500, views).sigma_f;
  EXPECT_LT(sharp, 0.3 * lens.sigma_f);
  EXPECT_GT(sharp, 0.03 * lens.sigma_f);
}

TEST_F(CalibrationTest, RefusesViewsThatSayTooLittleWithTheReason) {
  std::vector<BoardView> few;
  for (int k = 0; k < 5; ++k) few.push_back(seen(any_view(), random_));
  EXPECT_NE(refusal([&] { calibrate_lens(640, 480, few); }).find("at least 8"), std::string::npos);
  std::vector<BoardView> flat;
  for (int k = 0; k < 12; ++k)
    flat.push_back(seen(test::facing(0.45, 0, 0, 0, uniform(-0.08, 0.08), uniform(-0.06, 0.06)), random_));
  EXPECT_NE(refusal([&] { calibrate_lens(640, 480, flat); }), "");
  std::vector<BoardView> small;
  for (int k = 0; k < 12; ++k)
    small.push_back(seen(test::facing(1.5, 0.5, uniform(0, 6.3), 0, uniform(-0.01, 0.01), 0), random_));
  EXPECT_NE(refusal([&] { calibrate_lens(640, 480, small); }).find("% of the picture"), std::string::npos);
  std::vector<BoardView> mixed;
  for (int k = 0; k < 12; ++k) mixed.push_back(seen(any_view(), random_, 6));
  EXPECT_NE(refusal([&] { calibrate_lens(640, 480, mixed); }).find("do not fit"), std::string::npos);
}

/// A grid of corners from one place of the picture to another, which is no picture of a board.
BoardView grid(double left, double up, double right, double down) {
  BoardView view;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c)
      view.corners.emplace_back(left + (right - left) * c / (kBoard.columns - 1),
                                up + (down - up) * r / (kBoard.rows - 1));
  return view;
}

TEST_F(CalibrationTest, TheBoardsTogetherMustCoverHalfOfThePicturesWidthAndHeight) {
  const auto why = [](const BoardView& one, const BoardView& another) {
    std::vector<BoardView> views(4, one);
    views.insert(views.end(), 4, another);
    return refusal([&] { calibrate_lens(600, 400, views); });
  };
  const std::string narrow = "of the picture's width or height only; the lens needs 50 %";
  const auto share = [&](int percent) {
    return "the board was shown in " + std::to_string(percent) + " % " + narrow;
  };
  EXPECT_NE(why(grid(100, 10, 200, 390), grid(200, 10, 394, 390)).find(share(49)), std::string::npos);
  EXPECT_NE(why(grid(10, 150, 590, 200), grid(10, 200, 590, 342)).find(share(48)), std::string::npos);
  EXPECT_NE(why(grid(10, 10, 70, 390), grid(10, 10, 70, 390)).find(share(10)), std::string::npos);
  EXPECT_EQ(why(grid(100, 10, 200, 390), grid(200, 10, 401, 390)).find(narrow), std::string::npos);
  EXPECT_EQ(why(grid(10, 150, 590, 200), grid(10, 200, 590, 351)).find(narrow), std::string::npos);
  EXPECT_EQ(why(grid(100, 10, 200, 390), grid(200, 10, 400, 390)).find(narrow), std::string::npos)
      << "the very half";
  EXPECT_NE(why({}, {}).find(share(0)), std::string::npos) << "no corner at all";
}

TEST_F(CalibrationTest, EightPicturesAreEnoughForTheLens) {
  std::vector<BoardView> views;
  for (int k = 0; k < 8; ++k) views.push_back(seen(any_view(), random_, 0.02));
  EXPECT_NEAR(calibrate_lens(640, 480, views).model.fx, 600, 6);
  views.pop_back();
  EXPECT_NE(refusal([&] {
              calibrate_lens(640, 480, views);
            }).find("the board was found in 7 pictures; at least 8 are needed"),
            std::string::npos);
  views.resize(1);
  EXPECT_NE(refusal([&] { calibrate_lens(640, 480, views); }).find("found in 1 picture; at least 8"),
            std::string::npos);
}

// 0.26 rad between the planes of some two pictures.
TEST_F(CalibrationTest, TheBoardMustBeTiltedDifferentlyByFifteenDegrees) {
  const auto with = [this](double tilt) {
    std::vector<BoardView> views;
    for (int k = 0; k < 12; ++k) {
      const int column = k % 4, line = k / 4;
      const double x = column * 0.12 - 0.18, y = line * 0.1 - 0.1;
      views.push_back(seen(test::facing(0.5, k < 6 ? 0.4 : 0.4 + tilt, 1, 0.3 * k, x, y), random_, 0.005));
    }
    return refusal([&] { calibrate_lens(640, 480, views); });
  };
  const std::string alike = with(0.24);
  EXPECT_NE(
      alike.find(
          "the board was tilted alike in all pictures (to within 14 degrees): focal length and distance "
          "cannot be told apart"),
      std::string::npos)
      << alike;
  EXPECT_NE(with(0.1).find("to within 6 degrees"), std::string::npos);
  EXPECT_EQ(with(0.28), "");
}

// Root mean squares of points: the square root of two times the noise of a coordinate.
TEST_F(CalibrationTest, ALensMayLeaveAPixelUnexplainedAndNoMore) {
  const auto with = [this](double noise) {
    std::vector<BoardView> views;
    for (int k = 0; k < 20; ++k) views.push_back(seen(any_view(), random_, noise));
    return refusal([&] { calibrate_lens(640, 480, views); });
  };
  EXPECT_EQ(with(0.66).find("do not fit"), std::string::npos);
  const std::string why = with(0.77);
  EXPECT_NE(why.find("the pictures do not fit together: 1."), std::string::npos) << why;
  EXPECT_NE(why.find(" pixels; was the board flat, the camera sharp and always the same?"), std::string::npos)
      << why;
}

TEST_F(CalibrationTest, AFocalLengthThatStaysUncertainByMoreThanAPercentIsRefused) {
  int refused = 0, taken = 0;
  for (int run = 0; run < 16; ++run) {
    std::vector<BoardView> views;
    for (int k = 0; k < 8; ++k)
      views.push_back(seen(test::facing(0.45, uniform(0.1, 0.25), uniform(0, 6.3), 0, uniform(-0.1, 0.1),
                                        uniform(-0.08, 0.08)),
                           random_, 0.02 + 0.03 * run));
    try {
      const LensCalibration lens = calibrate_lens(640, 480, views);
      EXPECT_LT(lens.sigma_f, 0.01);
      ++taken;
    } catch (const FaultError& e) {
      const std::string why = e.what(), begin = "the focal length stays uncertain by ";
      const auto at = why.find(begin);
      if (at == std::string::npos) continue;
      ++refused;
      const double percent = std::stod(why.substr(at + begin.size()));
      EXPECT_GE(percent, 1);
      EXPECT_LT(percent, 12);
      EXPECT_NE(why.find(" %", at), std::string::npos) << why;
    }
  }
  EXPECT_GT(refused, 2);
  EXPECT_GT(taken, 1);
}

}  // namespace
}  // namespace mrroc::vsp
