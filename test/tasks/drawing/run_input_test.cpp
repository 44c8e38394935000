// Options, configuration and figures of a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "tasks/drawing/config.hpp"
#include "tasks/drawing/figure_info.hpp"
#include "tasks/drawing/input.hpp"
#include "tasks/drawing/results.hpp"
#include "tasks/drawing/strokes.hpp"
#include "test/tasks/drawing/folder.hpp"

namespace mrroc::drawing {
namespace {

Taught taught(double macrostep_s = 0.02) {
  Recording r(macrostep_s);
  for (int k = 0; k < 5; ++k) r = r.appended({Twist{{0.01, 0.02, 0, 0, 0, 0}}, PenState::paper_surface});
  return {r, {{0, 0.0, -10, -10}, {0, 0.1, 10, 20}}};
}

/// Reads the input with one option given.
template <class T, class V>
Input read_with(T InputOptions::*option, const V& value) {
  InputOptions options;
  options.*option = value;
  return read_input(options);
}

bool parses(const std::vector<std::string>& words, InputOptions* result = nullptr) {
  InputOptions options;
  CommandLine line;
  add_input_options(line, options);
  try {
    line.parse(words);
  } catch (const FaultError&) {
    return false;
  }
  if (result) *result = options;
  return true;
}

TEST(Input, WithoutOptionsItIsTheArrowInItsSize) {
  const Input input = read_input({});
  EXPECT_EQ(input.drawing.size(), 6U);
  EXPECT_FALSE(input.taught);
  EXPECT_NEAR(bounds(input.drawing).sizes().maxCoeff(), kDefaultSize, 1e-9);
  EXPECT_EQ(input.start(), input.drawing[0][0]);
  EXPECT_NE(input.about().find("6 strokes, 12 points"), std::string::npos);
}

TEST(Input, OptionsThatContradictEachOtherAreRefused) {
  InputOptions o;
  EXPECT_TRUE(parses({"--drawing", "a.svg", "--size", "80", "--save", "b"}, &o));
  EXPECT_EQ(o.drawing, "a.svg");
  EXPECT_EQ(o.size, 80);
  EXPECT_EQ(o.save, "b");
  EXPECT_TRUE(parses({"--load", "a"}));
  EXPECT_FALSE(parses({"--load", "a", "--drawing", "b.svg"}));
  EXPECT_FALSE(parses({"--load", "a", "--size", "80"}));
  EXPECT_FALSE(parses({"--load", "a", "--save", "b"}));
  EXPECT_FALSE(parses({"--size", "large"}));
}

TEST(Input, ASizeThatCannotBeIsRefused) {
  for (const double size : {0.0, -1.0, 200.1, 1e9})
    EXPECT_THROW(read_with(&InputOptions::size, size), FileError) << size;
  EXPECT_NO_THROW(read_with(&InputOptions::size, 200));
}

TEST(Input, AFolderThatIsNotThereIsSaidBeforeAnythingIsDrawn) {
  const Folder folder;
  try {
    read_with(&InputOptions::save, folder / "no" / "file");
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
  }
  EXPECT_NO_THROW(read_with(&InputOptions::save, folder / "file"));
}

TEST(Input, ALoadedRecordingBringsItsOwnDrawing) {
  const Folder folder;
  save(folder / "taught", taught());
  const Input input = read_with(&InputOptions::load, folder / "taught");
  ASSERT_TRUE(input.taught);
  EXPECT_EQ(*input.taught, taught());
  EXPECT_EQ(input.start(), Point(-10, -10));
  EXPECT_THROW(read_with(&InputOptions::load, folder / "missing"), FileError);
}

TEST(DrawingConfig, BuiltInOneGivesTheDefaults) {
  const Config config = Config::parse(std::string(default_config()), "drawing.toml");
  EXPECT_EQ(read_parameters(config), Parameters{});
  EXPECT_EQ(read_hand_plan(config).steady, HandPlan{}.steady);
}

TEST(DrawingConfig, EveryParameterCanBeSetAndHasItsLimits) {
  Config config = Config::parse("", "test");
  for (const char* s : {"time.n_s=20", "task.teach_force=2.5", "task.draw_force=3.5", "task.settle=7",
                        "task.lift_off=60", "task.pause_macrosteps=4"})
    config.set(s);
  const Parameters k = read_parameters(config);
  EXPECT_EQ(k.n_s, 20);
  EXPECT_EQ(k.teach_force, 2.5);
  EXPECT_EQ(k.draw_force, 3.5);
  EXPECT_EQ(k.settle, 7);
  EXPECT_EQ(k.lift_off, 60);
  EXPECT_EQ(k.pause, 4);
  for (const char* s :
       {"time.n_s=1", "time.n_s=33", "task.teach_force=-1", "task.teach_force=6", "task.draw_force=0",
        "task.settle=-1", "task.lift_off=1", "task.pause_macrosteps=0", "task.draw_force=nan"}) {
    Config wrong = Config::parse("", "test");
    wrong.set(s);
    EXPECT_ANY_THROW(read_parameters(wrong)) << s;
  }
}

TEST(DrawingConfig, ARecordingOfAnotherMacrostepIsRefused) {
  EXPECT_NO_THROW(check_macrostep(taught(), {}, "file"));
  EXPECT_THROW(check_macrostep(taught(0.01), {}, "file"), FileError);
}

/// A trace: runs of m with a force and a height, 20 ms per row.
mp::ArmTrace trace(const std::vector<std::tuple<int, int, double, double>>& runs) {
  mp::ArmTrace t;
  for (const auto& [m, rows, F, z] : runs)
    for (int k = 0; k < rows; ++k) {
      mp::ArmRow row;
      row.i = static_cast<std::int64_t>(t.size());
      row.t = 0.02 * static_cast<double>(t.size());
      row.m = m;
      row.F[Axis::z] = F;
      row.pose.z() = z * k / std::max(1, rows - 1);
      t.push_back(row);
    }
  return t;
}

TEST(Results, PaperForceIsThatOfDrawingAfterTheTouchDown) {
  RunRecord record;
  // The impact in the first 0.2 s and everything outside of m = 5 does not count.
  record.traces[0] = trace({{4, 20, 50, 0}, {5, 10, 9, 0}, {6, 5, 50, 0}});
  record.traces[1] = trace({{5, 10, 9, 0}, {6, 3, 0, 0}, {5, 60, 1, 0}});
  const auto figures = figures_of({}, false, record, {}, {}, true);
  const auto& mean = std::get<std::vector<double>>(figures.at("paper_force_mean_N"));
  const auto& deviation = std::get<std::vector<double>>(figures.at("paper_force_std_N"));
  EXPECT_TRUE(std::isnan(mean[0]));  // nothing but touch-down
  EXPECT_NEAR(mean[1], 1, 1e-12);
  EXPECT_NEAR(deviation[1], 0, 1e-12);
}

TEST(Results, TravelIsTheLargestRiseAndFallWithinOneTravel) {
  RunRecord record;
  record.traces[0] = trace({{7, 10, 0, 0.0005}, {4, 3, 0, 0.1}, {7, 10, 0, 0.002}, {7, 0, 0, 0}});
  const auto figures = figures_of({}, false, record, {}, {}, true);
  EXPECT_NEAR(std::get<std::vector<double>>(figures.at("travel_z_mm"))[0], 2, 1e-9);
  EXPECT_TRUE(std::isnan(std::get<std::vector<double>>(figures.at("travel_z_mm"))[1])) << "it did not travel";
}

TEST(Results, SegmentSkewIsTheLargestAndAtLeastTheSegmentsThatOneArmLacks) {
  const auto skew = [](const RunRecord& record) {
    return std::get<double>(figures_of({}, false, record, {}, {}, true).at("segment_skew"));
  };
  RunRecord record;
  EXPECT_TRUE(std::isnan(skew(record))) << "nothing was drawn";
  record.segment_starts = {{{10, 200, 300}, {10, 203, 299}}};
  EXPECT_EQ(skew(record), 3);
  record.segment_starts = {{{10, 200, 300}, {10}}};
  EXPECT_EQ(skew(record), 2);
  record.segment_starts = {{{}, {10}}};
  EXPECT_EQ(skew(record), 1);
}

TEST(Results, OfADrawingWithoutATravelOrLongerThanTheTouchDownSuchFiguresDoNotApply) {
  RunRecord stroke;
  for (auto& arm : stroke.traces) arm = trace({{4, 20, 2, 0}, {5, 60, 1, 0}, {6, 5, 0, 0}});
  EXPECT_FALSE(figures_of({}, false, stroke, {}, {}, true).contains("travel_z_mm"));
  EXPECT_TRUE(figures_of({}, false, stroke, {}, {}, true).contains("paper_force_mean_N"));
  EXPECT_TRUE(figures_of({}, false, stroke, {}, {}, false).contains("travel_z_mm")) << "it was yet to come";
  RunRecord dots;
  for (auto& arm : dots.traces) arm = trace({{5, 5, 1, 0}, {7, 10, 0, 0}, {5, 5, 1, 0}});
  const auto figures = figures_of({}, false, dots, {}, {}, true);
  EXPECT_FALSE(figures.contains("paper_force_mean_N") || figures.contains("paper_force_std_N"));
  EXPECT_TRUE(figures.contains("travel_z_mm"));
  const auto nothing = figures_of({}, false, {}, {}, {}, true);
  EXPECT_TRUE(nothing.contains("paper_force_mean_N")) << "nothing was drawn: that was not measured";
}

/// A sheet as the simulator leaves it: a line of two parts, the second of which begins 0.4 s after the end of
/// the first.
void leave_broken_line(const Folder& folder, const std::string& file) {
  Ink ink;
  for (int k = 0; k <= 40; ++k) ink.push_back({0, 1 + 0.02 * k, 0.5 * k, 0});
  for (int k = 0; k <= 40; ++k) ink.push_back({1, 2.2 + 0.02 * k, 24 + 0.5 * k, 0});
  write_ink(folder / file, ink);
}

TEST(Results, HopsOfTheHandAreJoinedAndBreaksOfACopyAreShown) {
  const Folder folder;
  for (const char* const file : {"arm1-sheet-0.csv", "arm1-sheet-1.csv", "arm2-sheet-0.csv"})
    leave_broken_line(folder, file);
  const RunInk ink = collect_ink(folder.path(), {"arm1", "arm2"}, std::nullopt);
  const auto figures = figures_of({}, true, {}, ink, {}, true);
  EXPECT_EQ(std::get<double>(figures.at("strokes_taught")), 1);
  EXPECT_EQ(std::get<std::vector<double>>(figures.at("strokes_extra")), (std::vector{1.0, 1.0}));
}

TEST(Results, ACopyLikeTheTaughtInkHasNoErrorAndAMissingOneHasNoFigure) {
  RunInk ink;
  ink.taught = ink_of(fitted(arrow(), 80));
  ink.drawn[0] = ink.taught;
  const auto both = figures_of(fitted(arrow(), 80), true, {}, ink, {}, true);
  EXPECT_NEAR(std::get<double>(both.at("teach_rms_mm")), 0, 1e-6);
  EXPECT_EQ(std::get<std::vector<double>>(both.at("copy_rms_mm")).size(), 1U);
  EXPECT_NEAR(std::get<std::vector<double>>(both.at("copy_rms_mm"))[0], 0, 1e-6);
  EXPECT_FALSE(figures_of({}, false, {}, {}, {}, true).contains("copy_rms_mm"));
}

TEST(Results, OfARunThatEndedEarlyWhatDidNotHappenHasNoNumber) {
  const auto figures = figures_of(fitted(arrow(), 80), true, {}, {}, {}, false);
  EXPECT_TRUE(std::isnan(std::get<double>(figures.at("doubtful_strokes"))));
  EXPECT_TRUE(std::isnan(std::get<double>(figures.at("segment_skew"))));
  for (const double mismatches : std::get<std::vector<double>>(figures.at("pen_state_mismatches")))
    EXPECT_TRUE(std::isnan(mismatches)) << "nothing was drawn that could differ from the memory";
}

TEST(Results, StrokesOfTheInputAndThoseTaughtAreCounted) {
  RunInk ink;
  ink.taught = ink_of({{{0, 0}, {1, 0}}, {{0, 5}, {1, 5}}});
  const auto figures = figures_of(fitted(arrow(), 80), true, {}, ink, {}, true);
  EXPECT_EQ(std::get<double>(figures.at("strokes_input")), 6);
  EXPECT_EQ(std::get<double>(figures.at("strokes_taught")), 2);
  EXPECT_FALSE(figures_of(fitted(arrow(), 80), false, {}, ink, {}, true).contains("strokes_input"));
}

TEST(Figures, TheReadmesTableNamesWhatIsWantedOfThem) {
  std::ifstream file(MRROC_SOURCE_DIR "/README.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  for (const mp::FigureInfo& info : kFigures) {
    if (mp::wanted(info).empty()) continue;
    const auto row = std::ranges::find_if(lines, [&](const std::string& line) {
      return line.starts_with("| `") && line.find("`" + std::string(info.key) + "`") != std::string::npos;
    });
    if (row == lines.end()) continue;  // not every figure is in the README
    EXPECT_NE(row->substr(row->rfind('|', row->size() - 2)).find(mp::wanted(info)), std::string::npos)
        << info.key << " is to be " << mp::wanted(info) << ", the README says " << *row;
  }
}

TEST(Results, SheetsOfTheWorldBecomeTheInkOfTheRun) {
  const Folder folder;
  const Ink sheets[]{ink_of({{{0, 0}, {1, 0}}}), ink_of({{{0, 0}, {2, 0}}}), ink_of({{{0, 0}, {3, 0}}})};
  const auto write_sheets = [&] {
    write_ink(folder / "arm1-sheet-0.csv", sheets[0]);
    write_ink(folder / "arm1-sheet-1.csv", sheets[1]);
    write_ink(folder / "arm2-sheet-0.csv", sheets[2]);
  };
  write_sheets();
  const RunInk with_teach_in = collect_ink(folder.path(), {"arm1", "arm2"}, std::nullopt);
  EXPECT_EQ(with_teach_in.taught, sheets[0]);
  EXPECT_EQ(with_teach_in.drawn[0], sheets[1]);
  EXPECT_EQ(with_teach_in.drawn[1], sheets[2]);
  EXPECT_FALSE(std::filesystem::exists(folder / "arm1-sheet-0.csv"));
  write_ink(folder / "arm1-sheet-0.csv", sheets[1]);
  const RunInk loaded = collect_ink(folder.path(), {"arm1", "arm2"}, sheets[0]);
  EXPECT_EQ(loaded.taught, sheets[0]);
  EXPECT_EQ(loaded.drawn[0], sheets[1]);
  EXPECT_FALSE(loaded.drawn[1]);
  write_tables(folder.path(), loaded);
  EXPECT_EQ(read_ink(folder / "taught.csv"), sheets[0]);
  EXPECT_EQ(read_ink(folder / "ink1.csv"), sheets[1]);
  EXPECT_FALSE(std::filesystem::exists(folder / "ink2.csv"));
}

}  // namespace
}  // namespace mrroc::drawing
