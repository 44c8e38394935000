#include "test/base/layers.hpp"

#include <gtest/gtest.h>

#include <set>

namespace mrroc::test {
namespace {

const std::filesystem::path kRoot = MRROC_SOURCE_DIR;

struct Line {
  const char* path;
  const char* include;
};

TEST(Layers, RefuseWhatStandsAbove) {
  for (const auto& [path, include] : {Line{"base/pose.hpp", "base/link/channel.hpp"},
                                      {"base/pose.hpp", "base/msg/x.hpp"},
                                      {"base/pose.hpp", "mrroc/header_t.hpp"},
                                      {"base/msg/x.hpp", "base/link/channel.hpp"},
                                      {"base/link/channel.hpp", "edp/shell.hpp"},
                                      {"edp/shell.cpp", "robots/irb6/kinematics.hpp"},
                                      {"ecp/shell.cpp", "tasks/drawing/tables.hpp"},
                                      {"vsp/pen_state/automaton.cpp", "tasks/drawing/images.hpp"},
                                      {"robots/irb6/kinematics.cpp", "sim/world.hpp"},
                                      {"tasks/drawing/tables.hpp", "sim/paper.hpp"},
                                      {"tasks/drawing/main.cpp", "test/base/layers.hpp"},
                                      {"sim/world.cpp", "bench/report.hpp"}})
    EXPECT_NE(layer_violation(path, include), "") << path << ' ' << include;
}

TEST(Layers, RefuseWhatStandsBeside) {
  for (const char* one : {"edp", "ecp", "mp", "vsp", "ui_cli"})
    for (const char* other : {"edp", "ecp", "mp", "vsp", "ui_cli"})
      EXPECT_EQ(layer_violation(std::string(one) + "/shell.cpp", std::string(other) + "/shell.hpp").empty(),
                std::string(one) == other)
          << one << ' ' << other;
  EXPECT_NE(layer_violation("robots/irb6/model.cpp", "tasks/drawing/tables.hpp"), "");
  EXPECT_NE(layer_violation("tasks/drawing/tables.hpp", "robots/irb6/model.hpp"), "");
}

TEST(Layers, KeepTasksFromHardwareAndRobotsFromTasks) {
  EXPECT_EQ(layer_violation("tasks/drawing/agent.cpp", "edp/law.hpp"),
            "tasks/drawing/agent.cpp includes edp/law.hpp: tasks must not know edp");
  EXPECT_NE(layer_violation("robots/irb6/model.cpp", "ecp/shell.hpp"), "");
  EXPECT_NE(layer_violation("robots/irb6/model.cpp", "mp/shell.hpp"), "");
}

TEST(Layers, AllowWhatStandsBelow) {
  for (const auto& [path, include] : {Line{"base/config.cpp", "base/config.hpp"},
                                      {"base/link/channel.hpp", "base/msg/x.hpp"},
                                      {"base/link/channel.hpp", "mrroc/header_t.hpp"},
                                      {"edp/shell.cpp", "base/link/channel.hpp"},
                                      {"vsp/pen_state/automaton.cpp", "vsp/shell.hpp"},
                                      {"robots/irb6/model.cpp", "edp/robot.hpp"},
                                      {"tasks/drawing/tables.hpp", "mp/shell.hpp"},
                                      {"tasks/drawing/tables.hpp", "vsp/pen_state/automaton.hpp"},
                                      {"sim/world.cpp", "robots/irb6/model.hpp"},
                                      {"sim/world.cpp", "vector"},
                                      {"test/system/drawing_test.cpp", "tasks/drawing/tables.hpp"},
                                      {"bench/edp.cpp", "edp/law.hpp"}})
    EXPECT_EQ(layer_violation(path, include, std::string(include) != "vector"), "") << path << ' ' << include;
}

TEST(Layers, LetOnlyMainsJoinWhatTheyKeepApart) {
  EXPECT_EQ(layer_violation("robots/irb6/main.cpp", "sim/world.hpp"), "");
  EXPECT_EQ(layer_violation("tasks/drawing/main_arm.cpp", "robots/irb6/model.hpp"), "");
  EXPECT_EQ(layer_violation("edp/main.cpp", "ecp/shell.hpp"), "");
  EXPECT_NE(layer_violation("tasks/drawing/main_arm.hpp", "robots/irb6/model.hpp"), "");
  EXPECT_NE(layer_violation("tasks/drawing/domain.cpp", "robots/irb6/model.hpp"), "");
}

TEST(Layers, KeepEachLibraryInItsFolder) {
  EXPECT_EQ(layer_violation("base/link/lcm_link.cpp", "lcm/lcm-cpp.hpp", false), "");
  EXPECT_EQ(layer_violation("test/base/link/lcm_test.cpp", "lcm/lcm-cpp.hpp", false), "");
  EXPECT_EQ(layer_violation("sim/bullet/arm.cpp", "btBulletDynamicsCommon.h", false), "");
  EXPECT_EQ(layer_violation("test/vsp/camera.cpp", "opencv2/core.hpp", false), "");
  EXPECT_EQ(layer_violation("bench/vision.cpp", "opencv2/core.hpp", false), "");
  EXPECT_EQ(layer_violation("vsp/cube_face/colours.cpp", "opencv2/imgproc.hpp", false), "");
  EXPECT_EQ(layer_violation("sim/camera/gl.cpp", "EGL/egl.h", false), "");
  EXPECT_EQ(layer_violation("base/command_line.cpp", "CLI/App.hpp", false), "");
  for (const auto& [path, include] : {Line{"edp/shell.cpp", "lcm/lcm-cpp.hpp"},
                                      {"base/pose.cpp", "lcm/lcm.h"},
                                      {"tasks/drawing/main.cpp", "lcm/lcm-cpp.hpp"},
                                      {"edp/shell.cpp", "btBulletDynamicsCommon.h"},
                                      {"sim/camera/lens.cpp", "opencv2/core.hpp"},
                                      {"tasks/rubik/main.cpp", "apriltag/apriltag.h"},
                                      {"robots/irb6/model.cpp", "bullet/btBulletCollisionCommon.h"},
                                      {"tasks/drawing/main.cpp", "LinearMath/btVector3.h"},
                                      {"vsp/shell.cpp", "EGL/egl.h"},
                                      {"base/command_line.hpp", "CLI/App.hpp"},
                                      {"bench/main.cpp", "CLI/App.hpp"},
                                      {"mp/options.cpp", "CLI/App.hpp"},
                                      {"sim/world.cpp", "GL/glcorearb.h"},
                                      {"vsp/cube_face/colours.cpp", "opencv2/opencv.hpp"},
                                      {"sim/camera.cpp", "opencv2/opencv.hpp"}})
    EXPECT_NE(layer_violation(path, include, false), "") << path << ' ' << include;
}

TEST(Layers, WantPathsFromTheRoot) {
  EXPECT_NE(layer_violation("edp/shell.cpp", "shell.hpp"), "");
  EXPECT_NE(layer_violation("edp/shell.cpp", "../base/pose.hpp"), "");
  EXPECT_NE(layer_violation("tools/helper.cpp", "base/pose.hpp"), "");
}

TEST(Layers, AreReadFromIncludeLinesOnly) {
  bool quoted{};
  EXPECT_EQ(included_by("#include \"a/b.hpp\"", quoted), "a/b.hpp");
  EXPECT_TRUE(quoted);
  EXPECT_EQ(included_by("  #  include <vector>  // why", quoted), "vector");
  EXPECT_FALSE(quoted);
  EXPECT_EQ(included_by("// #include <vector>", quoted), "");
  EXPECT_EQ(included_by("#define include <vector>", quoted), "");
}

TEST(Tree, KeepsItsLevels) {
  std::size_t lines = 0;
  for (const auto& path : project_files(kRoot)) {
    if (std::set<std::string>{".hpp", ".cpp", ".h", ".in"}.count(path.extension().string()) == 0) continue;
    if (path.string().starts_with("test/install/example/")) continue;  // a project of its own
    for (const std::string& line : lines_of(kRoot / path)) {
      bool quoted{};
      const std::string include = included_by(line, quoted);
      if (include.empty()) continue;
      ++lines;
      EXPECT_EQ(layer_violation(path.string(), include, quoted), "");
    }
  }
  EXPECT_GT(lines, 30U) << "the tree was not found";
}

TEST(Tree, HasNoLongSourceFiles) {
  const std::set<std::string> kinds{"", ".hpp", ".cpp", ".h", ".in", ".lcm", ".cmake", ".txt"};
  for (const auto& path : project_files(kRoot)) {
    if (kinds.count(path.extension().string()) == 0) continue;
    EXPECT_LE(lines_of(kRoot / path).size(), 400U) << path;
  }
}

TEST(Tree, HasNoUnfinishedWorkAndNoPathsOfOneMachine) {
  // Put together here, so that this file does not contain them.
  std::vector<std::string> words;
  for (const auto& [first, rest] :
       {std::pair{"TO", "DO"}, {"FIX", "ME"}, {"HA", "CK"}, {"/wo", "rk/"}, {"/ho", "me/"}})
    words.push_back(std::string(first) + rest);
  for (const auto& path : project_files(kRoot))
    for (const std::string& line : lines_of(kRoot / path))
      for (const std::string& word : words)
        EXPECT_EQ(line.find(word), std::string::npos) << path << ": " << line;
}

}  // namespace
}  // namespace mrroc::test
