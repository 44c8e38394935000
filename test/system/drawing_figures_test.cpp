// The whole task in one process: what it must reach, judged from the summary and anew from the tables.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "test/system/started_task.hpp"
#include "test/system/tables.hpp"

namespace mrroc::test {
namespace {

constexpr const char* kMixed = R"svg(
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100">
  <g fill="none" stroke="black" transform="translate(10 5) scale(0.8)">
    <path d="M10 60 Q 30 40 50 60 T 90 60"/>
    <path d="M10 90 A 20 10 30 0 1 50 90 C 60 100 70 100 80 80"/>
    <circle cx="25" cy="25" r="12"/>
    <polyline points="60,10 70,30 80,10" transform="rotate(10 70 20)"/>
    <line x1="90" y1="40" x2="90" y2="40"/>
  </g>
</svg>
)svg";

void expect_at_most(const nlohmann::json& figures, const std::string& key, double bar) {
  ASSERT_TRUE(figures.contains(key)) << key;
  const nlohmann::json& values = figures.at(key);
  for (const auto& figure : values.is_array() ? values : nlohmann::json::array({values})) {
    ASSERT_TRUE(figure.is_number()) << key << " is " << figure;
    EXPECT_LE(figure.get<double>(), bar) << key;
  }
}

void expect_good(const nlohmann::json& summary) {
  EXPECT_EQ(summary.at("outcome"), "done");
  EXPECT_TRUE(summary.at("fault").is_null());
  EXPECT_NE(summary.at("log_hash"), "0000000000000000");
  const nlohmann::json& f = summary.at("figures");
  expect_at_most(f, "teach_rms_mm", 1.0);
  expect_at_most(f, "copy_rms_mm", 0.5);
  expect_at_most(f, "copy_max_mm", 1.5);
  expect_at_most(f, "paper_force_mean_N", 1.05);
  for (const double mean : f.at("paper_force_mean_N")) EXPECT_GE(mean, 0.95);
  expect_at_most(f, "paper_force_std_N", 0.2);
  expect_at_most(f, "travel_z_mm", 0.2);
  expect_at_most(f, "segment_skew", 0);
  expect_at_most(f, "stray_ink_mm", 0);
  expect_at_most(f, "strokes_missing", 0);
  expect_at_most(f, "uncovered_mm", 0);
  for (const std::string key : {"pen_state_wrong_strokes", "pen_state_mismatches", "doubtful_strokes"})
    expect_at_most(f, key, 0);
}

void expect_good_tables(const std::filesystem::path& run, int strokes_wanted) {
  const auto input = read_table(run / "input.csv", kInkHeading);
  const auto taught = read_table(run / "taught.csv", kInkHeading);
  EXPECT_EQ(strokes(input), strokes_wanted);
  EXPECT_EQ(strokes(taught), strokes_wanted);
  EXPECT_LE(distances(taught, input).first, 1.0);
  std::vector<std::vector<double>> departed;
  for (const std::string arm : {"1", "2"}) {
    SCOPED_TRACE("arm " + arm);
    const auto rows = read_table(run / ("arm" + arm + ".csv"), kArmHeading);
    const auto [mean, deviation] = paper_force(rows);
    EXPECT_NEAR(mean, 1.0, 0.05);
    EXPECT_LE(deviation, 0.2);
    EXPECT_LE(travel_z(rows), 0.2);
    departed.push_back(departures(rows));
    const auto ink = read_table(run / ("ink" + arm + ".csv"), kInkHeading);
    EXPECT_EQ(strokes(ink), strokes_wanted);
    const auto [rms, largest] = distances(ink, taught);
    EXPECT_LE(rms, 0.7) << "even without the best alignment, which the sheet's place may need";
    EXPECT_LE(largest, 1.5) << "stray ink";
    EXPECT_LE(distances(taught, ink).second, 1.5) << "not copied";
  }
  ASSERT_EQ(departed[0].size(), static_cast<std::size_t>(strokes_wanted));
  ASSERT_EQ(departed[1].size(), departed[0].size());
  for (std::size_t k = 0; k < departed[0].size(); ++k)
    EXPECT_LE(std::abs(departed[0][k] - departed[1][k]), 1);
}

void run_and_expect(const std::vector<std::string>& arguments, int strokes_wanted) {
  const Folder folder;
  const std::filesystem::path there = folder / "run";
  const auto end =
      run(folder, "drawing", words({{"--processes", "one", "--run-dir", there.string()}, arguments}));
  ASSERT_EQ(end.status, 0) << end.all();
  EXPECT_EQ(end.last_out(), "run folder: " + there.string());
  expect_good(summary(there));
  expect_good_tables(there, strokes_wanted);
  for (const std::string file : {"config.toml", "events.lcmlog", "messages.log", "operator.script"})
    EXPECT_TRUE(std::filesystem::exists(there / file)) << file;
}

TEST(DrawingTask, CopiesTheArrowWithinAllItsBars) {
  if (kSanitized) GTEST_SKIP() << "too long";
  run_and_expect({}, 6);
}

TEST(DrawingTask, CopiesTwoShortStrokes) {
  const Folder folder;
  run_and_expect({"--drawing", folder.write("lines.svg", lines_svg(2)), "--size", "12"}, 2);
}

TEST(DrawingTask, CopiesWhatAStronglyTremblingHandTeaches) {
  const Folder folder;
  for (const std::string tremor : {"3e-4", "1e-3"})
    run_and_expect({"--drawing", folder.write("lines.svg", lines_svg(2)), "--size", "12", "--set",
                    "sim.hand.tremor=" + tremor, "--set", "sim.hand.tremor_frequency=5"},
                   2);
}

TEST(DrawingTask, LossDuplicationAndDelayOfCommandsDoNotSpoilTheDrawing) {
  const Folder folder;
  std::vector<std::string> arguments{"--processes", "one",
                                     "--run-dir",   (folder / "run").string(),
                                     "--drawing",   folder.write("lines.svg", lines_svg(2)),
                                     "--size",      "12"};
  for (const std::string arm : {"arm1", "arm2"})
    for (const std::string fault : {"loss=0.002", "duplication=0.05", "delay=0.002"})
      arguments.insert(arguments.end(), {"--set", "robots." + arm + ".command_link." + fault});
  const auto end = run(folder, "drawing", arguments);
  ASSERT_EQ(end.status, 0) << end.all();
  // The arms lag behind the orders by what had to be repeated, so only the drawing itself is judged.
  const auto s = summary(folder / "run");
  EXPECT_EQ(s.at("outcome"), "done");
  for (const auto& [key, bar] :
       {std::pair{"copy_rms_mm", 0.5}, std::pair{"copy_max_mm", 1.5}, std::pair{"stray_ink_mm", 0.0},
        std::pair{"strokes_missing", 0.0}, std::pair{"uncovered_mm", 0.0}})
    expect_at_most(s.at("figures"), key, bar);
  std::ifstream messages(folder / "run" / "messages.log");
  const std::string text{std::istreambuf_iterator<char>(messages), {}};
  for (const std::string arm : {"arm1", "arm2"}) {
    EXPECT_NE(text.find(arm + ".command: "), std::string::npos) << text;
    EXPECT_EQ(text.find(arm + ".command: 0 repeated"), std::string::npos) << "duplicates reach the protocol";
  }
}

TEST(DrawingTask, CopiesCurvesArcsTransformsAndDots) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder;
  run_and_expect({"--drawing", folder.write("mixed.svg", kMixed), "--size", "60", "--seed", "5"}, 5);
}

}  // namespace
}  // namespace mrroc::test
