// Precedence of a task's configurations: its own, what it finds out, a file, that of an earlier run,
// settings. With the cube's task, which finds out most.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/fault.hpp"
#include "launch/cell_nodes.hpp"
#include "launch/task_config.hpp"
#include "tasks/rubik/cell/cell_settings.hpp"
#include "tasks/rubik/cell/planning_context.hpp"
#include "tasks/rubik/config.hpp"

namespace mrroc::launch {
namespace {

namespace fs = std::filesystem;

const std::vector<CellArm> kArms{{rubik::kArmKeys[0], "irb6_postument"}, {rubik::kArmKeys[1], "irb6_track"}};

/// What everybody who takes part reads; nothing is left that is not known.
rubik::Parameters read_all(const Config& config) {
  check_cell(config, kArms);
  return rubik::read_setup(config).k;
}

class TaskConfig : public testing::Test {
 protected:
  TaskConfig() : folder_(fs::temp_directory_path() / ("mrroc_task_config_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~TaskConfig() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static Config load(mp::TaskOptions& options) {
    return load_task_config(options, rubik::config(), "rubik", rubik::cell_settings(false));
  }
  /// What a run with these options leaves. @return its text
  [[nodiscard]] std::string run(mp::TaskOptions options, const std::string& name) const {
    Config config = load(options);
    read_all(config);
    complete_config(config, options, folder_ / name, "");
    return config.dump();
  }

  fs::path folder_;
};

TEST_F(TaskConfig, AFileWithAPartOfTheKeysLeavesAllOthersAsTheTaskHasThem) {
  mp::TaskOptions options;
  options.config_file = write("part.toml", "seed = 5\n[task]\ntorque = 3.5\n[robots.arm2]\njaws = 0.057\n");
  const Config config = load(options);
  EXPECT_EQ(seed_of(config), 5U);
  mp::TaskOptions plain;
  const rubik::Parameters k = read_all(config), own = read_all(load(plain));
  EXPECT_EQ(k.torque, 3.5);
  EXPECT_NE(own.torque, 3.5);
  EXPECT_EQ(k.mobility, own.mobility);
  EXPECT_EQ(k.grip_step, own.grip_step);
  const Config task = Config::parse(std::string(rubik::config()), "rubik.toml");
  const auto force = [](const Config& c) { return c.list("robots.arm2.limits.contact_force", std::nullopt); };
  EXPECT_EQ(force(config.copy()), force(task)) << "beside a key of the same table";
  EXPECT_TRUE(config.has("robots.arm2.start_joints")) << "what the task finds out";
}

TEST_F(TaskConfig, HardwareThatARobotLacksIsRefusedWithTheKindsThereAre) {
  mp::TaskOptions options;
  options.settings = {"robots.arm1.hardware=drives"};
  const Config config = load(options);
  try {
    check_cell(config, kArms);
    FAIL() << "there are no such drives";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    for (const char* part : {"robots.arm1.hardware", "'drives'", "simulated, loopback"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << part << " in " << e.what();
  }
  options.settings = {"robots.arm1.hardware=loopback"};
  EXPECT_NO_THROW(check_cell(load(options), kArms));
}

TEST_F(TaskConfig, GearsThatTheIntegrationDoesNotFollowAreRefusedBeforeAnythingStarts) {
  mp::TaskOptions options;
  options.settings = {"sim.robots.arm1.elasticity=15", "sim.robots.arm1.elasticity_damping=0.5",
                      "sim.substeps=2"};
  try {
    check_cell(load(options), kArms);
    FAIL() << "the arm would explode";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
    EXPECT_NE(e.remedy().find("raise sim.substeps"), std::string_view::npos) << e.remedy();
  }
  options.settings.pop_back();  // by default finer
  EXPECT_NO_THROW(check_cell(load(options), kArms));
}

TEST_F(TaskConfig, AFileCountsMoreThanWhatTheTaskFindsOutAndSettingsMoreThanAFile) {
  mp::TaskOptions options;
  options.config_file = write("start.toml",
                              "[task]\ntorque = 3.5\nattempts = 2\n"
                              "[robots.arm1]\nmotion.velocity = [1, 2, 3, 4, 5, 6]\n");
  options.settings = {"task.torque=3"};
  const Config config = load(options);
  EXPECT_EQ(rubik::read_motion_limits(config, "arm1", 6).velocity[5], 6);
  const rubik::Parameters k = rubik::read_parameters(config);
  EXPECT_EQ(k.torque, 3);
  EXPECT_EQ(k.attempts, 2);
}

TEST_F(TaskConfig, TheConfigurationOfARunStandsAloneAndSaysTheSameAgain) {
  mp::TaskOptions first;
  first.settings = {"task.torque=3", "cube.scramble=\"R U' F2\"", "sim.substeps=2"};
  first.seed = 7;
  first.seed_asked = true;
  const std::string left = run(first, "run");

  mp::TaskOptions again;
  again.config_file = write("config.toml", left);
  Config config = load_task_config(again, "[task]\ntorque = 1\n", "rubik", {"task.mobility=0.01"});
  EXPECT_EQ(seed_of(config), 7U);
  const rubik::Parameters k = read_all(config);
  EXPECT_EQ(k.torque, 3);
  EXPECT_EQ(k.mobility, 0.1) << "not what the task says or finds out by now";
  EXPECT_EQ(config.text("cube.scramble", std::nullopt), "R U' F2");
  complete_config(config, again, folder_ / "run", "");
  EXPECT_EQ(config.dump(), left);
}

TEST_F(TaskConfig, ARunThatIsRepeatedHasAFolderOfItsOwnAndObeysSettingsAndSeed) {
  const std::string left = run({}, "run");
  mp::TaskOptions again;
  again.config_file = write("config.toml", left);
  again.settings = {"task.torque=3"};
  again.seed = 9;
  again.seed_asked = true;
  Config config = load(again);
  EXPECT_EQ(seed_of(config), 9U);
  EXPECT_EQ(read_all(config).torque, 3);
  complete_config(config, again, folder_ / "other", "", true);
  for (const char* key : {"run.folder", "film.directory"})
    EXPECT_EQ(config.text(key, std::nullopt), (folder_ / "other").string()) << key;
}

TEST_F(TaskConfig, KeysThatOnlyOptionsOrTheTaskGiveAreRefusedAsSettingsWithWhatToDo) {
  for (const auto& [key, instead] : {std::pair{"sim.speed", "give --speed"},
                                     {"run.folder", "give --run-dir"},
                                     {"run.strokes", "leave it out"}}) {
    mp::TaskOptions options;
    options.settings = {"task.torque=3", fmt::format("{}=2", key)};
    try {
      load(options);
      ADD_FAILURE() << key;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_usage) << key;
      const std::string line = e.error_line();
      EXPECT_NE(line.find(std::string(key) + " cannot be set"), std::string::npos) << line;
      EXPECT_NE(line.find(instead), std::string::npos) << line;
    }
  }
}

}  // namespace
}  // namespace mrroc::launch
