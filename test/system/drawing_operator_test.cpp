// A person at ui_cli, while the task runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "test/system/started_task.hpp"
#include "test/system/tables.hpp"

namespace mrroc::test {
namespace {

class Operated : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
    if (!multicast()) GTEST_SKIP() << "no multicast";
  }

  /// Two lines of 40 mm. @return arguments of the task
  std::vector<std::string> task(const std::vector<std::string>& more) {
    return words({{"--drawing", folder_.write("lines.svg", lines_svg(2)), "--size", "40", "--run-dir",
                   (folder_ / "run").string()},
                  more});
  }
  Ended order(const std::string& what) { return run(folder_, "ui_cli", {what}); }
  std::string state() {
    const auto end = run(folder_, "ui_cli", {"status", "--json"});
    std::string text;
    for (const auto& line : end.out) text += line + "\n";
    return text;
  }

  Folder folder_;
};

/// How far the pen goes over the paper between two rows [mm].
double way(const std::vector<Row>& arm, std::size_t from, std::size_t to) {
  return 1e3 * std::hypot(arm[to][kX] - arm[from][kX], arm[to][kY] - arm[from][kY]);
}

/// Macrosteps from the order to pause until arms stand still: half a second.
constexpr double kComeToRest = 25;

/// @return the macrosteps of the last pause and resume of a script
std::pair<double, double> last_pause(const std::filesystem::path& script) {
  std::ifstream in(script);
  std::pair<double, double> last{};
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with(" pause")) last.first = std::stod(line);
    if (line.ends_with(" resume")) last.second = std::stod(line);
  }
  return last;
}

TEST_F(Operated, AStopKeepsWhatHasBeenTaughtToItsEndAndSaysSoOtherwise) {
  for (const auto& [behaviour, kept] : {std::pair{"m = 2", false}, std::pair{"m = 3", true}}) {
    const std::string name = folder_ / (kept ? "whole" : "half");
    Started drawing(folder_, "drawing",
                    {"--drawing", folder_.write("lines.svg", lines_svg(2)), "--size", "12", "--speed", "5",
                     "--processes", "one", "--save", name, "--run-dir", name + "-run"});
    ASSERT_TRUE(drawing.await_line(behaviour)) << drawing.end().all();
    drawing.signal(SIGINT);
    const Ended end = drawing.end();
    EXPECT_EQ(end.status, 1) << end.all();
    EXPECT_EQ(std::filesystem::exists(name), kept) << end.all();
    const bool told = std::ranges::any_of(
        end.out, [](const auto& line) { return line.find("was not written") != std::string::npos; });
    EXPECT_NE(told, kept) << end.all();
  }
  const Ended again = run(folder_, "drawing", {"--load", folder_ / "whole", "--processes", "one"});
  EXPECT_EQ(again.status, 0) << again.all();
}

TEST_F(Operated, PauseRestsOnThePaperAndResumeGoesOnWithoutAMark) {
  Started drawing(folder_, "drawing", task({"--processes", "separate", "--speed", "3"}));
  ASSERT_TRUE(drawing.await_line("m = 2  record")) << drawing.end().all();
  for (const char* const behaviour : {"m = 2  record", "m = 5  draw on the paper"}) {
    ASSERT_TRUE(drawing.await_line(behaviour)) << drawing.end().all();
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    EXPECT_EQ(order("pause").status, 0);
    EXPECT_EQ(order("pause").status, 1) << "it is paused already";
    EXPECT_EQ(order("trigger").status, 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(1500));
    EXPECT_EQ(order("resume").status, 0);
    EXPECT_EQ(order("resume").status, 1);
  }
  const Ended end = drawing.end();
  ASSERT_EQ(end.status, 0) << end.all();
  const auto figures = summary(folder_ / "run")["figures"];
  EXPECT_LE(figures.at("teach_rms_mm").get<double>(), 1.0);
  EXPECT_EQ(figures.at("segment_skew"), 0);
  for (std::size_t arm = 0; arm < 2; ++arm) {
    EXPECT_LE(figures.at("copy_rms_mm").at(arm).get<double>(), 0.5);
    EXPECT_LE(figures.at("copy_max_mm").at(arm).get<double>(), 1.5);
    EXPECT_EQ(figures.at("stray_ink_mm").at(arm), 0);
    EXPECT_EQ(figures.at("uncovered_mm").at(arm), 0);
    EXPECT_NEAR(figures.at("paper_force_mean_N").at(arm).get<double>(), 1.0, 0.05);
    EXPECT_LE(figures.at("paper_force_std_N").at(arm).get<double>(), 0.2);
  }
  const auto [paused, resumed] = last_pause(folder_ / "run" / "operator.script");
  for (const std::string arm : {"1", "2"}) {
    SCOPED_TRACE("arm " + arm);
    const auto rows = read_table(folder_ / "run" / ("arm" + arm + ".csv"), kArmHeading);
    std::vector<Row> resting;
    for (const Row& row : rows)
      if (row[kI] >= paused + kComeToRest && row[kI] <= resumed) resting.push_back(row);
    ASSERT_FALSE(resting.empty());
    for (std::size_t k = 0; k < resting.size(); ++k) {
      EXPECT_EQ(resting[k][kM], 5);
      EXPECT_LT(way(resting, 0, k), 0.1) << "macrostep " << resting[k][kI];
      EXPECT_NEAR(resting[k][kFz], 1.0, 0.7) << "pressed on the paper, macrostep " << resting[k][kI];
    }
    EXPECT_EQ(strokes(read_table(folder_ / "run" / ("ink" + arm + ".csv"), kInkHeading)), 2);
  }
  // The recorded orders, pauses among them, give the same run again.
  const auto again =
      run(folder_, "drawing",
          {"--processes", "one", "--drawing", (folder_ / "lines.svg").string(), "--size", "40", "--script",
           (folder_ / "run" / "operator.script").string(), "--run-dir", (folder_ / "again").string()});
  ASSERT_EQ(again.status, 0) << again.all();
  EXPECT_EQ(summary(folder_ / "again")["log_hash"], summary(folder_ / "run")["log_hash"]);
}

/// @return what the operator of a run ordered: macrostep and order
std::vector<std::pair<int, std::string>> orders_of(const std::filesystem::path& script) {
  std::ifstream in(script);
  std::vector<std::pair<int, std::string>> orders;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::pair<int, std::string> order;
    if (words >> order.first >> order.second) orders.push_back(order);
  }
  return orders;
}

/// @return where the pen of a saved recording goes, after each node [mm]
std::vector<Row> path_of(const std::filesystem::path& recording) {
  std::ifstream in(recording);
  std::vector<Row> path;
  std::string line;
  while (std::getline(in, line) && line != "x y z ax ay az pen") {
  }
  for (double x = 0, y = 0; std::getline(in, line) && !line.starts_with("ink");) {
    std::istringstream words(line);
    double vx{}, vy{};
    words >> vx >> vy;
    x += 20 * vx;
    y += 20 * vy;
    path.push_back({0, 0, x, y});
  }
  return path;
}

TEST_F(Operated, PausesInTheTeachInLeaveNoNodesHoweverTheHandTrembles) {
  const std::vector<std::string> line{"--drawing",   folder_.write("line.svg", lines_svg(1)),
                                      "--size",      "40",
                                      "--processes", "one",
                                      "--set",       "sim.hand.tremor=2e-4"};
  const auto taught = [&](const std::string& name, const std::vector<std::string>& more) {
    const Ended end =
        run(folder_, "drawing",
            words({line, {"--run-dir", folder_ / name, "--save", folder_ / (name + ".rec")}, more}));
    EXPECT_EQ(end.status, 0) << end.all();
    return summary(folder_ / name)["figures"];
  };
  const double nodes = taught("unpaused", {}).at("nodes").get<double>();
  const auto orders = orders_of(folder_ / "unpaused" / "operator.script");
  ASSERT_EQ(orders.size(), 3U);
  const auto unpaused = path_of(folder_ / "unpaused.rec");
  ASSERT_EQ(static_cast<double>(unpaused.size()), nodes);
  const int begin = orders[1].first - static_cast<int>(nodes);  // of the recording
  std::mt19937 random(1);
  for (int k = 0; k < 3; ++k) {
    std::string script = std::to_string(orders[0].first) + " start\n";
    int later = 0, pauses = 0;
    for (int at = begin + 5; at < orders[1].first - 40; at += 40 + static_cast<int>(random() % 40)) {
      const int lasts = 20 + static_cast<int>(random() % 50);
      ++pauses;
      script += std::to_string(at + later) + " pause\n";
      later += lasts;
      script += std::to_string(at + later) + " resume\n";
    }
    SCOPED_TRACE(script);
    for (std::size_t n = 1; n < orders.size(); ++n)
      script += std::to_string(orders[n].first + later) + " trigger\n";
    const std::string name = "paused" + std::to_string(k);
    const auto figures = taught(name, {"--script", folder_.write(name + ".script", script)});
    // A hand stops in its own time: while the pace goes down and up, in four macrosteps each, nodes are not farther apart
    // than the hand is fast. A pause has twenty macrosteps at least.
    EXPECT_GE(pauses, 2);
    EXPECT_NEAR(figures.at("nodes").get<double>(), nodes, 8 * pauses);
    for (std::size_t arm = 0; arm < 2; ++arm) EXPECT_LE(figures.at("copy_rms_mm").at(arm).get<double>(), 0.5);
    EXPECT_LE(distances(path_of(folder_ / (name + ".rec")), unpaused).second, 0.7);
  }
}

TEST_F(Operated, AttendedTaskWaitsForStartAndTriggers) {
  // At this speed the hand draws for longer than any order takes.
  Started drawing(folder_, "drawing", task({"--processes", "separate", "--attended", "--speed", "2"}));
  ASSERT_TRUE(drawing.await_line("m = 0  wait for start")) << drawing.end().all();
  EXPECT_EQ(order("pause").status, 1) << "nothing to pause yet";
  EXPECT_EQ(order("resume").status, 1);
  EXPECT_EQ(order("trigger").status, 1);
  EXPECT_EQ(order("start").status, 0);
  EXPECT_EQ(order("start").status, 1);
  ASSERT_TRUE(drawing.await_line("m = 1  lead to the paper")) << drawing.end().all();
  ASSERT_TRUE(drawing.await_line("m = 2  record")) << drawing.end().all();
  EXPECT_NE(state().find("\"running\""), std::string::npos);
  const Ended refused = order("start");
  EXPECT_EQ(refused.status, 1);
  EXPECT_TRUE(refused.last_err().starts_with("error: illegal_in_state: ")) << refused.last_err();
  ASSERT_TRUE(drawing.await_line("the hand is done; a trigger goes on")) << drawing.end().all();
  EXPECT_EQ(order("trigger").status, 0);
  ASSERT_TRUE(drawing.await_line("m = 3  lead to the start")) << drawing.end().all();
  EXPECT_EQ(order("stop").status, 0);
  const Ended end = drawing.end();
  EXPECT_EQ(end.status, 1) << end.all();
  EXPECT_EQ(summary(folder_ / "run")["outcome"], "stopped");
  EXPECT_TRUE(end.last_err().starts_with("error: operator_stop: ")) << end.last_err();
  EXPECT_EQ(order("stop").status, 2) << "no task runs any more";
}

TEST_F(Operated, TheWallClockCarriesTheTaskUntilItIsStopped) {
  Started drawing(folder_, "drawing", task({"--processes", "separate", "--clock", "wall"}));
  ASSERT_TRUE(drawing.await_line("m = 1  lead to the paper")) << drawing.end().all();
  const auto children = drawing.children();
  EXPECT_EQ(children.size(), 7u);
  std::this_thread::sleep_for(std::chrono::seconds(4));
  EXPECT_EQ(order("stop").status, 0);
  const Ended end = drawing.end();
  EXPECT_EQ(end.status, 1) << end.all();
  EXPECT_EQ(summary(folder_ / "run")["outcome"], "stopped");
  EXPECT_TRUE(all_gone(children));
  const auto rows = read_table(folder_ / "run" / "arm1.csv", kArmHeading);
  double farthest = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) farthest = std::max(farthest, way(rows, 0, k));
  EXPECT_GT(farthest, 1) << "the hand leads the arm";
}

}  // namespace
}  // namespace mrroc::test
