// What breaks while the platform drives: each fault is found, told by its name, and survived or stopped.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// Something that is broken on purpose, from the 1500th step on.
struct Broken {
  const char* name;
  std::vector<std::string> settings;
  const char* told;  ///< code of the error that ends the run; none: it is driven to its end
};

/// @return settings with which something of the plant breaks, the second wheel if it is one of a wheel
std::vector<std::string> of_the_simulation(const std::string& key) {
  return {"sim.platforms.rex.faults.wheel=1", "sim.platforms.rex.faults." + key + "=[1500, 100000]"};
}

class RexDriveBroken : public ::testing::TestWithParam<Broken> {};

TEST_P(RexDriveBroken, IsToldByItsNameAndSurvivedOrStopped) {
  const auto& [name, settings, told] = GetParam();
  const Folder folder(false);
  const std::string plan = folder.write("plan.txt", "0 0\n0.7 0\n1.2 0.3\n1.4 0.9\n");
  std::vector<std::string> words{"--plan",      plan,  "--eyes",    "off",
                                 "--processes", "one", "--run-dir", (folder / "run").string()};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  const Ended ended = run(folder, "rex_drive", words);
  const nlohmann::json end = summary(folder / "run");
  if (*told == '\0') {
    EXPECT_EQ(ended.status, 0) << ended.all();
    EXPECT_LE(figure(end, "track_max_mm"), 60);
    return;
  }
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with(std::string("error: ") + told + ": ")) << ended.all();
  EXPECT_LE(figure(end, "stop_steps_max"), 300);
}

INSTANTIATE_TEST_SUITE_P(
    By, RexDriveBroken,
    ::testing::Values(
        Broken{"ABlockedWheel", of_the_simulation("wheel_blocked"), "wheel_blocked"},
        Broken{"AnEncoderThatStands", of_the_simulation("encoder_stuck"), "encoder_fault"},
        Broken{"AnImuThatIsSilent", of_the_simulation("imu_silent"), "sensor_silent"},
        Broken{"AnImuWithoutNumbers", of_the_simulation("imu_nan"), "sensor_silent"},
        Broken{"LoadCellsThatRepeatThemselves", of_the_simulation("load_stuck"), ""},
        Broken{"ALoadCellThatIsWrong", of_the_simulation("load_wrong"), ""},
        Broken{"LoadCellsThatAreSilent", of_the_simulation("load_silent"), ""},
        Broken{"ASolverThatFailsFourTimes", {"platforms.rex.solver_fails=[1500, 1540]"}, ""},
        Broken{"ASolverThatGoesOnFailing", {"platforms.rex.solver_fails=[1500, 100000]"}, "solver_failed"},
        Broken{"AMapThatIsLostForLong", {"motion_capture.lost=[3, 100]"}, ""}),
    [](const auto& broken) { return std::string(broken.param.name); });

}  // namespace
}  // namespace mrroc::test
