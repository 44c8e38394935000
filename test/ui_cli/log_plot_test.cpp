// Pictures of `ui_cli log plot`, checked in the gnuplot script that it leaves beside the picture.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "base/file_content.hpp"
#include "base/gnuplot_text.hpp"
#include "mrroc/effector_command_t.hpp"
#include "mrroc/effector_reply_t.hpp"
#include "test/ui_cli/run_folder.hpp"
#include "ui_cli/log/log_plot.hpp"

namespace mrroc::test {
namespace {

using ui::PlotOptions;

/// A table of a script: its columns, and its rows as numbers.
struct Table {
  std::string columns;
  std::vector<std::vector<double>> rows;
};

std::vector<Table> tables_in(const std::string& script) {
  std::vector<Table> all;
  std::istringstream in(script);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("$table")) {
      all.emplace_back();
      std::getline(in, all.back().columns);
      inside = true;
    } else if (line == "EOD") {
      inside = false;
    } else if (inside && !line.empty()) {
      auto& row = all.back().rows.emplace_back();
      std::istringstream cells(line);
      for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    }
  }
  return all;
}

/// @return what stands behind each "set yrange "
std::vector<std::pair<double, double>> ranges_in(const std::string& script) {
  std::vector<std::pair<double, double>> all;
  const std::string key = "set yrange [";
  for (std::size_t at = script.find(key); at != std::string::npos; at = script.find(key, at + 1)) {
    std::size_t used = 0;
    const double low = std::stod(script.substr(at + key.size()), &used);
    all.emplace_back(low, std::stod(script.substr(at + key.size() + used + 1)));
  }
  return all;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Runs of an arm of six axes: no reading until macrostep 3; a load of -13 N until the bias, which macrostep 8 commands;
/// then 1 N, and 4 N from behaviour 2 on; zeros in the last macrostep.
class PlottedRun : public RunFolder {
 protected:
  static constexpr std::int64_t kFirst = 4, kBias = 8, kLast = 60, kSettled = 30;
  static constexpr double kMacrostep = 0.02;

  [[nodiscard]] fs::path write(const std::string& name, double more = 0, const std::string& arm = "arm1",
                               std::uint8_t axes = 63) const {
    fs::path folder = make(name, 5, 0);
    const link::LogReader whole(folder);
    link::EventLog to(folder / link::kEventLog, 5);
    for (std::int64_t i = 1; i <= kLast; ++i) {
      const bool reads = i >= kFirst && i < kLast;
      Report r{.m = i < 12 ? 0 : i < kSettled ? 1 : 2};
      effector_reply_t e{};
      e.robot_model.set_servo_algorithm = axes;
      if (reads) {
        r.position_known = true;
        r.T_0E = {0.9 + 1e-3 * static_cast<double>(i), 0, 0.94, M_PI, 0, 0};
        r.F_a[Axis::z] = i < kBias + 2 ? -13 : (i < kSettled ? 1 : 4) + more;
        for (std::size_t k = 0; k < 5; ++k)
          e.motors[k] = 10 + 0.1 * static_cast<double>(i);  // the last one rests at zero
      }
      effector_command_t c{};
      if (i == kBias) {
        c.set = 2;
        c.robot_model.set_force_tool = 1;
      }
      log(to, arm + ".report", to_message(r), 5, i, i);
      log(to, arm + ".reply", e, 5, i, i);
      log(to, arm + ".command", c, 5, i, i);
    }
    for (const auto& [m, behaviour] : std::map<int, const char*>{{1, "approach"}, {2, "settle"}}) {
      process_status_t s{};
      s.m = m;
      link::put_text(s.behaviour, behaviour);
      log(to, "ecp-" + arm + ".status", s, 5, m, 0);
    }
    return folder;
  }

  [[nodiscard]] static std::string script(const std::vector<fs::path>& folders, const PlotOptions& options) {
    std::vector<ui::RunRecord> runs(folders.begin(), folders.end());
    return ui::plot_script(runs, options, "p.png");
  }
  /// @return the error and its remedy; "" without one
  [[nodiscard]] static std::string error(const fs::path& folder, const PlotOptions& options) {
    try {
      static_cast<void>(script({folder}, options));
    } catch (const FaultError& e) {
      return e.error_line();
    }
    return "";
  }
};

TEST_F(PlottedRun, ForcesAreThoseAfterTheBiasAndSetTheScale) {
  const std::string s = script({write("r")}, {.what = "force"});
  const auto table = tables_in(s).at(0);
  EXPECT_EQ(table.columns, "t,F_x,F_y,F_z");
  EXPECT_NEAR(table.rows.front()[0], (kBias + 3) * kMacrostep, 1e-9);
  EXPECT_NEAR(table.rows.back()[0], (kLast - 1) * kMacrostep, 1e-9) << "the last report has no reading";
  const auto range = ranges_in(s).at(0);
  EXPECT_GT(range.first, -1);
  EXPECT_LT(range.second, 5);
  EXPECT_TRUE(has(s, "'before the bias'"));
}

TEST_F(PlottedRun, TheTitleNamesTheTasksOfAllRuns) {
  const fs::path press = write("r"), weigh = write("weigh-1");
  const fs::path list = weigh / "processes.json";
  std::string text = file_content(list);
  text.replace(text.find("press"), 5, "weigh");
  std::ofstream(list) << text;
  EXPECT_TRUE(has(script({press, weigh}, {.what = "force"}), "press and weigh, "));
  EXPECT_TRUE(has(script({weigh, press}, {.what = "force"}), "weigh and press, "));
  EXPECT_TRUE(has(script({press, press}, {.what = "force"}), "press, "));
  EXPECT_FALSE(has(script({weigh}, {.what = "force"}), "weigh, ")) << "the folder's name tells it";
}

TEST_F(PlottedRun, EveryAxisHasAColourOfItsOwn) {
  const std::string s = script({write("r", 0, "arm1", 255)}, {.what = "motors"});
  const auto uses = [&](std::string_view colour) {
    std::size_t count = 0;
    for (std::size_t at = s.find(colour); at != std::string::npos; at = s.find(colour, at + 1)) ++count;
    return count;
  };
  EXPECT_GE(uses(kCurveColours[0]), 1U);
  for (const std::string_view colour : kCurveColours)
    EXPECT_EQ(uses(colour), uses(kCurveColours[0])) << colour;
}

TEST_F(PlottedRun, WhoLooksAtTheTimeBeforeTheBiasSeesTheLoad) {
  const std::string s = script({write("r")}, {.what = "force", .to = 0.15});
  EXPECT_EQ(tables_in(s).at(0).rows.back()[3], -13);
  EXPECT_LT(ranges_in(s).at(0).first, -13);
}

TEST_F(PlottedRun, PosesAreWhatEHasComeSinceTheFirstReadingAndHaveNoZeroRows) {
  const auto table = tables_in(script({write("r")}, {.what = "pose"})).at(0);
  EXPECT_EQ(table.columns, "t,x,y,z");
  ASSERT_EQ(table.rows.size(), static_cast<std::size_t>(kLast - kFirst));
  EXPECT_NEAR(table.rows.front()[1], 0, 1e-9);
  EXPECT_NEAR(table.rows.back()[1], static_cast<double>(kLast - 1 - kFirst), 1e-6) << "1 mm a macrostep";
  for (const auto& row : table.rows) EXPECT_NEAR(row[3], 0, 1e-9);
  const auto later = tables_in(script({write("r")}, {.what = "pose", .from = 0.5})).at(0);
  EXPECT_NEAR(later.rows.front()[1], 0, 1e-9) << "since the first reading that is shown";
  const auto absolute = tables_in(script({write("r")}, {.what = "pose", .fields = {"T_0E"}}));
  ASSERT_EQ(absolute.size(), 2U) << "metres and radians have a chart each";
  EXPECT_NEAR(absolute[0].rows.front()[3], 0.94, 1e-6);
  const auto turned = tables_in(script({write("r")}, {.what = "pose", .fields = {"rx", "rz"}})).at(0);
  for (const auto& row : turned.rows) EXPECT_NEAR(std::hypot(row[1], row[2]), 0, 1e-6);
}

TEST_F(PlottedRun, OnlyTheAxesThatTheArmHasAreDrawn) {
  const fs::path run = write("r");
  EXPECT_EQ(tables_in(script({run}, {.what = "motors"})).at(0).columns,
            "t,turned[0],turned[1],turned[2],turned[3],turned[4],turned[5]");
  EXPECT_TRUE(has(error(run, {.what = "motors", .fields = {"motors[6]"}}), "motors[5]"));
  const fs::path both = write("both", 0, "arm2", 127);
  const auto tables = tables_in(script({run, both}, {.what = "motors", .fields = {"motors"}}));
  EXPECT_EQ(tables.size(), 6U + 7U) << "a chart for each arm and field";
}

TEST_F(PlottedRun, BehavioursHaveTheirNamesAtTheirTimes) {
  for (const std::string& what : ui::arm_subjects()) {
    const std::string s = script({write("r")}, {.what = what});
    EXPECT_TRUE(has(s, "'1 approach'")) << what;
    EXPECT_TRUE(has(s, "'2 settle'")) << what;
    EXPECT_TRUE(has(s, "set object rectangle from first 0.64,"))
        << what << ": readings of what is commanded from macrostep 30 on are reported two later";
    EXPECT_TRUE(has(s, "set xlabel 'simulated time t [s]'")) << what;
  }
}

TEST_F(PlottedRun, TheNamesOfAnArmThatIsLedAreTheCoordinators) {
  const fs::path folder = write("r");
  {
    link::EventLog to(folder / link::kEventLog, 5);
    Report r{.m = 7, .position_known = true};
    r.F_a[Axis::z] = 1;
    for (std::int64_t i = 1; i <= 9; ++i) log(to, "arm1.report", to_message(r), 5, i, i);
    task_status_t s{};
    s.m = 7;
    s.n_agents = 1;
    link::put_text(s.behaviour, "travel");
    link::put_text(s.agent[0], "arm1");
    link::put_text(s.agent_behaviour[0], "copy the orders");
    log(to, "task_status", s, 5, 1, 1);
  }
  EXPECT_TRUE(has(script({folder}, {.what = "force"}), "'7 travel'"));
}

TEST_F(PlottedRun, SeveralRunsHaveAChartForEachFieldAndACurveForEachRun) {
  const std::vector<fs::path> runs{write("one"), write("two", 0.5)};
  const std::string s = script(runs, {.what = "force", .fields = {"F_z", "F_x"}});
  const auto tables = tables_in(s);
  ASSERT_EQ(tables.size(), 4U);
  EXPECT_EQ(tables[0].columns, "t,F_x");
  EXPECT_EQ(tables[2].columns, "t,F_z");
  EXPECT_EQ(tables[2].rows.back()[1], 4);
  EXPECT_EQ(tables[3].rows.back()[1], 4.5);
  EXPECT_TRUE(has(s, "set label 'one'")) << s;
  EXPECT_TRUE(has(s, "set label 'two'"));
  EXPECT_TRUE(has(s, "F_z [N]"));
}

TEST_F(PlottedRun, RunsOfOneNameAreToldApartByTheirFolders) {
  fs::create_directories(home_ / "x");
  const fs::path one = write("one"), other = home_ / "x" / "one";
  fs::copy(one, other);
  const std::string s = script({one, other}, {.what = "force", .fields = {"F_z"}});
  EXPECT_TRUE(has(s, "x/one'")) << s;
}

TEST_F(PlottedRun, OnlyTheTimeAskedForIsDrawn) {
  const std::string s = script({write("r")}, {.what = "force", .from = 0.5, .to = 0.9});
  const auto table = tables_in(s).at(0);
  EXPECT_NEAR(table.rows.front()[0], 0.5, 1e-9);
  EXPECT_NEAR(table.rows.back()[0], 0.9, 1e-9);
  EXPECT_TRUE(has(s, "set xrange [0.5:0.9]"));
}

TEST_F(PlottedRun, WhatCannotBeDrawnIsSaidWithWhatCan) {
  const fs::path run = write("r");
  const std::string field = error(run, {.what = "force", .fields = {"F_z", "F_b"}});
  EXPECT_TRUE(has(field, "no field 'F_b'") && has(field, "F_x, F_y, F_z, N_x, N_y, N_z")) << field;
  const std::string arm = error(run, {.what = "force", .arms = {"arm9"}});
  EXPECT_TRUE(has(arm, "has no arm 'arm9'") && has(arm, "arms: arm1")) << arm;
  EXPECT_TRUE(has(error(run, {.what = "force", .from = 3, .to = 1}), "--from 3 is not before --to 1"));
  EXPECT_TRUE(has(error(run, {.what = "force", .from = 1, .to = 1}), "not before"));
  for (const auto& [from, to] : {std::pair{50.0, 60.0}, {50.0, HUGE_VAL}, {-HUGE_VAL, 0.01}, {-3.0, -1.0}})
    EXPECT_TRUE(has(error(run, {.what = "force", .from = from, .to = to}), "from 0.08 to 1.18 s")) << from;
  EXPECT_TRUE(has(error(run, {.what = "force", .from = std::nan("")}), "seconds"));
}

TEST_F(PlottedRun, TheCommandTakesRunsThenWhatAndItsOptions) {
  const fs::path one = write("one"), two = write("two");
  const auto said = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "plot");
    EXPECT_EQ(run(words), 2);
    return err_.str();
  };
  EXPECT_TRUE(has(said({}), "RUN (the run folder) is missing"));
  EXPECT_TRUE(has(said({"force"}), "RUN (the run folder) is missing"));
  EXPECT_TRUE(
      has(said({one.string(), two.string()}),
          "WHAT (force, pose, motors, behaviours of arms, path, error, torques, slip, speeds, behaviours of "
          "platforms) is missing"));
  EXPECT_TRUE(has(said({one.string(), "forces"}), "'forces' cannot be drawn")) << err_.str();
  EXPECT_TRUE(has(said({one.string(), "force", "--from", "x"}), "--from")) << err_.str();
  if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  const fs::path picture = home_ / "p.png";
  EXPECT_EQ(run({"plot", one.string(), two.string(), "--fields", "F_z,x,motors[2]", "--arm", "arm1", "--to",
                 "1", "--output", picture.string()}),
            0)
      << err_.str();
  EXPECT_TRUE(fs::exists(picture));
  EXPECT_EQ(run({"plot", one.string(), "pose"}), 0) << err_.str();
  EXPECT_TRUE(fs::exists(one / "plots" / "log-pose.png"));
}

}  // namespace
}  // namespace mrroc::test
