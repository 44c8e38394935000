// [odometry.KEY]: the pair as it is read, and what is refused with its key.
#include <gtest/gtest.h>

#include <string>

#include "test/vsp/stereo_config.hpp"
#include "vsp/odometry/config.hpp"

namespace mrroc::vsp {
namespace {

using test::stereo_text;
using test::with;

StereoSetup read(const std::string& text) { return read_stereo(Config::parse(text, "test"), "rex"); }

std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const ConfigError& e) {
    return e.key() + ": " + e.what();
  }
  return "";
}

void expect_refused(const std::string& text, const std::string& key, const std::string& said) {
  const std::string all = refusal(text);
  EXPECT_EQ(all.rfind(key + ":", 0), 0U) << all;
  EXPECT_NE(all.find(said), std::string::npos) << all;
}

TEST(OdometryConfig, IsThePairWithItsBaselineFromTheCamerasPoses) {
  const StereoSetup pair = read(stereo_text());
  EXPECT_EQ(pair.key, "rex");
  EXPECT_EQ(pair.left.key, "rex_left");
  EXPECT_EQ(pair.right.key, "rex_right");
  EXPECT_EQ(pair.left.period, 40);
  EXPECT_NEAR(pair.rig().baseline(), 0.12, 1e-9);
  EXPECT_NEAR((pair.rig().T_BS().p - Vector3(0.2, 0.06, 0.45)).norm(), 0, 1e-9);
  EXPECT_EQ(pair.parameters.inliers, 25);
}

TEST(OdometryConfig, SetsEveryThreshold) {
  const auto& k = read(with(stereo_text(), "[odometry.rex]\n",
                            "[odometry.rex]\ninliers = 30\ncells = 5\nrms = 0.8\nway = 0.2\n"))
                      .parameters;
  EXPECT_EQ(k.inliers, 30);
  EXPECT_EQ(k.cells, 5);
  EXPECT_EQ(k.rms_px, 0.8);
  EXPECT_EQ(k.way, 0.2);
}

TEST(OdometryConfig, RefusesWhatIsNoPairAndNamesTheKey) {
  const std::string text = stereo_text();
  expect_refused(with(text, "right = \"rex_right\"\n", ""), "odometry.rex.right", "");
  expect_refused(with(text, "right = \"rex_right\"", "right = \"rex_left\""), "odometry.rex.right",
                 "is no pair");
  expect_refused(with(text, "right = \"rex_right\"", "right = \"other\""), "cameras.other.pose", "");
  expect_refused(with(text, "mount = \"rex\"", "mount = \"world\""), "cameras.rex_right.mount", "\"rex\"");
  expect_refused(with(text, "mount = \"rex\"", "mount = \"rex.base\""), "cameras.rex_right.mount", "\"rex\"");
  expect_refused(with(text, "mount = \"rex\"", "mount = \"arm1\""), "cameras.rex_right.mount", "\"rex\"");
  expect_refused(text + "width = 320\n", "odometry.rex", "one width: rex_left has 640, rex_right has 320");
  expect_refused(text + "height = 320\n", "odometry.rex", "one height: rex_left has 480, rex_right has 320");
  expect_refused(with(text, "period = 40", "period = 50"), "odometry.rex", "one period: rex_left has 40");
  expect_refused(with(text, "latency = 40", "latency = 60"), "odometry.rex", "one latency: rex_left has 40");
  expect_refused(with(text, "[odometry.rex]\n", "[odometry.rex]\ninliers = 5\n"), "odometry.rex.inliers", "");
}

TEST(OdometryConfig, APairWithoutBaselineOrTheWrongWayRoundIsRefused) {
  const std::string left = test::stereo_camera_text("rex_left", 0.06);
  const std::string right = test::stereo_camera_text("rex_right", -0.06);
  const std::string same = with(stereo_text(), right, test::stereo_camera_text("rex_right", 0.06));
  EXPECT_THROW((void)read(same).rig(), FaultError);
  const std::string swapped = with(stereo_text(), right, test::stereo_camera_text("rex_right", 0.18));
  EXPECT_THROW((void)read(swapped).rig(), FaultError);
}

}  // namespace
}  // namespace mrroc::vsp
