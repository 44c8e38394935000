#include "base/camera_config.hpp"

#include <gtest/gtest.h>

namespace mrroc {
namespace {

Config with(const std::string& text) { return Config::parse(text, "test.toml"); }
const std::string kPose = "pose = [0.1, 0.2, 0.3, 0, 0, 1.5707963267948966]\n";

TEST(CameraConfig, HasNoCamerasUnlessTheyAreNamed) {
  EXPECT_TRUE(camera_keys(Config()).empty());
  EXPECT_EQ(camera_keys(with("[cameras]\norder = ['sac', 'eih']")), (std::vector<std::string>{"sac", "eih"}));
  for (const char* bad : {"''", "'a b'", "'a.b'", "'../x'", "'seventeen-letters'"})
    EXPECT_THROW(camera_keys(with("[cameras]\norder = [" + std::string(bad) + "]")), ConfigError) << bad;
}

TEST(CameraConfig, TellsInWhichFrameThePlaceIsKnown) {
  const auto mount = [](const std::string& text) {
    return read_camera(with("[cameras.sac]\n" + kPose + "mount = '" + text + "'"), "sac");
  };
  EXPECT_EQ(mount("world").mount, CameraMount::world);
  EXPECT_EQ(mount("arm1.base").mount, CameraMount::base);
  EXPECT_EQ(mount("arm1.base").arm, "arm1");
  EXPECT_EQ(mount("arm2").mount, CameraMount::end_effector);
  EXPECT_EQ(mount("arm2").arm, "arm2");
  for (const char* bad : {"", ".base", "arm 1", "arm1.tool"}) EXPECT_THROW(mount(bad), ConfigError) << bad;
}

TEST(CameraConfig, ReadsPoseAndModelWithTheAxisInTheMiddleUnlessToldOtherwise) {
  const CameraSetup camera = read_camera(
      with("[cameras.sac]\n" + kPose + "width = 800\nfx = 700\ndistortion = [-0.1, 0.02, 0.001, 0.002, 0]"),
      "sac");
  EXPECT_LT((camera.place * Vector3(1, 0, 0) - Vector3(0.1, 1.2, 0.3)).norm(), 1e-12);
  EXPECT_EQ(camera.model, (CameraModel{800, 480, 700, 700, 399.5, 239.5, {-0.1, 0.02, 0.001, 0.002, 0}}));
  EXPECT_EQ(camera.period, 20);
  EXPECT_EQ(camera.latency, 20);
}

TEST(CameraConfig, RefusesWhatIsNoCamera) {
  for (const char* bad : {"", "pose = [0, 0, 0]", "pose = [0, 0, 0, 0, 0, 'a']"})
    EXPECT_THROW(read_camera(with("[cameras.sac]\n" + std::string(bad)), "sac"), ConfigError) << bad;
  for (const char* bad : {"width = 0", "fx = -1", "fy = inf", "latency = -1", "period = 0",
                          "distortion = [1]", "period = 9", "latency = 101"})
    EXPECT_THROW(read_camera(with("[cameras.sac]\n" + kPose + bad), "sac"), ConfigError) << bad;
}

TEST(CameraConfig, LooksAtAPoint) {
  const Pose T = looking_at({1, 2, 3}, {1, 2, 0}, {0, 1, 0});
  EXPECT_TRUE(is_proper(T));
  EXPECT_LT((T * Vector3(0, 0, 3) - Vector3(1, 2, 0)).norm(), 1e-12);
  EXPECT_LT((T.R * Vector3(0, -1, 0) - Vector3(0, 1, 0)).norm(), 1e-12) << "up is up";
  EXPECT_LT((T.R * Vector3(1, 0, 0) - Vector3(1, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace mrroc
