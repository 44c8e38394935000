// One short run of every task, also with sanitizers: it comes to its end, and what its processes decided is recomputed from
// the log.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

struct ShortRun {
  std::string task;
  std::vector<std::string> arguments;   ///< FILE: name of the file
  std::string file;                     ///< its content; empty: there is none
  std::vector<std::string> recomputed;  ///< processes
  bool lasts{};                         ///< too long for the thread sanitizer, which sees it stopped
  bool draws{true};                     ///< leaves pictures
};

void PrintTo(const ShortRun& k, std::ostream* out) { *out << k.task; }  // NOLINT: the name that gtest wants

#ifdef __SANITIZE_THREAD__
constexpr bool kSlowThreads = true;
#else
constexpr bool kSlowThreads = false;
#endif

const std::vector<ShortRun> kRuns{
    {"press", {}, "", {"mp", "ecp-arm1"}},
    {"weigh", {}, "", {"mp", "ecp-arm1"}},
    {"edge_follow", {}, "", {"mp", "ecp-arm1", "ecp-arm2"}},
    {"guide", {"--fixture", "circle", "--set", "task.radius=0.02"}, "", {"mp", "ecp-arm1"}},
    {"haptic", {"--delay", "40", "--loss", "10"}, "", {"mp", "ecp-arm1", "ecp-arm2"}},
    {"ball", {"--set", "task.turn=400"}, "", {"mp", "ecp-arm1", "ecp-arm2"}},
    {"calibrate_cell",
     {"--set", "artefact.balls=[-0.15, -0.02, -0.06, 0.15, 0.02, -0.06, 0.15, -0.02, 0.06]", "--set",
      "task.readings=5", "--set", "task.views=8", "--set", "cameras.order=['eih']"},
     "",
     {"mp", "ecp-arm1", "ecp-arm2"},
     true},
    {"move",
     {"--file", "FILE"},
     "[arm1]\norder = ['a']\n[arm1.a]\nvelocity = [0.5]\nacceleration = [0.3]\n"
     "positions = [0.1, -1.5, 0, 1.5, 1.57, -1.57]\n"
     "[arm2]\norder = ['a']\n[arm2.a]\ngenerator = 'straight'\nreference = 'relative'\n"
     "positions = [0.05, 0, 0, 0, 0, 0]\n",
     {"mp", "ecp-arm1", "ecp-arm2"}},
    {"drawing",
     {"--drawing", "FILE", "--size", "10"},
     lines_svg(1),
     {"mp", "ecp-arm1", "ecp-arm2", "vsp-arm1", "vsp-arm2"}},
    {"manual",
     {"--words", "FILE", "--set", "robots.arm1.synchro=known_pose", "--set",
      "robots.arm2.synchro=known_pose"},
     "3 home all\n"
     "100 move arm1 joints 0.1 -1.5 0 1.5 1.57 -1.57 speed 0.5 acceleration 0.2\n"
     "300 jog arm2 angle-axis 0 0 -0.02 0 0 0 speed 0.5 acceleration 0.2\n"
     "400 end\n",
     {"mp", "ecp-arm1", "ecp-arm2"},
     false,
     false},
    {"visual_servo",
     {"--object", "apriltag", "--cameras", "sac", "--set", "cameras.profile=fast", "--set",
      "task.duration=2"},
     "",
     {"mp", "ecp-arm1"}},
    {"rubik",
     {"--scramble", "U'", "--eyes", "none", "--set", "task.tables=small"},
     "",
     {"mp", "ecp-arm1", "ecp-arm2"},
     true},
#ifdef MRROC_REX
    {"rex_drive", {"--plan", "FILE", "--eyes", "off"}, "0 0\n0.7 0\n1.2 0.3\n", {"mp", "ecp-rex", "ecp-map"}},
    {"box_push",
     {"--to", "0.5", "0", "0", "--set", "sim.platforms.rex1.start=[-1.1, 0.54, 0]", "--set",
      "sim.platforms.rex2.start=[-1.1, -0.54, 0]"},
     "",
     {"mp", "ecp-rex1", "ecp-rex2", "ecp-map1", "ecp-map2"},
     true},
#endif
};

/// A run names every picture that it leaves, and leaves some.
void expect_pictures_named(const fs::path& run_folder, const Ended& ended, bool draws) {
  int pictures = 0;
  for (const auto& entry : fs::recursive_directory_iterator(run_folder)) {
    if (entry.path().extension() != ".png") continue;
    ++pictures;
    EXPECT_NE(std::ranges::find(ended.out, "picture: " + entry.path().string()), ended.out.end())
        << entry.path() << "\n"
        << ended.all();
  }
  if (std::system("gnuplot --version >/dev/null 2>&1") == 0) {
    EXPECT_EQ(pictures > 0, draws);
  }
  EXPECT_FALSE(fs::exists(run_folder / "plots" / "gnuplot.log")) << "gnuplot complained";
}

class EveryTask : public ::testing::TestWithParam<ShortRun> {};

TEST_P(EveryTask, ComesToItsEndAndIsRecomputedFromItsLog) {
  const ShortRun& k = GetParam();
  const Folder folder(false);  // it is recomputed here
  std::vector<std::string> arguments = k.arguments;
  if (!k.file.empty()) std::ranges::replace(arguments, "FILE", folder.write("file", k.file));
  const bool stopped = k.lasts && kSlowThreads;
  if (stopped) arguments = words({arguments, {"--script", folder.write("orders", "3 start\n250 stop\n")}});
  const std::string run_folder = (folder / "run").string();
  const Ended ended =
      run(folder, k.task, words({{"--processes", "one", "--run-dir", run_folder}, arguments}));
  ASSERT_EQ(ended.status, stopped ? 1 : 0) << ended.all();
  EXPECT_EQ(summary(run_folder).at("outcome"), stopped ? "stopped" : "done");
  if (!stopped) expect_pictures_named(run_folder, ended, k.draws);

  const Ended checked = run(folder, "ui_cli", {"log", "check", run_folder, "--json"});
  EXPECT_EQ(checked.status, 0) << checked.all();
  std::string text;
  for (const std::string& line : checked.out) text += line + "\n";
  const auto verdict = nlohmann::json::parse(text, nullptr, false);
  ASSERT_TRUE(verdict.is_object()) << checked.all();
  EXPECT_EQ(verdict.at("differences"), 0) << verdict.dump(2);
  EXPECT_EQ(verdict.at("complete"), true) << verdict.dump(2);
  for (const std::string& process : k.recomputed) {
    const auto& all = verdict.at("processes");
    const auto found = std::ranges::find_if(all, [&](const auto& p) { return p.at("process") == process; });
    ASSERT_NE(found, all.end()) << process;
    EXPECT_EQ(found->at("not_checked"), "") << process;
    EXPECT_GT(found->at("compared").template get<int>(), 100) << process;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, EveryTask, ::testing::ValuesIn(kRuns),
                         [](const auto& named) { return named.param.task; });

/// A task that is added is to be run here, too.
TEST(EveryTaskOfTheTree, IsAmongTheseRuns) {
  for (const auto& entry : fs::directory_iterator(fs::path(MRROC_SOURCE_DIR) / "tasks")) {
    if (!fs::exists(entry.path() / "main.cpp")) continue;
#ifndef MRROC_REX
    // Without CasADi there is no platform.
    if (entry.path().filename() == "rex_drive" || entry.path().filename() == "box_push") continue;
#endif
    EXPECT_TRUE(std::ranges::any_of(kRuns, [&](const ShortRun& k) {
      return k.task == entry.path().filename();
    })) << entry.path();
  }
}

/// A generator that is added is to be executed by a task, and with it by these runs and those of the task's own tests.
TEST(EveryGeneratorOfTheTree, IsExecutedByATask) {
  const fs::path root = MRROC_SOURCE_DIR;
  std::string included;
  for (const auto& entry : fs::recursive_directory_iterator(root / "tasks")) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("#include")) included += line + "\n";
  }
  for (const auto& entry : fs::directory_iterator(root / "ecp" / "generators")) {
    if (entry.path().extension() != ".hpp") continue;
    EXPECT_NE(included.find("ecp/generators/" + entry.path().filename().string()), std::string::npos)
        << entry.path();
  }
}

}  // namespace
}  // namespace mrroc::test
