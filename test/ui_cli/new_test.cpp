#include "ui_cli/new/new_command.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/fault.hpp"
#include "base/file_content.hpp"
#include "test/docs/json_table.hpp"
#include "ui_cli/new/template_files.hpp"
#include "ui_cli/new/tree.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

/// A clone in which nothing is yet.
class NewPartTest : public testing::Test {
 protected:
  NewPartTest() {
    static int number = 0;
    root_ = fs::path(testing::TempDir()) /
            ("mrroc-new-" + std::to_string(testing::UnitTest::GetInstance()->random_seed()) + "-" +
             std::to_string(getpid()) + "-" + std::to_string(++number));
    for (const char* folder : {"robots", "tasks", "vsp", "test/robots", "test/tasks", "test/vsp"}) {
      fs::create_directories(root_ / folder);
      std::ofstream(root_ / folder / "CMakeLists.txt") << "add_subdirectory(first)\n# end\n";
    }
    std::ofstream(root_ / "run") << "#!/bin/sh\n";
  }
  ~NewPartTest() override { fs::remove_all(root_); }

  std::string run(std::vector<std::string> words) {
    words.insert(words.end(), {"--into", root_.string()});
    std::ostringstream out, err;
    EXPECT_EQ(run_new(words, out, err), 0);
    return out.str();
  }
  /// @return the error line of a command that is refused
  std::string refused(std::vector<std::string> words) {
    const auto before = files();
    words.insert(words.end(), {"--into", root_.string()});
    std::ostringstream out, err;
    std::string line = "not refused";
    try {
      if (run_new(words, out, err) != 0) line = err.str();
    } catch (const FaultError& e) {
      line = e.error_line();
    }
    EXPECT_EQ(files(), before) << "something was written";
    return line;
  }
  /// @return every file and its text
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(root_))
      all[entry.path().lexically_relative(root_)] =
          entry.is_regular_file() ? file_content(entry.path()) : "folder";
    return all;
  }

  fs::path root_;
};

bool names_fault(const std::string& line, const std::string& code) {
  return line.starts_with("error: " + code + ":");
}

TEST(NewName, IsALowerCaseIdentifierThatMeansNothingYet) {
  for (const char* good : {"arm", "probe_arm", "arm7", "x1_y2"})
    EXPECT_NO_THROW(check_new_name(good)) << good;
  for (const char* bad : {"", "Probe", "7arm", "_arm", "arm_", "probe__arm", "probe-arm", "probe arm",
                          "../arm", "arm/left", "arm.left", "class", "int", "build", "robots", "sim",
                          "irb6_track", "abcdefghijabcdefghijabcdefghijabcdefghija", "\xc5\x82\x61pa"})
    EXPECT_THROW(check_new_name(bad), FaultError) << bad;
}

TEST(NewName, MakesATypesName) {
  EXPECT_EQ(type_name("probe_arm"), "ProbeArm");
  EXPECT_EQ(type_name("arm_2b"), "Arm2b");
}

TEST(NewEntry, StandsBehindTheLastFolder) {
  EXPECT_EQ(with_entry("", "a"), "add_subdirectory(a)\n");
  EXPECT_EQ(with_entry("library(x)", "a"), "library(x)\nadd_subdirectory(a)\n");
  EXPECT_EQ(with_entry("add_subdirectory(b)", "a"), "add_subdirectory(b)\nadd_subdirectory(a)\n");
  EXPECT_EQ(with_entry("x()\nadd_subdirectory(b)\nadd_subdirectory(c)\ny()\n", "a"),
            "x()\nadd_subdirectory(b)\nadd_subdirectory(c)\nadd_subdirectory(a)\ny()\n");
}

TEST(NewPlan, LeavesNothingOfTheTemplatesNames) {
  EXPECT_GT(template_files().size(), 25U);
  for (const Scaffold& scaffold :
       {Scaffold{.part = NewPart::robot, .name = "probe"},
        Scaffold{.part = NewPart::robot, .name = "probe", .hardware = true},
        Scaffold{.part = NewPart::platform, .name = "probe"},
        Scaffold{.part = NewPart::sensor, .name = "probe"}, Scaffold{.part = NewPart::task, .name = "probe"},
        Scaffold{.part = NewPart::task, .name = "probe", .sensor = "feeler"},
        Scaffold{.part = NewPart::task, .name = "probe", .coordinated = true},
        Scaffold{.part = NewPart::task, .name = "probe", .outside = true}}) {
    const ScaffoldPlan plan = plan_scaffold(scaffold);
    EXPECT_GE(plan.files.size(), 6U);
    for (const NewFile& file : plan.files) {
      const std::string all = file.path.string() + "\n" + file.text;
      for (const char* left :
           {"my_task", "MyTask", "my_robot", "MyRobot", "my_platform", "MyPlatform", "my_sensor", "MySensor",
            "@sensor", "@no_sensor", "@hardware", "@no_hardware", ".template"})
        EXPECT_EQ(all.find(left), std::string::npos) << file.path << " still has " << left;
      EXPECT_NE(all.find("probe"), std::string::npos) << file.path;
      EXPECT_FALSE(file.text.empty()) << file.path;
    }
  }
}

TEST(NewPlan, APartMayHaveTheNameThatTheTemplatesHave) {
  EXPECT_NO_THROW(check_new_name("my_task"));
  const Scaffold scaffold{.part = NewPart::task, .name = "my_task", .sensor = "my_sensor"};
  const ScaffoldPlan plan = plan_scaffold(scaffold);
  const auto main =
      std::ranges::find(plan.files, std::filesystem::path("tasks/my_task/main.cpp"), &NewFile::path);
  ASSERT_NE(main, plan.files.end());
  EXPECT_NE(main->text.find("my_task"), std::string::npos);
  EXPECT_NE(main->text.find("my_sensor"), std::string::npos);
}

TEST(NewPlan, ATaskWithASensorReadsItAndOneWithoutDoesNot) {
  const auto all = [](const std::string& sensor) {
    std::string text;
    for (const NewFile& f : plan_scaffold({.part = NewPart::task, .name = "probe", .sensor = sensor}).files)
      text += f.text;
    return text;
  };
  EXPECT_NE(all("feeler").find("vsp::run_feeler"), std::string::npos);
  EXPECT_NE(all("feeler").find("vsp_feeler"), std::string::npos);
  EXPECT_EQ(all("").find("vsp"), std::string::npos);
}

TEST(NewPlan, ARobotWithHardwareHasASeamATestAndAnEntryAndOneWithoutHasNone) {
  const auto all = [](bool hardware) {
    std::string text;
    for (const NewFile& f :
         plan_scaffold({.part = NewPart::robot, .name = "probe", .hardware = hardware}).files)
      text += f.path.string() + "\n" + f.text;
    return text;
  };
  for (const char* part : {"robots/probe/hardware.cpp", "test/robots/probe/hardware_test.cpp",
                           "mrroc_robot(probe hardware.cpp kinematics.cpp robot.cpp)",
                           "t.hardware = {{\"probe\", open_hardware}};", "test_robot_probe_hardware"}) {
    EXPECT_NE(all(true).find(part), std::string::npos) << part;
    EXPECT_EQ(all(false).find(part), std::string::npos) << part;
  }
  EXPECT_NE(all(false).find("mrroc_robot(probe kinematics.cpp robot.cpp)"), std::string::npos);
}

TEST(NewPlan, HardwareIsTriedByARunOfTheRobotsTask) {
  const auto next = plan_scaffold({.part = NewPart::robot, .name = "probe", .hardware = true}).next;
  EXPECT_EQ(next.back().find("./run probe --clock wall --set robots.arm1.hardware=probe "), 0U)
      << next.back();
}

TEST(NewPlan, ATaskWithACoordinatorOfItsOwnIsSixFilesInItsFolder) {
  const ScaffoldPlan plan = plan_scaffold({.part = NewPart::task, .name = "probe", .coordinated = true});
  EXPECT_EQ(plan.files.size(), 6U);
  for (const NewFile& file : plan.files) EXPECT_EQ(file.path.parent_path(), "tasks/probe");
  EXPECT_TRUE(plan.entries.empty()) << "nothing that is there is changed";
}

TEST_F(NewPartTest, WritesFilesAndEntersThem) {
  for (const char* part : {"robot", "platform", "task", "sensor"}) {
    const std::string name = std::string("probe_") + part;
    const std::string said = run({part, name});
    const auto now = files();
    const std::map<std::string, std::string> folders{
        {"robot", "robots"}, {"platform", "robots"}, {"task", "tasks"}, {"sensor", "vsp"}};
    const std::string& folder = folders.at(part);
    EXPECT_TRUE(now.contains(folder + "/" + name + "/CMakeLists.txt"));
    EXPECT_TRUE(now.contains("test/" + folder + "/" + name + "/contract_test.cpp"));
    for (const std::string& list : {folder + "/CMakeLists.txt", "test/" + folder + "/CMakeLists.txt"})
      EXPECT_EQ(now.at(list).find("add_subdirectory(" + name + ")\n") != std::string::npos, folder != "tasks")
          << list << ": lists of tasks find them by themselves";
    EXPECT_NE(said.find("./run "), std::string::npos) << "the next step is told";
  }
}

TEST_F(NewPartTest, ARobotComesWithATaskThatMovesIt) {
  run({"robot", "probe"});
  EXPECT_NE(file_content(root_ / "tasks/probe/probe.toml").find("model = \"probe\""), std::string::npos);
  EXPECT_NE(file_content(root_ / "robots/probe/CMakeLists.txt").find("mrroc_robot(probe"), std::string::npos);
  // A task is built with the drivers of all robots that are registered; it names none.
  EXPECT_TRUE(file_content(root_ / "tasks/probe/CMakeLists.txt").starts_with("mrroc_arm_task(probe "));
  EXPECT_EQ(file_content(root_ / "tasks/probe/CMakeLists.txt").find("PARTS"), std::string::npos);
}

TEST_F(NewPartTest, ADryRunListsWhatWouldBeWrittenAndWritesNothing) {
  const auto before = files();
  const auto j = nlohmann::json::parse(run({"task", "probe", "--dry-run", "--json"}));
  EXPECT_EQ(files(), before);
  EXPECT_EQ(j.at("written"), false);
  const auto k = nlohmann::json::parse(run({"task", "probe", "--json"}));
  EXPECT_EQ(k.at("written"), true);
  EXPECT_TRUE(test::documented("new", k));
  EXPECT_EQ(k.at("files"), j.at("files"));
  for (const std::string file : k.at("files")) EXPECT_TRUE(fs::exists(root_ / file)) << file;
  EXPECT_TRUE(k.at("changed").empty());
  EXPECT_EQ(nlohmann::json::parse(run({"sensor", "feeler", "--json"})).at("changed").size(), 2U);
}

TEST_F(NewPartTest, RefusesWhatIsWrongAndWritesNothing) {
  EXPECT_TRUE(names_fault(refused({"task", "Probe"}), "bad_usage"));
  EXPECT_TRUE(names_fault(refused({"tusk", "probe"}), "bad_usage"));
  EXPECT_NE(refused({"tusk", "probe"}).find("did you mean 'task'?"), std::string::npos);
  EXPECT_NE(refused({"task"}).find("NAME (its name) is missing; type for example `ui_cli new task spiral`"),
            std::string::npos);
  EXPECT_NE(refused({}).find("PART (robot, platform, task or sensor) and NAME (its name) are missing"),
            std::string::npos);
  EXPECT_TRUE(names_fault(refused({"task", "probe", "more"}), "bad_usage"));
  EXPECT_TRUE(names_fault(refused({"task", "probe", "--sensor", "feeler"}), "bad_usage"))
      << "there is no such sensor";
  EXPECT_TRUE(names_fault(refused({"task", "probe", "--robot", "gantry"}), "bad_usage"))
      << "there is no such robot";
  EXPECT_TRUE(names_fault(refused({"sensor", "probe", "--robot", "irb6_track"}), "bad_usage"));
  EXPECT_TRUE(names_fault(refused({"task", "probe", "--hardware"}), "bad_usage"));
  EXPECT_TRUE(names_fault(refused({"sensor", "probe", "--coordinated"}), "bad_usage"));
  EXPECT_TRUE(names_fault(refused({"task", "probe", "--coordinated", "--robot", "irb6_track"}), "bad_usage"));
  run({"task", "probe"});
  EXPECT_TRUE(names_fault(refused({"task", "probe"}), "bad_usage"));
  EXPECT_TRUE(names_fault(refused({"robot", "probe"}), "bad_usage")) << "its task would have the same name";
}

TEST_F(NewPartTest, RefusesNamesOfTargetsAndFunctions) {
  fs::create_directories(root_ / "base");
  std::ofstream(root_ / "base/motion.hpp") << "Outcome move(const Motion<A>& motion);\n";
  std::ofstream(root_ / "tasks/CMakeLists.txt")
      << "mrroc_library(mrroc_cloth x.cpp)\nmrroc_program(iron main.cpp)\n";
  for (const char* name : {"move", "cloth", "iron"})
    EXPECT_NE(refused({"task", name}).find("has a meaning already"), std::string::npos) << name;
  run({"task", "clot"});
}

TEST_F(NewPartTest, TakesBackWhatItHasWrittenWhenTheRestCannotBe) {
  std::ofstream(root_ / "test/tasks/probe") << "a file where a folder must be\n";
  EXPECT_TRUE(names_fault(refused({"task", "probe"}), "cannot_write"));
}

TEST_F(NewPartTest, OutsideOfAnyCloneItSaysWhatToDo) {
  std::ostringstream out, err;
  try {
    run_new({"task", "probe", "--into", (root_ / "tasks").string()}, out, err);
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_NE(e.error_line().find("no clone of the framework"), std::string::npos);
  }
}

TEST_F(NewPartTest, AProjectOutsideNeedsNoClone) {
  std::ostringstream out, err;
  const fs::path place = root_ / "outside";
  EXPECT_EQ(run_new({"task", "probe", "--outside", place.string()}, out, err), 0);
  EXPECT_NE(file_content(place / "CMakeLists.txt").find("find_package(mrroc REQUIRED)"), std::string::npos);
  EXPECT_TRUE(fs::exists(place / "tasks/probe/main.cpp"));
  EXPECT_FALSE(fs::exists(place / "test"));
}

TEST(NewHelp, TellsEveryWord) {
  std::ostringstream out, err;
  EXPECT_EQ(run_new({"--help"}, out, err), 0);
  for (const std::string& word : new_words()) EXPECT_NE(out.str().find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace mrroc::ui
