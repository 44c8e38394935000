#include "sim/camera/config.hpp"

#include <gtest/gtest.h>

namespace mrroc::sim {
namespace {

const std::string kCameras = R"([cameras]
order = ['sac', 'eih']
[cameras.sac]
mount = 'arm1.base'
pose = [1, 0, 2, 3.14, 0, 0]
[cameras.eih]
mount = 'arm1'
pose = [0.1, 0, -0.1, 0, 0, 0]
)";

CameraWorld read(const std::string& text) {
  return read_camera_world(Config::parse(text, "test.toml"), {"arm1", "arm2"}, {"rex"});
}

TEST(CameraWorldConfig, HasNoCamerasByDefault) { EXPECT_TRUE(read("").cameras.empty()); }

TEST(CameraWorldConfig, GivesEveryCameraTheProfileAndNoiseOfItsOwn) {
  const CameraWorld exact = read(kCameras);
  ASSERT_EQ(exact.cameras.size(), 2U);
  EXPECT_EQ(exact.cameras[0].profile.samples, 4);
  EXPECT_NE(exact.cameras[0].profile.seed, exact.cameras[1].profile.seed);
  EXPECT_NE(exact.cameras[0].profile.seed, read("seed = 2\n" + kCameras).cameras[0].profile.seed);
  std::string text = kCameras;
  const CameraWorld fast = read(text.insert(text.find("[cameras.sac]"), "profile = 'fast'\n"));
  EXPECT_EQ(fast.cameras.at(1).profile.samples, 1);
  EXPECT_EQ(fast.cameras.at(1).profile.shadow_size, 0);
}

TEST(CameraWorldConfig, RefusesWhatCannotBe) {
  for (const char* bad : {"mount = 'arm3'", "exposure = 20", "exposure = 15\nlatency = 5",
                          "exposure = 5\nlatency = 2", "noise = -1", "picture = 'red'"})
    EXPECT_THROW(read("[cameras]\norder = ['a']\n[cameras.a]\npose = [0,0,0,0,0,0]\n" + std::string(bad)),
                 ConfigError)
        << bad;
  for (const char* bad : {"kind = 'ball'", "kind = 'apriltag'\ntag = 99", "kind = 'chessboard'\narm = 'arm9'",
                          "motion = 'jump'", "speed = -1", "pose = [1]"})
    EXPECT_THROW(read(kCameras + "[object]\n" + bad), ConfigError) << bad;
  EXPECT_THROW(read(kCameras + "[cameras.light]\ndirection = [0, 0, 0]"), ConfigError);
}

TEST(CameraWorldConfig, ReadsWhatGoesWrongWithACamera) {
  const CameraWorld w = read(
      kCameras + "silent = [1, 2, 4, 5]\nblack = [3, 4]\nfrozen = [6, 7]\nhangs = [8, 9]\nshows = 'sac'\n");
  const CameraFaults& faults = w.cameras[1].faults;
  ASSERT_EQ(faults.silent.size(), 2U);
  EXPECT_EQ(faults.silent[1].from, 4);
  EXPECT_EQ(faults.silent[1].to, 5);
  EXPECT_EQ(faults.black.at(0).from, 3);
  EXPECT_EQ(faults.frozen.at(0).to, 7);
  EXPECT_EQ(faults.hangs.at(0).from, 8);
  EXPECT_EQ(faults.shows, "sac");
  EXPECT_EQ(w.cameras[0].faults.shows, "sac") << "its own view";
  EXPECT_TRUE(w.cameras[0].faults.silent.empty());
  for (const char* bad :
       {"silent = [1]", "black = [2, 1]", "frozen = [-1, 1]", "hangs = [2, 1]", "shows = 'nobody'"})
    EXPECT_THROW(read(kCameras + bad), FaultError) << bad;
}

TEST(CameraWorldConfig, ReadsTheObjectAndTheLight) {
  const CameraWorld w = read(kCameras + R"([cameras.light]
lamp = [0.5, 0.4, 0.3]
exposure = 2
[object]
kind = 'apriltag'
tag = 3
motion = 'circle'
radius = 0.1
pose = [0.8, 0.1, 0.93, 0, 0, 1]
)");
  EXPECT_EQ(w.light.lamp, (camera::Colour{0.5, 0.4, 0.3}));
  EXPECT_EQ(w.light.exposure, 2);
  EXPECT_EQ(w.object.kind, ObjectKind::apriltag);
  EXPECT_EQ(w.object.motion, ObjectMotion::circle);
  EXPECT_EQ(w.object.T_0G.p, Vector3(0.8, 0.1, 0.93));
  EXPECT_EQ(w.object.tag, 3);
}

}  // namespace
}  // namespace mrroc::sim
