// What breaks while the platform drives: each fault is found, told by its name, and survived or stopped.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// Something that is broken on purpose, from the 1500th step on.
struct Broken {
  const char* name;
  std::vector<std::string> settings;
  const char* told;        ///< code of the error that ends the run; none: it is driven to its end
  const char* wheel = "";  ///< what the error says of the wheel
  const char* line = "";   ///< what is told once of what is survived; empty: nothing is
  const char* plan{};      ///< that is built in; none: a short one
};

/// @return settings with which something of the plant breaks, the second wheel if it is one of a wheel
std::vector<std::string> of_the_simulation(const std::string& key) {
  return {"sim.platforms.rex.faults.wheel=1", "sim.platforms.rex.faults." + key + "=[1500, 100000]"};
}

Ended drive(const Folder& folder, const std::string& name, const std::vector<std::string>& settings,
            const char* built_in = nullptr) {
  const std::string plan = built_in ? built_in : folder.write("plan.txt", "0 0\n0.7 0\n1.2 0.3\n1.4 0.9\n");
  std::vector<std::string> words{"--plan",      plan,  "--eyes",    "off",
                                 "--processes", "one", "--run-dir", (folder / name).string()};
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  return run(folder, "rex_drive", words);
}

/// @return lines of the run's messages.log that have the text
int lines_with(const std::filesystem::path& run_folder, const std::string& text) {
  std::ifstream log(run_folder / "messages.log");
  int count = 0;
  for (std::string line; std::getline(log, line);) count += line.find(text) != std::string::npos ? 1 : 0;
  return count;
}

class RexDriveBroken : public ::testing::TestWithParam<Broken> {};

TEST_P(RexDriveBroken, IsToldByItsNameAndSurvivedOrStopped) {
  const auto& [name, settings, told, wheel, line, plan] = GetParam();
  const Folder folder(false);
  const Ended ended = drive(folder, "broken", settings, plan);
  const nlohmann::json end = summary(folder / "broken");
  if (*told == '\0') {
    EXPECT_EQ(ended.status, 0) << ended.all();
    EXPECT_LE(figure(end, "track_max_mm"), 60);
    EXPECT_EQ(lines_with(folder / "broken", "the load cells"), *line == '\0' ? 0 : 1) << ended.all();
    EXPECT_GE(lines_with(folder / "broken", line), 1);
    EXPECT_EQ(drive(folder, "whole", {}).status, 0);
    EXPECT_NE(end.at("log_hash"), summary(folder / "whole").at("log_hash")) << "something was broken";
    return;
  }
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with(std::string("error: ") + told + ": ")) << ended.all();
  EXPECT_NE(ended.last_err().find(wheel), std::string::npos) << ended.all();
  // The drives brake; but what the platform has run into presses it back for a while. It stands there from some 3 s on.
  const bool held = name == std::string("AnObstacleThatNobodyKnows");
  EXPECT_LE(figure(end, "stop_steps_max"), held ? 600 : 300);
  EXPECT_LE(end.at("sim_s"), held ? 6 : 60) << "it must not push for long";
}

INSTANTIATE_TEST_SUITE_P(
    By, RexDriveBroken,
    ::testing::Values(
        Broken{"ABlockedWheel", of_the_simulation("wheel_blocked"), "wheel_blocked", "axis 1"},
        Broken{"AnEncoderThatStands", of_the_simulation("encoder_stuck"), "encoder_fault", "axis 1"},
        Broken{"AnImuThatIsSilent", of_the_simulation("imu_silent"), "sensor_silent"},
        Broken{"AnEstimateThatDiverges",
               {"sim.platforms.rex.imu.bias=0.1"},
               "estimate_lost",
               "",
               "",
               "figure_eight"},
        Broken{"AnObstacleThatNobodyKnows",
               {"sim.boxes.wall.start=[1.3, 0, 0]", "sim.boxes.wall.mass=2000", "sim.boxes.wall.friction=1"},
               "estimate_lost"},
        Broken{"AnImuWithoutNumbers", of_the_simulation("imu_nan"), "sensor_silent"},
        Broken{"LoadCellsThatRepeatThemselves", of_the_simulation("load_stuck"), ""},
        Broken{"ALoadCellThatIsWrong", of_the_simulation("load_wrong"), "", "", "the load cells tell"},
        Broken{"LoadCellsThatAreSilent", of_the_simulation("load_silent"), "", "",
               "the load cells are silent"},
        Broken{"ASolverThatFailsFourTimes", {"platforms.rex.solver_fails=[1500, 1540]"}, ""},
        Broken{"ASolverThatGoesOnFailing", {"platforms.rex.solver_fails=[1500, 100000]"}, "solver_failed"},
        Broken{"AMapThatIsLostForLong", {"motion_capture.lost=[3, 100]"}, ""}),
    [](const auto& broken) { return std::string(broken.param.name); });

}  // namespace
}  // namespace mrroc::test
