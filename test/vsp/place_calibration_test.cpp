// The calibration of a camera's place: every arrangement of camera, hand and board, its errors, and the
// pictures and poses that it refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/vsp/calibration_fixture.hpp"
#include "vsp/calibration/calibrate.hpp"

namespace mrroc::vsp {
namespace {

using test::CalibrationTest;
using test::seen;

TEST_F(CalibrationTest, FindsTheCameraInEveryArrangement) {
  for (const Arrangement a :
       {Arrangement::eye_in_hand, Arrangement::board_in_hand, Arrangement::known_board}) {
    const Pose X = any_pose(2);
    const Pose Y = a == Arrangement::known_board ? Pose{} : any_pose(2);
    const auto views = posed(a, X, Y, 15);
    const PlaceCalibration place = calibrate_place(test::web_camera(), a, views);
    EXPECT_LT((place.camera.p - X.p).norm(), 0.0007) << static_cast<int>(a);
    EXPECT_LT((place.camera.R - X.R).norm(), 0.002) << static_cast<int>(a);
    EXPECT_LT((place.board.p - Y.p).norm(), 0.0007) << static_cast<int>(a);
    EXPECT_LT(place.rms_px, 0.1);
    EXPECT_LT((place.camera.p - X.p).norm(), 5 * place.sigma_m + 1e-5);
    EXPECT_EQ(place.view_px.size(), views.size());
  }
}

TEST_F(CalibrationTest, RefusesPosesThatLeaveThePlaceOpen) {
  const Pose X = any_pose(1);
  auto views = posed(Arrangement::eye_in_hand, X, any_pose(1), 10);
  EXPECT_NE(refusal([&] {
              calibrate_place(test::web_camera(), Arrangement::eye_in_hand, std::span(views).first(2));
            }).find("at least 3"),
            std::string::npos);
  // Every picture in the line of another pose.
  std::rotate(views.begin(), views.begin() + 1, views.end());
  auto shuffled = views;
  for (std::size_t k = 0; k < views.size(); ++k) shuffled[k].known = views[(k + 3) % views.size()].known;
  EXPECT_NE(refusal([&] { calibrate_place(test::web_camera(), Arrangement::eye_in_hand, shuffled); }), "");
  // About one axis only.
  std::vector<PosedView> one_axis;
  const Pose Y = any_pose(1);
  for (int k = 0; k < 8; ++k) {
    Pose A;
    A.R = rotation_from_angle_axis({0, 0, 0.15 * k});
    const Pose T_CG = X.inverse() * A.inverse() * Y;
    one_axis.push_back({seen(T_CG.p.z() > 0.1 ? T_CG : any_view(), random_), A});
  }
  EXPECT_NE(refusal([&] {
              calibrate_place(test::web_camera(), Arrangement::eye_in_hand, one_axis);
            }).find("one axis"),
            std::string::npos);
}

// The hand's turns count from the first view, wherever that is.
TEST_F(CalibrationTest, RefusesAHandThatHardlyTurned) {
  const Pose X = any_pose(1), Y = any_pose(1);
  for (const double turn : {0.13, 0.25}) {
    std::vector<PosedView> views;
    for (int k = 0; k < 8; ++k) {
      Pose A;  // far from the base's axes all the time
      A.R = rotation_from_angle_axis({0, 2, 0}) *
            rotation_from_angle_axis(k == 0 ? Vector3(0, 0, 0) : Vector3(k % 2, 1 - k % 2, 0) * turn);
      A.p = {0.01 * k, 0, 0};
      const Pose T_CG = X.inverse() * A.inverse() * Y;
      views.push_back({seen(T_CG.p.z() > 0.1 ? T_CG : any_view(), random_), A});
    }
    const std::string why =
        refusal([&] { calibrate_place(test::web_camera(), Arrangement::eye_in_hand, views); });
    EXPECT_NE(why.find("turned by"), std::string::npos) << why;
    EXPECT_NE(why.find(turn < 0.2 ? " 7 degrees" : " 14 degrees"), std::string::npos) << why;
  }
}

TEST_F(CalibrationTest, TooFewPicturesForAPlaceAreCounted) {
  const auto why = [this](Arrangement a, int n) {
    const auto views = posed(a, any_pose(1), any_pose(1), n);
    return refusal([&] { calibrate_place(test::web_camera(), a, views); });
  };
  const std::string found = "the board was found in ";
  EXPECT_NE(
      why(Arrangement::known_board, 0).find(found + "0 pictures with a known pose; at least 1 is needed"),
      std::string::npos);
  EXPECT_NE(
      why(Arrangement::eye_in_hand, 1).find(found + "1 picture with a known pose; at least 3 are needed"),
      std::string::npos);
  EXPECT_NE(
      why(Arrangement::board_in_hand, 2).find(found + "2 pictures with a known pose; at least 3 are needed"),
      std::string::npos);
}

TEST_F(CalibrationTest, ThreePicturesOrOneOfAKnownBoardAreEnoughForAPlace) {
  const Pose X = any_pose(1), Y = any_pose(1);
  const auto three = posed(Arrangement::eye_in_hand, X, Y, 3);
  EXPECT_LT((calibrate_place(test::web_camera(), Arrangement::eye_in_hand, three).camera.p - X.p).norm(),
            0.004);
  const auto one = posed(Arrangement::known_board, X, Pose{}, 1);
  const PlaceCalibration place = calibrate_place(test::web_camera(), Arrangement::known_board, one);
  EXPECT_LT((place.camera.p - X.p).norm(), 0.002);
  EXPECT_EQ(place.board.p, Vector3::Zero());
  EXPECT_EQ(place.board.R, Matrix3::Identity());
}

TEST_F(CalibrationTest, ExactCornersGiveTheExactPlaceAndNoError) {
  for (const Arrangement a :
       {Arrangement::eye_in_hand, Arrangement::board_in_hand, Arrangement::known_board}) {
    const Pose X = any_pose(1), Y = a == Arrangement::known_board ? Pose{} : any_pose(1);
    auto views = posed(a, X, Y, 5);
    for (PosedView& v : views) {
      const Pose A = a == Arrangement::eye_in_hand ? v.known.inverse() : v.known;
      v.view = seen(X.inverse() * A * Y, random_, 0);
    }
    const PlaceCalibration place = calibrate_place(test::web_camera(), a, views);
    EXPECT_LT((place.camera.p - X.p).norm(), 1e-5) << static_cast<int>(a);
    EXPECT_LT((place.camera.R - X.R).norm(), 1e-5) << static_cast<int>(a);
    EXPECT_LT((place.board.p - Y.p).norm(), 1e-5) << static_cast<int>(a);
    EXPECT_TRUE(is_proper(place.camera) && is_proper(place.board));
    EXPECT_LT(place.rms_px, 1e-2);
    EXPECT_LT(place.sigma_m, 1e-5);
  }
}

TEST_F(CalibrationTest, ThePlacesErrorIsThatOfAllPicturesAndOfEachOne) {
  const Pose X = any_pose(1);
  auto views = posed(Arrangement::known_board, X, Pose{}, 6);
  for (std::size_t k = 0; k < views.size(); ++k)
    views[k].view.corners = seen(X.inverse() * views[k].known, random_, k == 2 ? 2 : 0.2).corners;
  const PlaceCalibration place = calibrate_place(test::web_camera(), Arrangement::known_board, views);
  double squares = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    squares += place.view_px[k] * place.view_px[k] / 6;
    EXPECT_NEAR(place.view_px[k], std::numbers::sqrt2 * (k == 2 ? 2 : 0.2), k == 2 ? 0.5 : 0.15) << k;
  }
  EXPECT_NEAR(std::sqrt(squares), place.rms_px, 1e-9);
}

// A small board has few corners: it matters how many of the residuals are free.
TEST_F(CalibrationTest, ThePlacesUncertaintyIsThatOfManyCalibrations) {
  const Board board{.columns = 3, .rows = 2};
  const Pose X = any_pose(1);
  Vector3 squares = Vector3::Zero();
  double told = 0;
  constexpr int kRuns = 150;
  const Pose T_CG = test::facing(0.2, 0.5, 1, 0.3);
  for (int run = 0; run < kRuns; ++run) {
    std::normal_distribution<> n(0, 0.05);
    PosedView view{{"a", {}}, X * T_CG};
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 3; ++c)
        view.view.corners.emplace_back(project(test::web_camera(), T_CG * board.corner(r, c)) +
                                       Vector2(n(random_), n(random_)));
    const PlaceCalibration place =
        calibrate_place(test::web_camera(), Arrangement::known_board, std::span(&view, 1), board);
    squares += (place.camera.p - X.p).cwiseAbs2() / kRuns;
    told += place.sigma_m * place.sigma_m / kRuns;
  }
  EXPECT_NEAR(std::sqrt(told / squares.maxCoeff()), 1, 0.2);
}

TEST_F(CalibrationTest, APictureThatShowsNoBoardIsNamed) {
  auto views = posed(Arrangement::known_board, any_pose(1), Pose{}, 3);
  views[1].view.name = "the second one";
  views[1].view.corners.pop_back();
  EXPECT_NE(refusal([&] {
              calibrate_place(test::web_camera(), Arrangement::known_board, views);
            }).find("the second one: no pose of the board explains the picture"),
            std::string::npos);
}

// 0.26 rad at most between the hand's first pose and another one, and 0.1 about an axis across.
TEST_F(CalibrationTest, TheHandMustTurnByFifteenDegreesAndAboutTwoAxes) {
  const Pose X = any_pose(1), Y = any_pose(1);
  const auto with = [&](double turn, double across) {
    std::vector<PosedView> views;
    for (const Vector3& by : {Vector3(0, 0, 0), Vector3(0, 0, turn), Vector3(across, 0, 0)}) {
      Pose A = X * any_view() * Y.inverse();
      A.R = any_pose(0).R * rotation_from_angle_axis(by);
      views.push_back({seen(any_view(), random_), A});
    }
    return refusal([&] { calibrate_place(test::web_camera(), Arrangement::board_in_hand, views); });
  };
  EXPECT_NE(with(0.25, 0.2).find("the hand turned by 14 degrees at most; at least 15 are needed"),
            std::string::npos);
  EXPECT_NE(with(0.27, 0.09).find("the hand turned about one axis only; turn it about another one, too"),
            std::string::npos);
  const std::string enough = with(0.27, 0.11);
  EXPECT_EQ(enough.find("the hand turned"), std::string::npos) << enough;
}

// The hand turned, but all pictures are the same.
TEST_F(CalibrationTest, RefusesPicturesThatAnyPlaceWouldExplainAsBadly) {
  for (const Arrangement a : {Arrangement::eye_in_hand, Arrangement::board_in_hand}) {
    const BoardView view = seen(test::facing(0.5, 0.3, 1, 0.2), random_, 0);
    std::vector<PosedView> views;
    for (int k = 0; k < 5; ++k) views.push_back({view, any_pose(1)});
    EXPECT_NE(refusal([&] {
                calibrate_place(test::web_camera(), a, views);
              }).find("no place of the camera explains the pictures"),
              std::string::npos);
  }
}

TEST_F(CalibrationTest, APlaceMayLeaveFivePixelsUnexplainedAndNoMore) {
  const auto with = [this](double noise) {
    const Pose X = any_pose(1);
    auto views = posed(Arrangement::known_board, X, Pose{}, 12);
    for (PosedView& v : views) v.view.corners = seen(X.inverse() * v.known, random_, noise).corners;
    return refusal([&] { calibrate_place(test::web_camera(), Arrangement::known_board, views); });
  };
  EXPECT_EQ(with(3.3).find("do not fit"), std::string::npos);
  const std::string why = with(3.8);
  EXPECT_NE(why.find("pictures and poses do not fit together: 5."), std::string::npos) << why;
  EXPECT_NE(why.find(" pixels; is every picture in the line of its pose?"), std::string::npos) << why;
}

// Corners that are found badly, in few views: everything fits, and the place is still anywhere.
TEST_F(CalibrationTest, RefusesAPlaceThatStaysUncertain) {
  int uncertain = 0;
  for (int run = 0; run < 20; ++run) {
    const Pose X = any_pose(1), Y = any_pose(1);
    std::vector<PosedView> views;
    for (int k = 0; k < 4; ++k) {
      Pose T_CG = test::facing(1.6, uniform(0.1, 0.2), uniform(0, 6.3), uniform(-0.2, 0.2));
      views.push_back({seen(T_CG, random_, 2.5), (X * T_CG * Y.inverse()).inverse()});
    }
    try {
      const PlaceCalibration place = calibrate_place(test::web_camera(), Arrangement::eye_in_hand, views);
      EXPECT_LT(place.sigma_m, 0.005);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_calibration);
      const std::string why = e.what(), begin = "the camera's position stays uncertain by ";
      const auto at = why.find(begin);
      if (at == std::string::npos) continue;
      ++uncertain;
      const double millimetres = std::stod(why.substr(at + begin.size()));
      EXPECT_GE(millimetres, 5);
      EXPECT_LT(millimetres, 5000);
      EXPECT_NE(why.find(" mm; turn the hand more", at), std::string::npos) << why;
    }
  }
  EXPECT_GT(uncertain, 3);
}

}  // namespace
}  // namespace mrroc::vsp
