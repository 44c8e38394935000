#include "test/base/layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <regex>
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
                                      {"tasks/drawing/tables.hpp", "tasks/drawing/cell/paper.hpp"},
                                      {"sim/world.hpp", "tasks/drawing/cell/paper.hpp"},
                                      {"tasks/drawing/cell/paper.hpp", "launch/arm_task.hpp"},
                                      {"tasks/drawing/main.cpp", "test/base/layers.hpp"},
                                      {"sim/world.cpp", "launch/arm_task.hpp"},
                                      {"tasks/drawing/results.cpp", "launch/arm_task.hpp"},
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

TEST(Layers, LetATasksCellKnowItsTaskRobotsAndSimButNoOtherCell) {
  for (const char* include :
       {"tasks/rubik/plan/cell.hpp", "robots/irb6/arm.hpp", "sim/world.hpp", "edp/robot.hpp"})
    EXPECT_EQ(layer_violation("tasks/rubik/cell/plan_cell.cpp", include), "") << include;
  EXPECT_NE(layer_violation("tasks/rubik/cell/plan_cell.cpp", "tasks/manual/cell/arm_reach.hpp"), "");
  EXPECT_NE(layer_violation("tasks/rubik/cellar/plan_cell.cpp", "robots/irb6/arm.hpp"), "");
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
                                      {"launch/arm_task.cpp", "sim/world.hpp"},
                                      {"sim/world.cpp", "vector"},
                                      {"test/system/drawing_test.cpp", "tasks/drawing/tables.hpp"},
                                      {"bench/edp.cpp", "edp/law.hpp"}})
    EXPECT_EQ(layer_violation(path, include, std::string(include) != "vector"), "") << path << ' ' << include;
}

TEST(Layers, LetOnlyMainsJoinWhatTheyKeepApart) {
  EXPECT_EQ(layer_violation("robots/irb6/main.cpp", "sim/world.hpp"), "");
  EXPECT_EQ(layer_violation("tasks/drawing/main_arm.cpp", "robots/irb6/model.hpp"), "");
  EXPECT_EQ(layer_violation("edp/main.cpp", "ecp/shell.hpp"), "");
  EXPECT_NE(layer_violation("tasks/drawing/main.cpp", "sim/config.hpp"), "") << "no task sees the plant";
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
                                      {"sim/world.cpp", "mujoco/mujoco.h"},
                                      {"launch/arm_task.cpp", "mujoco/mujoco.h"},
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

TEST(Layers, KeepTheSimulatorFromTasksAndTheirFramework) {
  for (const char* include : {"tasks/rubik/plan/cell.hpp", "mp/supervisor.hpp", "ecp/shell.hpp",
                              "vsp/shell.hpp", "launch/cell_nodes.hpp", "tasks/rubik/cell/layout.hpp"})
    EXPECT_NE(layer_violation("sim/world.hpp", include), "") << include;
  for (const char* include :
       {"robots/catalogue.hpp", "edp/robot.hpp", "base/cube/cube.hpp", "base/link/process.hpp"})
    EXPECT_EQ(layer_violation("sim/world.hpp", include), "") << include;
}

TEST(Layers, KeepLaunchFromTheTasksThatItRuns) {
  for (const char* include : {"tasks/drawing/tables.hpp", "tasks/rubik/cell/layout.hpp"})
    EXPECT_NE(layer_violation("launch/run_task.cpp", include), "") << include;
  for (const char* include :
       {"mp/options.hpp", "ecp/solo.hpp", "vsp/shell.hpp", "sim/config.hpp", "robots/catalogue.hpp"})
    EXPECT_EQ(layer_violation("launch/run_task.cpp", include), "") << include;
}

TEST(Layers, CirclesAreFoundAlsoOnDetours) {
  Arrows arrows;
  add_arrow(arrows, "sim/world.cpp", "sim/bullet/scene.hpp");
  add_arrow(arrows, "sim/bullet/scene.cpp", "base/pose.hpp");
  add_arrow(arrows, "sim/world.cpp", "sim/cube.hpp");
  EXPECT_EQ(on_circles(arrows), std::vector<std::string>());
  add_arrow(arrows, "sim/main_simulator.cpp", "launch/task.hpp");
  add_arrow(arrows, "launch/task.cpp", "sim/world.hpp");
  EXPECT_EQ(on_circles(arrows), std::vector<std::string>()) << "a main may join them";
  add_arrow(arrows, "sim/bullet/scene.cpp", "sim/camera/scene.hpp");
  add_arrow(arrows, "sim/camera/scene.hpp", "sim/world.hpp");
  EXPECT_EQ(on_circles(arrows), (std::vector<std::string>{"sim", "sim/bullet", "sim/camera"}));
}

TEST(Tree, HasNoCirclesBetweenFolders) {
  Arrows arrows;
  for (const auto& path : project_files(kRoot)) {
    if (path.extension() != ".hpp" && path.extension() != ".cpp") continue;
    if (path.string().starts_with("test/") || path.string().starts_with("bench/")) continue;
    for (const std::string& line : lines_of(kRoot / path)) {
      bool quoted{};
      const std::string include = included_by(line, quoted);
      if (quoted) add_arrow(arrows, path.string(), include);
    }
  }
  EXPECT_GT(arrows.size(), 20U) << "the folders were not found";
  EXPECT_EQ(on_circles(arrows), std::vector<std::string>());
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

/// @return the lengths of the functions that begin at the left margin, by their first lines
std::map<std::string, std::size_t> lengths_of_functions(const std::vector<std::string>& lines) {
  static const std::regex first_line(
      "^(?!namespace|struct|class|enum|union|using|template|const|inline "
      "const|static_assert|extern|typedef)[A-Za-z].*");
  std::map<std::string, std::size_t> lengths;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (!std::regex_match(lines[k], first_line)) continue;
    std::size_t open = k;
    while (open < lines.size() && lines[open].find_first_of("{;") == std::string::npos) ++open;
    if (open == lines.size() || !lines[open].ends_with("{")) continue;
    std::size_t end = open;
    while (end < lines.size() && !lines[end].starts_with("}")) ++end;
    lengths[lines[k]] = end - k + 1;
    k = end;
  }
  return lengths;
}

/// Nor does anything else, but what builds, tests, measures and describes it: tasks, drivers and whatever stands beside the
/// plant run on an engine that they do not know.
TEST(Tree, KnowsEnginesOfThePlantInThePlantOnly) {
  const std::set<std::string> knowing{"sim", "test", "bench", "cmake", "docs"};
  std::size_t told = 0;
  for (const auto& path : project_files(kRoot)) {
    if (knowing.contains(path.begin()->string()) || path.begin() == std::prev(path.end())) continue;
    for (std::string line : lines_of(kRoot / path)) {
      std::ranges::transform(line, line.begin(), [](unsigned char c) { return std::tolower(c); });
      EXPECT_EQ(line.find("mujoco"), std::string::npos) << path << ": " << line;
      ++told;
    }
  }
  EXPECT_GT(told, 10000U) << "the tree was not found";
}

TEST(Tree, MeasuresFunctions) {
  const auto lengths = lengths_of_functions({"namespace a {", "int f() {", "  return 1;", "}", "struct B {",
                                             "};", "void g(int x,", "       int y) {", "}", "int h();"});
  EXPECT_EQ(lengths, (std::map<std::string, std::size_t>{{"int f() {", 3}, {"void g(int x,", 3}}));
}

/// A file is as long as its class; a function is to be read at one look.
TEST(Tree, HasNoLongFunctions) {
  std::size_t functions = 0;
  for (const auto& path : project_files(kRoot)) {
    if (path.extension() != ".cpp" && path.extension() != ".hpp") continue;
    for (const auto& [first, length] : lengths_of_functions(lines_of(kRoot / path))) {
      ++functions;
      EXPECT_LE(length, 60U) << path << ": " << first;
    }
  }
  EXPECT_GT(functions, 2000U) << "the functions were not found";
}

/// @return the sources that any CMakeLists.txt names
std::set<std::string> built_sources() {
  static const std::regex source("[^ ()]+\\.cpp");
  const std::string root = "${CMAKE_SOURCE_DIR}/";
  std::set<std::string> sources;
  for (const auto& path : project_files(kRoot)) {
    if (path.filename() != "CMakeLists.txt") continue;
    for (const std::string& line : lines_of(kRoot / path))
      for (std::sregex_iterator word(line.begin(), line.end(), source); word != std::sregex_iterator();
           ++word) {
        const std::string name = word->str();
        sources.insert(name.starts_with(root) ? name.substr(root.size())
                                              : (path.parent_path() / name).lexically_normal().string());
      }
  }
  return sources;
}

/// A test that nobody builds passes always.
TEST(Tree, BuildsEverySource) {
  const std::set<std::string> built = built_sources();
  EXPECT_GT(built.size(), 1000U) << "they were not found";
  for (const auto& path : project_files(kRoot)) {
    const std::string name = path.string();
    if (path.extension() != ".cpp") continue;
    if (name.starts_with("test/install/example/") || name.starts_with("test/mutation/tiny/")) continue;
    if (path.stem().string().starts_with("main") || name.starts_with("test/fuzz/"))
      continue;  // functions name them
    EXPECT_TRUE(built.contains(name)) << name << " is in no CMakeLists.txt";
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
