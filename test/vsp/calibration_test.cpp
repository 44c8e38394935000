#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <random>

#include "base/camera_config.hpp"
#include "base/fault.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/calibration/calibrate.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {
namespace fs = std::filesystem;

const test::PlaneCamera& web_camera() {
  static const test::PlaneCamera camera(test::web_camera(), 2);
  return camera;
}

// Exact corners with a little noise: what is tested is what comes after finding them.
BoardView seen(const Pose& T_CG, std::mt19937& random, double noise = 0.05) {
  std::normal_distribution<> n(0, noise);
  BoardView view;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c)
      view.corners.push_back(project(test::web_camera(), T_CG * kBoard.corner(r, c)) +
                             Vector2(n(random), n(random)));
  return view;
}

class CalibrationTest : public testing::Test {
 protected:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  Pose any_view(double tilt = 0.6) {
    return test::facing(uniform(0.4, 0.7), uniform(0.3, 1) * tilt, uniform(0, 6.3), uniform(-0.5, 0.5),
                        uniform(-0.1, 0.1), uniform(-0.07, 0.07));
  }
  Pose any_pose(double turn) {
    AngleAxisPose r;
    for (int k = 0; k < 3; ++k) r[k] = uniform(-0.5, 0.5);
    for (int k = 3; k < 6; ++k) r[k] = uniform(-turn, turn);
    return pose_from_angle_axis(r);
  }
  // Views of a camera at X (E_C T), board at Y (0_G T), or as the arrangement has it.
  std::vector<PosedView> posed(Arrangement arrangement, const Pose& X, const Pose& Y, int n) {
    std::vector<PosedView> views;
    for (int k = 0; k < n; ++k) {
      const Pose T_CG = any_view();
      const Pose A = X * T_CG * Y.inverse();
      views.push_back({seen(T_CG, random_), arrangement == Arrangement::eye_in_hand ? A.inverse() : A});
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

class CalibrateCommand : public CalibrationTest {
 protected:
  CalibrateCommand() : folder_(fs::temp_directory_path() / ("mrroc_calibrate_" + std::to_string(getpid()))) {
    fs::create_directories(folder_ / "pictures");
  }
  ~CalibrateCommand() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(CalibrateCommand, WritesWhatReceptorsAndTasksRead) {
  const Pose X = pose_from_angle_axis((AngleAxisPose() << 0.05, 0.01, 0.02, 0.1, -0.2, 1.5).finished());
  const Pose Y = pose_from_angle_axis((AngleAxisPose() << 0.9, 0.1, 0.0, 0, 0, 0.3).finished());
  std::ofstream poses(folder_ / "poses.csv");
  poses << "# picture,x,y,z,ax,ay,az\n";
  for (int k = 0; k < 12; ++k) {
    const Pose T_CG = any_view();
    const AngleAxisPose r = angle_axis_from_pose(Y * T_CG.inverse() * X.inverse());
    test::Exposure exposure;
    exposure.seed = static_cast<unsigned>(k);
    const std::string name = "view" + std::to_string(k) + ".png";
    write_picture(folder_ / "pictures" / name,
                  web_camera().render(T_CG, test::chessboard_texture(9, 6, 0.025, 0.025), exposure).view());
    poses << name;
    poses.precision(12);
    for (int n = 0; n < 6; ++n) poses << ',' << r[n];
    poses << '\n';
  }
  poses.close();
  CalibrationOrder order;
  order.pictures = folder_ / "pictures";
  order.poses = folder_ / "poses.csv";
  order.output = folder_ / "camera.toml";
  order.name = "eih";
  std::FILE* const quiet = std::fopen("/dev/null", "w");
  calibrate(order, quiet);
  std::fclose(quiet);
  const CameraSetup camera = read_camera(Config::load(order.output), "eih");
  EXPECT_EQ(camera.mount, CameraMount::end_effector);
  EXPECT_EQ(camera.arm, "arm1");
  EXPECT_NEAR(camera.model.fx, 600, 3);
  EXPECT_LT((camera.place.p - X.p).norm(), 0.002);
}

TEST_F(CalibrateCommand, SaysWhatIsWrongWithItsInput) {
  CalibrationOrder order;
  order.pictures = folder_ / "pictures";
  order.output = folder_ / "camera.toml";
  std::FILE* const quiet = std::fopen("/dev/null", "w");
  EXPECT_THROW(calibrate(order, quiet), FaultError);  // no picture
  write_picture(order.pictures / "a.png", Image(640, 480, 1).view());
  EXPECT_NE(refusal([&] { calibrate(order, quiet); }).find("9 x 6"), std::string::npos);
  std::fclose(quiet);
  std::ofstream(folder_ / "poses.csv") << "a.png,1,2,3,4,5,6\nb.png,1,2,x,4,5,6\n";
  EXPECT_NE(refusal([&] { (void)read_poses(folder_ / "poses.csv"); }).find(":2:"), std::string::npos);
  EXPECT_FALSE(fs::exists(order.output));
}

}  // namespace
}  // namespace mrroc::vsp
