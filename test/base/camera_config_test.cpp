#include "base/camera_config.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <tuple>

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
  EXPECT_EQ(mount("arm1.base").robot, "arm1");
  EXPECT_EQ(mount("arm2").mount, CameraMount::robot);
  EXPECT_EQ(mount("arm2").robot, "arm2");
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

TEST(CameraConfig, TakesEveryNumberUpToItsLimitsAndNoneBeyond) {
  struct Limits {
    const char* key;
    double low, high, beyond;  // the last one: how far outside is refused
  };
  for (const Limits& l :
       {Limits{"width", 16, 4096, 1}, Limits{"height", 16, 4096, 1}, Limits{"fx", 10, 1e5, 0.5},
        Limits{"fy", 10, 1e5, 0.5}, Limits{"cx", -1e4, 1e4, 1}, Limits{"cy", -1e4, 1e4, 1},
        Limits{"period", 10, 250, 1}, Limits{"latency", 0, 100, 1}}) {
    const auto read = [&](double value) {
      std::ostringstream text;
      text.precision(12);
      text << "[cameras.sac]\n" << kPose << l.key << " = " << value;
      return read_camera(with(text.str()), "sac");
    };
    EXPECT_NO_THROW(read(l.low)) << l.key;
    EXPECT_NO_THROW(read(l.high)) << l.key;
    EXPECT_THROW(read(l.low - l.beyond), ConfigError) << l.key;
    EXPECT_THROW(read(l.high + l.beyond), ConfigError) << l.key;
  }
  const auto numbers = [](const std::string& line) {
    return read_camera(with("[cameras.sac]\n" + line), "sac");
  };
  EXPECT_NO_THROW(numbers("pose = [10, -10, 0, 0, 0, 0]"));
  EXPECT_THROW(numbers("pose = [10.1, 0, 0, 0, 0, 0]"), ConfigError);
  EXPECT_NO_THROW(numbers(kPose + "distortion = [10, -10, 0, 0, 0]"));
  EXPECT_THROW(numbers(kPose + "distortion = [0, 0, 0, 0, -10.1]"), ConfigError);
  const CameraSetup all = numbers(kPose +
                                  "width = 100\nheight = 50\nfx = 70\nfy = 80\ncx = 1\ncy = 2\nperiod = 40\n"
                                  "latency = 30");
  EXPECT_EQ(all.model, (CameraModel{100, 50, 70, 80, 1, 2, {}}));
  EXPECT_EQ(all.period, 40);
  EXPECT_EQ(all.latency, 30);
  EXPECT_EQ(all.key, "sac");
  EXPECT_EQ(read_camera_model(with("[cameras.eih]\nwidth = 101\n"), "eih").cx, 50);
}

TEST(CameraConfig, SaysWhatIsWrongWithAName) {
  const auto said = [](const std::string& text) -> std::string {
    try {
      const Config config = with(text);
      std::ignore = camera_keys(config);
      std::ignore = read_camera(config, "sac");
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(said("[cameras]\norder = ['sac', 'eih', 'sac']").find("the camera 'sac' is named twice"),
            std::string::npos);
  EXPECT_NE(said("[cameras]\norder = ['a b']").find("'a b' is no name of a camera"), std::string::npos);
  EXPECT_NE(said("[cameras.sac]\n" + kPose + "mount = 'a.b'").find("'a.b' is not \"world\", an arm"),
            std::string::npos);
  EXPECT_NE(said("[cameras.sac]\n" + kPose + "latency = 101").find("an eighth of the latency and 60 steps"),
            std::string::npos);
  EXPECT_EQ(said("[cameras]\norder = ['sixteen-letters_', 'B2']\n[cameras.sac]\n" + kPose), "");
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
