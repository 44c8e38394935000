// The task calibrate_cell as a user starts it: what it finds, what it tells when there is nothing to find, and that other
// tasks take what it leaves.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "test/system/cube_run.hpp"

namespace mrroc::test {
namespace {

/// 5 mm and half a degree about a level axis across the line between the arms: up, where the arms meet.
const std::vector<std::string> kWrongBase{
    "--set", "sim.robots.arm2.base_error={ x = 0.003, z = 0.004, ax = 0.0087266 }"};

/// Cameras, and the board, elsewhere than they are believed.
const std::vector<std::string> kWrongCameras{
    "--set", "sim.cameras.eih.place_error={ x = 0.003, y = -0.002, ax = 0.006, az = 0.004 }", "--set",
    "sim.cameras.sac.place_error={ x = 0.002, y = 0.002, ax = 0.005, ay = -0.004 }"};
const std::vector<std::string> kWrongBoard{
    "--set", "sim.object.place_error={ x = 0.003, y = 0.004, z = -0.002, ax = 0.02, az = 0.02 }"};

struct Calibrated {
  explicit Calibrated(const std::vector<std::string>& arguments)
      : ended(run(folder, "calibrate_cell",
                  words({{"--processes", "one", "--run-dir", (folder / "run").string()}, arguments}))) {
    if (std::filesystem::exists(folder / "run" / "summary.json")) told = summary((folder / "run").string());
  }
  [[nodiscard]] std::string result() const { return (folder / "run" / "calibrated.toml").string(); }

  Folder folder;
  Ended ended;
  nlohmann::json told;
};

TEST(CalibrateCell, TellsThatABallIsNotThere) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Calibrated c({"--set", "sim.artefact.place_error.z=0.25", "--set", "task.ways=touch"});
  EXPECT_EQ(c.ended.status, 1) << c.ended.all();
  EXPECT_EQ(c.told.at("fault").at("code"), "nothing_touched");
  EXPECT_FALSE(std::filesystem::exists(c.result())) << "nothing that others might take";
}

/// One calibration of a cell whose base and balls are elsewhere than they are believed.
class CalibratedCell : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (kSanitized) return;
    calibrated() = std::make_unique<Calibrated>(
        words({kWrongBase,
               kWrongCameras,
               kWrongBoard,
               {"--set", "sim.artefact.place_error={ x = 0.006, y = -0.004, z = 0.005, az = 0.02 }"}}));
  }
  static void TearDownTestSuite() { calibrated().reset(); }
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
    ASSERT_EQ(calibrated()->ended.status, 0) << calibrated()->ended.all();
  }
  static std::unique_ptr<Calibrated>& calibrated() {
    static std::unique_ptr<Calibrated> run;
    return run;
  }
};

TEST_F(CalibratedCell, HasItsBasesWhereTheyAreFound) {
  const nlohmann::json& told = calibrated()->told;
  EXPECT_NEAR(figure(told, "base_before_mm"), 5, 0.01);
  EXPECT_NEAR(figure(told, "base_before_deg"), 0.5, 0.01);
  EXPECT_LE(figure(told, "base_err_mm"), 0.5);
  EXPECT_LE(figure(told, "base_err_deg"), 0.05);
  EXPECT_LE(figure(told, "touch_rms_mm"), 0.2);
  EXPECT_TRUE(std::filesystem::exists(calibrated()->result()));
  EXPECT_TRUE(std::filesystem::exists(calibrated()->folder / "run" / "plots" / "balls.png"));
}

TEST_F(CalibratedCell, HasTheSameBasesAndTheCamerasByPictures) {
  const nlohmann::json& told = calibrated()->told;
  EXPECT_LE(figure(told, "camera_base_err_mm"), 0.5);
  EXPECT_LE(figure(told, "camera_base_err_deg"), 0.05);
  EXPECT_LE(figure(told, "way_difference_mm"), 0.5);
  EXPECT_LE(figure(told, "camera_place_err_mm"), 0.5);
  EXPECT_LE(figure(told, "fixed_camera_err_mm"), 2);
  EXPECT_EQ(figure(told, "pictures_unseen"), 0);
  EXPECT_EQ(calibrated()->ended.all().find("DISAGREE"), std::string::npos);
}

TEST_F(CalibratedCell, BringsTheToolBeforeAnObjectThatItsCamerasMissedBefore) {
  const Folder folder;
  const auto missed = [&](const std::string& name, const std::vector<std::string>& told) {
    const std::string to = (folder / name).string();
    const Ended servo =
        run(folder, "visual_servo", words({{"--processes", "one", "--run-dir", to}, kWrongCameras, told}));
    EXPECT_EQ(servo.status, 0) << servo.all();
    return figure(summary(to), "true_err_mm");
  };
  EXPECT_GT(missed("before", {}), 2);
  EXPECT_LT(missed("after", {"--config", calibrated()->result()}), 0.7);
}

TEST(CalibrateCell, SaysThatBothWaysDisagreeWhenATipIsNotAsBelieved) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Calibrated c({"--set", "sim.pen_radius=0.011", "--set", "cameras.order=[\"eih\"]", "--set",
                      "task.views=8", "--set",
                      "artefact.balls=[-0.15, -0.02, -0.06, 0.15, 0.02, -0.06, 0.15, -0.02, 0.06]", "--set",
                      "task.readings=5"});
  ASSERT_EQ(c.ended.status, 0) << c.ended.all();
  EXPECT_GT(figure(c.told, "way_difference_mm"), 1.5);
  EXPECT_LE(figure(c.told, "camera_base_err_mm"), 0.5) << "pictures know nothing of the tip";
  EXPECT_NE(c.ended.all().find("BOTH WAYS DISAGREE"), std::string::npos);
}

TEST_F(CalibratedCell, LeavesAFileThatATaskWithOneArmTakes) {
  const Folder folder;
  const Ended press =
      run(folder, "press",
          {"--processes", "one", "--run-dir", (folder / "run").string(), "--config", calibrated()->result()});
  EXPECT_EQ(press.status, 0) << press.all();
}

TEST_F(CalibratedCell, SolvesTheCubeThatHandsMissBefore) {
  const std::vector<std::string> turns{"--scramble", "R U'", "--eyes", "none", "--set", "task.tables=small"};
  const std::vector<std::string> truth = words({{"--processes", "one"}, kWrongBase});
  const CubeRun before(truth, turns);
  EXPECT_EQ(before.ended.status, 1) << before.ended.all();
  EXPECT_EQ(before.figure("solved"), 0);
  const CubeRun after(words({truth, {"--config", calibrated()->result()}}), turns);
  EXPECT_EQ(after.ended.status, 0) << after.ended.all();
  EXPECT_EQ(after.figure("solved"), 1);
  const CubeRun again({"--config", (after.folder / "run" / "config.toml").string()}, {"--eyes", "none"});
  EXPECT_EQ(again.ended.status, 2) << "a run's configuration has a camera or none";
}

TEST(CalibrateCell, FindsTheSetsOfBothArmsWithWhichDrawingCopies) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const std::vector<std::string> truth{"--set", "sim.robots.arm1.kinematics=calibrated", "--set",
                                       "sim.robots.arm2.kinematics=calibrated"};
  const Calibrated c(truth);
  ASSERT_EQ(c.ended.status, 0) << c.ended.all();
  EXPECT_EQ(figure(c.told, "sets_wrong"), 0);
  EXPECT_LE(figure(c.told, "base_err_mm"), 0.5);
  EXPECT_LE(figure(c.told, "base_err_deg"), 0.05);
  EXPECT_GT(figure(c.told, "other_sets_rms_mm"), 10 * figure(c.told, "sets_rms_mm"));
  const Folder folder;
  const auto copy_rms = [&](const std::string& name, const std::vector<std::string>& told) {
    const std::string to = (folder / name).string();
    const Ended drawing =
        run(folder, "drawing", words({{"--processes", "one", "--run-dir", to}, truth, told}));
    EXPECT_EQ(drawing.status, 0) << drawing.all();
    const auto of_arms = summary(to).at("figures").at("copy_rms_mm").get<std::vector<double>>();
    return std::ranges::max(of_arms);
  };
  EXPECT_GT(copy_rms("before", {}), 1);
  EXPECT_LT(copy_rms("after", {"--config", c.result()}), 0.03);
}

}  // namespace
}  // namespace mrroc::test
