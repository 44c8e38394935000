#include "base/time_chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

namespace mrroc {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TimeChart chart() {
  ChartPanel panel{.title = "arm1", .y_label = "F_z [N]"};
  panel.bands = {{0, 8, 1, "approach"}, {8, 8.3, 2, "settle"}, {8.3, 10, 0, ""}};
  panel.curves = {{.source = "$d using 1:2", .title = "measured", .colour = "#0072b2"},
                  {.source = "4", .colour = std::string(kReferenceColour), .style = CurveStyle::dashes}};
  return {.output = "p.png",
          .title = "a title",
          .from = 0,
          .to = 10,
          .panels = {panel},
          .data = "$d << EOD\n0,1\n10,2\nEOD\n"};
}

TEST(TimeChart, NamesBehavioursWhereThereIsRoomAndTheOthersBelow) {
  const std::string s = time_chart_script(chart());
  EXPECT_TRUE(has(s, "set label '1 approach' at first 4, screen"));
  EXPECT_TRUE(has(s, "set label '2' at first 8.15, screen"));
  EXPECT_TRUE(has(s, "set label 'behaviours:  2 settle' at screen")) << "1 is named above the chart";
}

TEST(TimeChart, SaysBelowWhatAStretchWithoutANumberIsWhereItIsNarrow) {
  TimeChart c = chart();
  c.panels[0].bands = {{0, 0.2, 0, "before the bias"}, {0.2, 10, 1, "approach"}};
  EXPECT_TRUE(has(time_chart_script(c), "'without a number:  before the bias'"));
  c.panels[0].bands[0].to = c.panels[0].bands[1].from = 3;
  EXPECT_FALSE(has(time_chart_script(c), "without a number"));
}

TEST(TimeChart, CutsBehavioursToTheTimeShown) {
  TimeChart c = chart();
  c.from = 8.1;
  const std::string s = time_chart_script(c);
  EXPECT_FALSE(has(s, "approach"));
  EXPECT_TRUE(has(s, "set object rectangle from first 8.1,"));
}

TEST(TimeChart, HasItsLegendAboveTheDataAndNoneInThem) {
  const std::string s = time_chart_script(chart());
  EXPECT_TRUE(has(s, "unset key\n"));
  EXPECT_TRUE(has(s, "set label 'measured' at screen"));
}

TEST(TimeChart, ExplainsItsMarksBelow) {
  TimeChart c = chart();
  c.panels[0].marks = {{"A", 1, 2, "the grasp begins"}, {"B", 3, 2, "the jaws hold"}};
  const std::string s = time_chart_script(c);
  EXPECT_TRUE(has(s, "set label 'A' at first 1, first 2"));
  EXPECT_TRUE(has(s, "'A the grasp begins,  B the jaws hold'"));
}

/// @return all numbers that stand behind the words, in order
std::vector<double> numbers_behind(const std::string& text, const std::string& words) {
  std::vector<double> all;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1))
    all.push_back(std::strtod(text.c_str() + at + words.size(), nullptr));
  return all;
}

TEST(TimeChart, HasItsPanelsOneBelowTheOtherWithRoomForEverythingAround) {
  TimeChart c = chart();
  c.left = 80;
  c.notes = {"one", "two"};
  c.panels.push_back(c.panels[0]);
  c.panels[1].bands.clear();
  c.panels[1].height = 100;
  const std::string s = time_chart_script(c);
  const double height = numbers_behind(s, "set terminal pngcairo size 1200,").at(0);
  EXPECT_NEAR(1200 * numbers_behind(s, "set lmargin at screen ").at(0), 80, 0.01);
  EXPECT_NEAR(1200 * numbers_behind(s, "set rmargin at screen ").at(0), 1172, 0.01);
  const std::vector<double> top = numbers_behind(s, "set tmargin at screen "),
                            bottom = numbers_behind(s, "set bmargin at screen ");
  ASSERT_EQ(top.size(), 2U);
  ASSERT_EQ(bottom.size(), 2U);
  EXPECT_NEAR(height * (top[0] - bottom[0]), 240, 0.05);
  EXPECT_NEAR(height * (top[1] - bottom[1]), 100, 0.05);
  EXPECT_GT(height * (bottom[0] - top[1]), 60) << "tics and a legend";
  EXPECT_LT(height * (bottom[0] - top[1]), 80);
  EXPECT_GT(height * (1 - top[0]), 80) << "title, legend, behaviours";
  EXPECT_LT(height * (1 - top[0]), 110);
  const std::vector<double> across = numbers_behind(s, "at screen "), up = numbers_behind(s, ", screen ");
  for (const double v : across) EXPECT_TRUE(v > 0 && v < 1) << v;
  for (const double v : up) EXPECT_TRUE(v > 0 && v < 1) << v;
  const auto y_of = [&](const std::string& note) {
    return height * numbers_behind(s.substr(s.find("set label '" + note + "'")), ", screen ").at(0);
  };
  EXPECT_NEAR(y_of("one") - y_of("two"), 19, 0.05) << "line by line";
  EXPECT_LT(y_of("one"), height * bottom[1] - 60) << "below the panels' time";
  EXPECT_GT(y_of("behaviours:  2 settle"), 8);
  EXPECT_GT(y_of("arm1"), height * top[0]) << "above its panel";
  EXPECT_LT(y_of("arm1"), y_of("a title"));
}

TEST(TimeChart, ALineStandsWhereABehaviourBeginsUnlessOneStandsThereAlready) {
  TimeChart c = chart();
  // 107.2 pixels per second: the third line would stand 5 pixels from the second one, the fourth stands 10 from it.
  c.panels[0].bands = {
      {0, 2, 1, "a"}, {2, 2.05, 2, "b"}, {2.05, 2.1, 3, "c"}, {2.1, 7, 4, "d"}, {7, 10, 5, "e"}};
  const std::string s = time_chart_script(c);
  EXPECT_EQ(numbers_behind(s, "set arrow from first "), (std::vector<double>{2, 2.1, 7}))
      << "none at the left edge";
  EXPECT_TRUE(has(s, "set arrow from first 7, graph 0 to first 7, graph 1 nohead"));
}

// One pixel per second: lines stand eight pixels apart at least, and words have three pixels to either side.
TEST(TimeChart, LinesAndWordsNeedTheirRoomToThePixel) {
  TimeChart c = chart();
  c.left = 100;
  c.to = 1072;
  c.panels[0].bands = {{0, 100, 1, "a"},       {100, 108, 0, "b"},       {108, 115, 0, "c"},
                       {115, 155, 0, "words"}, {155, 194.9, 0, "never"}, {194.9, 1072, 0, ""}};
  const std::string s = time_chart_script(c);
  EXPECT_EQ(numbers_behind(s, "set arrow from first "), (std::vector<double>{100, 108, 155, 194.9}));
  EXPECT_TRUE(has(s, "set label 'words' at first 135,")) << "34 and 6 pixels of 40";
  EXPECT_FALSE(has(s, "set label 'never'"));
  EXPECT_TRUE(has(s, "'without a number:  b,  c,  never'"));
}

TEST(TimeChart, TheLaneOfBehavioursHasNoGapsAndTwoColoursInTurn) {
  TimeChart c = chart();
  c.panels[0].bands = {
      {-1, 3, 1, "a"}, {3, 4, 0, ""}, {4, 6, 2, "b"}, {6, 12, 3, "c"}, {12, 13, 4, "never seen"}};
  const std::string s = time_chart_script(c);
  EXPECT_EQ(numbers_behind(s, "set object rectangle from first "), (std::vector<double>{0, 3, 4, 6}));
  std::vector<double> ends;
  std::string colours;
  for (std::size_t at = s.find("set object rectangle"); at != std::string::npos;
       at = s.find("set object rectangle", at + 1)) {
    const std::string line = s.substr(at, s.find('\n', at) - at);
    ends.push_back(numbers_behind(line, " to first ").at(0));
    colours += has(line, "#d3dfee") ? 'x' : has(line, "#eaeff6") ? 'o' : '?';
    const std::vector<double> y = numbers_behind(line, "screen ");
    ASSERT_EQ(y.size(), 2U);
    const double height = numbers_behind(s, "set terminal pngcairo size 1200,").at(0);
    EXPECT_NEAR(height * (y[1] - y[0]), 18, 0.05);
  }
  EXPECT_EQ(ends, (std::vector<double>{3, 4, 6, 10}));
  EXPECT_EQ(colours, "xoxo");
  EXPECT_FALSE(has(s, "never seen"));
  EXPECT_TRUE(has(s, "set label '1 a' at first 1.5,")) << "in the middle of what is shown of it";
  EXPECT_TRUE(has(s, "set label '3 c' at first 8,"));
}

TEST(TimeChart, ALegendEndsAtTheRightEdgeAndBeginsWithItsStroke) {
  TimeChart c = chart();
  c.panels[0].bands.clear();
  c.panels[0].curves = {{.source = "1", .title = "ab", .colour = "#111111"},
                        {.source = "2", .title = "c{d}", .colour = "#222222", .style = CurveStyle::dashes},
                        {.source = "3", .title = "", .colour = "#333333"}};
  const std::string s = time_chart_script(c);
  const auto x_of = [&](const std::string& what) {
    return 1200 * numbers_behind(s.substr(s.find(what)), " at screen ").at(0);
  };
  // 8 pixels per character that is shown, 26 of a stroke, 6 and 22 between.
  EXPECT_NEAR(x_of("set label 'c{d}'"), 1172 - 2 * 8, 0.1);
  EXPECT_NEAR(x_of("set label 'ab'"), 1172 - 2 * 8 - 6 - 26 - 22 - 2 * 8, 0.1);
  const std::vector<double> from = numbers_behind(s, "set arrow from screen "),
                            to = numbers_behind(s, " to screen ");
  ASSERT_EQ(from.size(), 3U) << "a stroke, and two of a dashed one";
  ASSERT_EQ(to.size(), 3U);
  EXPECT_NEAR(1200 * (to[0] - from[0]), 26, 0.1);
  EXPECT_NEAR(1200 * to[0] + 6, x_of("set label 'ab'"), 0.1);
  EXPECT_NEAR(1200 * (to[2] - from[1]), 26, 0.1);
  EXPECT_NEAR(1200 * (to[1] - from[1]), 10.4, 0.1);
  EXPECT_NEAR(1200 * (to[2] - from[2]), 10.4, 0.1);
  EXPECT_FALSE(has(s, "#333333' front")) << "without a title it is not there";
  EXPECT_NEAR(x_of("set label 'arm1'"), 100, 0.1) << "the panel's title at the left";
}

TEST(TimeChart, NotesAreAsManyLinesAsTheyNeedAndNoneIsBroken) {
  TimeChart c = chart();
  c.panels[0].bands.clear();
  const auto height = [&] {
    return numbers_behind(time_chart_script(c), "set terminal pngcairo size 1200,").at(0);
  };
  const double bare = height();
  c.notes = {"a note"};
  EXPECT_EQ(height() - bare, 19);
  for (int k = 0; k < 20; ++k)
    c.panels[0].marks.push_back({std::string(1, static_cast<char>('A' + k)), 0.3 * k, 1, "words of a mark"});
  const std::string s = time_chart_script(c);
  EXPECT_EQ(height() - bare, 19 * (1 + 3)) << "157 characters have room in a line";
  EXPECT_TRUE(has(s, "G words of a mark,  ' at screen"))
      << "seven are 139 characters, and eight are too many";
  EXPECT_TRUE(has(s, "set label 'H words of a mark,  I words of a mark,"));
  EXPECT_TRUE(has(s, "S words of a mark,  T words of a mark' at screen"));
  c.panels[0].marks[3].words.clear();
  EXPECT_FALSE(has(time_chart_script(c), "D words"));
}

TEST(TimeChart, DrawsEveryCurveInItsStyleColourAndWidth) {
  TimeChart c = chart();
  c.panels[0].curves = {
      {.source = "1", .title = "a", .colour = "#111111"},
      {.source = "2", .title = "b", .colour = "#222222", .style = CurveStyle::dashes, .width = 3},
      {.source = "3", .title = "c", .colour = "#333333", .style = CurveStyle::points, .width = 0.5},
      {.source = "4", .title = "d", .colour = "#444444", .style = CurveStyle::steps, .width = 2.5}};
  const std::string s = time_chart_script(c);
  EXPECT_TRUE(has(s,
                  "plot 1 with lines lw 1.6 lc rgb '#111111' notitle, \\\n"
                  "  2 with lines lw 3 lc rgb '#222222' dt 2 notitle, \\\n"
                  "  3 with points pt 7 ps 0.5 lc rgb '#333333' notitle, \\\n"
                  "  4 with steps lw 2.5 lc rgb '#444444' notitle, \\\n"
                  "  NaN notitle\n"))
      << s;
  EXPECT_TRUE(has(s, "nohead lw 2 lc rgb '#111111'")) << "in the legend no line is too thin to be seen";
  EXPECT_TRUE(has(s, "nohead lw 3 lc rgb '#222222'"));
  EXPECT_TRUE(has(s, "point pt 7 ps 0.8 lc rgb '#333333'"));
  EXPECT_TRUE(has(s, "nohead lw 2.5 lc rgb '#444444'"));
}

TEST(TimeChart, ALegendThatIsTooWideHasSeveralRows) {
  TimeChart c = chart();
  const auto gap = [&] {
    const std::string s = time_chart_script(c);
    return numbers_behind(s, "set terminal pngcairo size 1200,").at(0) *
           (1 - numbers_behind(s, "set tmargin at screen ").at(0));
  };
  const double one = gap();
  for (int k = 0; k < 12; ++k)
    c.panels[0].curves.push_back({.source = "1", .title = std::string(30, 'x'), .colour = "#111111"});
  EXPECT_NEAR(gap() - one, 3 * 26, 0.05) << "thirteen titles, four in a row";
  c.panels[0].curves.back().title = "last";
  const std::string s = time_chart_script(c);
  const auto y_of = [&](const std::string& title) {
    return numbers_behind(s.substr(s.find("set label '" + title + "'")), ", screen ").at(0) *
           numbers_behind(s, "set terminal pngcairo size 1200,").at(0);
  };
  EXPECT_NEAR(y_of("measured") - y_of("last"), 3 * 26, 0.05) << "a row below the other";
}

TEST(TimeChart, IsDrawnByGnuplotWithoutAWarning) {
  if (std::system("gnuplot --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "gnuplot is not installed";
  std::string pattern = (std::filesystem::temp_directory_path() / "chart.XXXXXX").string();
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  TimeChart c = chart();
  c.title = gnuplot_literal("it's {odd}_^ $x");
  c.panels.push_back(c.panels[0]);
  c.panels[1].curves.clear();
  c.panels[1].y = {0, 1};
  std::ofstream(folder / "p.gp") << time_chart_script(c);
  EXPECT_EQ(std::system(("cd " + folder.string() + " && gnuplot p.gp > log 2>&1").c_str()), 0);
  EXPECT_EQ(std::filesystem::file_size(folder / "log"), 0U);
  EXPECT_GT(std::filesystem::file_size(folder / "p.png"), 1000U);
  std::filesystem::remove_all(folder);
}

TEST(GnuplotText, ShowsWhatIsMeantAsItIs) {
  EXPECT_EQ(gnuplot_quoted("it's\nso"), "'it''s?so'");
  EXPECT_EQ(gnuplot_literal("a_b^c{d}"), "a\\_b\\^c\\{d\\}");
}

TEST(AxisRange, HoldsItsValuesWithRoomAndIsNeverEmpty) {
  AxisRange r;
  EXPECT_TRUE(r.empty());
  EXPECT_LT(r.with_room().low, r.with_room().high);
  for (const double v : {3.0, std::nan(""), HUGE_VAL}) r.add(v);
  EXPECT_LT(r.with_room().low, 3);
  EXPECT_GT(r.with_room().high, 3);
  EXPECT_EQ(r.text(), "[3:3]");
  EXPECT_NEAR(r.with_room().low, 2.7, 1e-12) << "a tenth around a single value";
  EXPECT_NEAR(r.with_room().high, 3.3, 1e-12);
  AxisRange zero;
  zero.add(0);
  EXPECT_FALSE(zero.empty());
  EXPECT_EQ(zero.with_room().text(), "[-0.001:0.001]");
  EXPECT_EQ(AxisRange{}.with_room().text(), "[-1:1]");
  AxisRange below;
  below.add(-2);
  below.add(2);
  EXPECT_NEAR(below.with_room().low, -2.24, 1e-12);
  EXPECT_NEAR(below.with_room().high, 2.24, 1e-12);
  EXPECT_EQ(below.text(), "[-2:2]");
  r.add(5);
  EXPECT_NEAR(r.with_room(0.1, 0.2).low, 2.8, 1e-12);
  EXPECT_NEAR(r.with_room(0.1, 0.2).high, 5.4, 1e-12);
}

}  // namespace
}  // namespace mrroc
