// The command `calibrate` with rendered pictures: the camera file that receptors and tasks read, and wrong
// input.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/camera_config.hpp"
#include "base/fault.hpp"
#include "test/vsp/calibration_fixture.hpp"
#include "test/vsp/plane_camera.hpp"
#include "vsp/calibration/calibrate.hpp"
#include "vsp/picture_file.hpp"

namespace mrroc::vsp {
namespace {

namespace fs = std::filesystem;

class CalibrateCommand : public test::CalibrationTest {
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
    write_picture(
        folder_ / "pictures" / name,
        test::web_plane_camera().render(T_CG, test::chessboard_texture(9, 6, 0.025, 0.025), exposure).view());
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
  EXPECT_EQ(camera.mount, CameraMount::robot);
  EXPECT_EQ(camera.robot, "arm1");
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
