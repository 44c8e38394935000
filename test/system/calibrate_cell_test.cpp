// The task calibrate_cell as a user starts it: what it finds, what it tells when there is nothing to find, and that other
// tasks take what it leaves.
#include <gtest/gtest.h>

#include <filesystem>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// 5 mm and half a degree about a level axis across the line between the arms: up, where the arms meet.
const std::vector<std::string> kWrongBase{
    "--set", "sim.robots.arm2.base_error={ x = 0.003, z = 0.004, ax = 0.0087266 }"};

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

TEST(CalibrateCell, FindsABaseThatIsBelievedWrong) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Calibrated c(
      words({kWrongBase, {"--set", "sim.artefact.offset=[0.006, -0.004, 0.005, 0, 0, 0.02]"}}));
  ASSERT_EQ(c.ended.status, 0) << c.ended.all();
  EXPECT_NEAR(figure(c.told, "base_before_mm"), 5, 0.01);
  EXPECT_NEAR(figure(c.told, "base_before_deg"), 0.5, 0.01);
  EXPECT_LE(figure(c.told, "base_err_mm"), 0.5);
  EXPECT_LE(figure(c.told, "base_err_deg"), 0.05);
  EXPECT_LE(figure(c.told, "touch_rms_mm"), 0.2);
  EXPECT_TRUE(std::filesystem::exists(c.result()));
  EXPECT_TRUE(std::filesystem::exists(c.folder / "run" / "plots" / "balls.png"));
}

TEST(CalibrateCell, TellsThatABallIsNotThere) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Calibrated c({"--set", "sim.artefact.offset=[0, 0, 0.25, 0, 0, 0]"});
  EXPECT_EQ(c.ended.status, 1) << c.ended.all();
  EXPECT_EQ(c.told.at("fault").at("code"), "nothing_touched");
  EXPECT_FALSE(std::filesystem::exists(c.result())) << "nothing that others might take";
}

TEST(CalibrateCell, LeavesAFileThatATaskWithOneArmTakes) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Calibrated c(kWrongBase);
  ASSERT_EQ(c.ended.status, 0) << c.ended.all();
  const Folder folder;
  const Ended press =
      run(folder, "press",
          {"--processes", "one", "--run-dir", (folder / "run").string(), "--config", c.result()});
  EXPECT_EQ(press.status, 0) << press.all();
}

}  // namespace
}  // namespace mrroc::test
