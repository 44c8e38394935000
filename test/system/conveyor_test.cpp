// The drawing task with a conveyor, seen from outside.
#include <gtest/gtest.h>

#include <csignal>

#include "test/system/started_task.hpp"
#include "test/system/tables.hpp"

namespace mrroc::test {
namespace {

class OnAConveyor : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
    drawing_ = folder_.write("lines.svg", lines_svg(2));
    crossing_ = folder_.write(
        "crossing.svg", "<svg xmlns='http://www.w3.org/2000/svg'><path d='M0 0 L30 40 M30 0 L0 40'/></svg>");
  }

  std::vector<std::string> arguments(const std::string& name, const std::vector<std::string>& more,
                                     const std::string& drawing = {}) {
    return words({{"--drawing", drawing.empty() ? drawing_ : drawing, "--size", "40", "--run-dir",
                   (folder_ / name).string()},
                  more});
  }
  Ended draw(const std::string& name, const std::vector<std::string>& more, const std::string& drawing = {}) {
    return run(folder_, "drawing", words({{"--processes", "one"}, arguments(name, more, drawing)}));
  }
  /// @return [smallest, largest] of a column of a table of the run
  std::pair<double, double> range(const std::string& name, const std::string& table, int column) {
    const auto rows = read_table(folder_ / name / table, kArmHeading);
    double low = rows.at(0).at(column), high = low;
    for (const Row& row : rows)
      if (row[kM] >= 4) {
        low = std::min(low, row[column]);
        high = std::max(high, row[column]);
      }
    return {low, high};
  }
  double far_apart(const std::string& a, const std::string& b, const std::string& ink) {
    return distances(read_table(folder_ / a / ink, kInkHeading), read_table(folder_ / b / ink, kInkHeading))
        .first;
  }

  Folder folder_;
  std::string drawing_;
  std::string crossing_;  // its strokes go across the belt and along it
};

TEST_F(OnAConveyor, TheBeltMovesInsteadOfTheArmsAndTheInkIsTheSame) {
  const Ended plain = draw("plain", {}), belt = draw("belt", {"--conveyor"});
  ASSERT_EQ(plain.status, 0) << plain.all();
  ASSERT_EQ(belt.status, 0) << belt.all();
  for (const char* const ink : {"ink1.csv", "ink2.csv"})
    EXPECT_LT(far_apart("belt", "plain", ink), 0.3) << ink;
  const auto [low, high] = range("belt", "conveyor.csv", kY);
  EXPECT_GT(high - low, 0.005) << "the belt has moved";
  EXPECT_EQ(summary(folder_ / "belt").at("figures").at("segment_skew"), 0);
}

TEST_F(OnAConveyor, BothArmsDrawOnSheetsThatRunBelowThem) {
  const Ended plain = draw("plain", {}), belt = draw("belt", {"--belt-speed", "0.1"});
  ASSERT_EQ(plain.status, 0) << plain.all();
  ASSERT_EQ(belt.status, 0) << belt.all();
  for (const char* const ink : {"ink1.csv", "ink2.csv"})
    EXPECT_LT(far_apart("belt", "plain", ink), 0.3) << ink;
  for (const char* const table : {"conveyor.csv", "arm1.csv", "arm2.csv"}) {
    const auto [low, high] = range("belt", table, kY);
    EXPECT_GT(high - low, 0.08) << table;
  }
  const auto figures = summary(folder_ / "belt").at("figures");
  EXPECT_GT(figures.at("belt_starts"), 5);
  for (const double drift : figures.at("belt_drift_mm")) EXPECT_LT(drift, 0.1);
}

TEST_F(OnAConveyor, InkIsAtItsPlaceOnTheSheetAtEverySpeed) {
  for (const auto& [speed, seed] :
       {std::pair("0.01", "2"), std::pair("0.03", "5"), std::pair("0.07", "11"), std::pair("0.1", "3")}) {
    const std::string name = std::string("at") + speed;
    const Ended belt = draw(name, {"--belt-speed", speed, "--seed", seed}, crossing_);
    ASSERT_EQ(belt.status, 0) << belt.all();
    const auto figures = summary(folder_ / name).at("figures");
    for (const char* const key : {"belt_rms_mm", "belt_drift_mm", "paper_force_mean_N"})
      ASSERT_EQ(figures.at(key).size(), 2U) << key;
    for (std::size_t arm = 0; arm < 2; ++arm) {
      EXPECT_LT(figures.at("belt_rms_mm").at(arm), 0.3) << speed;
      EXPECT_LT(figures.at("belt_drift_mm").at(arm), 0.1) << speed;
      EXPECT_NEAR(figures.at("paper_force_mean_N").at(arm), 1, 0.05) << speed;
    }
    EXPECT_EQ(figures.at("segment_skew"), 0) << speed;
  }
}

TEST_F(OnAConveyor, ALagOfTheArmsBehindTheBeltIsSeenInTheInk) {
  const Ended late = draw("late", {"--belt-speed", "0.1", "--set", "task.belt_lag=-2"}, crossing_);
  ASSERT_TRUE(std::filesystem::exists(folder_ / "late" / "summary.json")) << late.all();
  const auto figures = summary(folder_ / "late").at("figures");
  for (const double rms : figures.at("belt_rms_mm"))
    EXPECT_GT(rms, 0.6) << "two macrosteps are 4 mm at full speed";
}

TEST_F(OnAConveyor, AStopAnEmergencyStopAndCtrlCEndARunOnAMovingBeltAtRest) {
  for (const std::string order : {"stop", "e-stop"}) {
    const Ended end =
        draw(order, {"--belt-speed", "0.1", "--script",
                     folder_.write("orders", "3 start\n700 trigger\n1000 trigger\n1200 " + order + "\n")});
    EXPECT_EQ(end.status, 1) << end.all();
    EXPECT_EQ(summary(folder_ / order).at("outcome"), "stopped") << end.all();
    EXPECT_LE(figure(summary(folder_ / order), "stop_steps_max"), 100) << end.all();
  }
  if (!multicast()) return;
  Started task(folder_, "drawing",
               arguments("ctrl-c", {"--processes", "separate", "--speed", "3", "--belt-speed", "0.1"}),
               "ctrl-c");
  ASSERT_TRUE(task.await_line("m = 5  draw on the paper"));
  const auto children = task.children();
  task.signal(SIGINT);
  const Ended end = task.end();
  EXPECT_EQ(end.status, 1) << end.all();
  EXPECT_TRUE(all_gone(children));
  EXPECT_EQ(summary(folder_ / "ctrl-c").at("outcome"), "stopped");
}

TEST_F(OnAConveyor, BadInputIsRefusedBeforeAnythingMoves) {
  for (const auto& [more, word] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--belt-speed", "0.2"}, "--belt-speed"},
           {{"--belt-speed", "-0.1"}, "--belt-speed"},
           {{"--belt-speed", "0.005"}, "--belt-speed"},
           {{"--belt-speed", "nan"}, "--belt-speed"},
           {{"--belt-speed", "0.1", "--conveyor"}, "--conveyor"},
           {{"--conveyor", "--set", "sim.paper.height=0.95"}, "sim.paper.height"}}) {
    const Ended end = draw("bad", more);
    EXPECT_NE(end.status, 0) << more.back();
    EXPECT_NE(end.last_err().find(word), std::string::npos) << end.all();
    EXPECT_FALSE(std::filesystem::exists(folder_ / "bad")) << more.back();
  }
}

TEST_F(OnAConveyor, ADriverOfTheBeltThatIsKilledEndsTheRunWithAllAtRest) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  for (const std::string node : {"edp-conveyor", "ecp-conveyor"}) {
    Started task(folder_, "drawing",
                 arguments(node, {"--processes", "separate", "--speed", "3", "--belt-speed", "0.1"}), node);
    ASSERT_TRUE(task.await_line("m = 5  draw on the paper"));
    const auto children = task.children();
    ::kill(task.child(node).pid, SIGKILL);
    const Ended end = task.end();
    EXPECT_EQ(end.status, 3) << end.all();
    EXPECT_NE(end.last_err().find(node), std::string::npos) << end.all();
    EXPECT_TRUE(all_gone(children));
    EXPECT_LE(figure(summary(folder_ / node), "stop_steps_max"), 100) << end.all();
  }
}

}  // namespace
}  // namespace mrroc::test
