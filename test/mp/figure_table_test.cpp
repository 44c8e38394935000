#include "mp/figure_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace mrroc::mp {
namespace {

constexpr std::array kKnown{
    FigureInfo{.key = "error_mm", .words = "error", .unit = "mm", .high = 0.5},
    FigureInfo{.key = "force_N", .words = "force", .unit = "N", .low = 0.95, .high = 1.05},
    FigureInfo{.key = "skew", .words = "skew", .unit = "", .low = 0, .high = 0},
    FigureInfo{.key = "factor", .words = "factor", .unit = "", .low = 5},
    FigureInfo{.key = "nodes", .words = "nodes", .unit = ""},
};
constexpr std::array<std::string_view, 2> kColumns{"arm 1", "arm 2"};

/// @return the line of the table that begins with these words, blanks squeezed
std::string line_of(const std::map<std::string, Figure>& figures, const std::string& words) {
  std::istringstream table(figure_table(figures, kKnown, kColumns));
  for (std::string line; std::getline(table, line);) {
    std::istringstream in(line);
    std::string word, squeezed;
    while (in >> word) squeezed += (squeezed.empty() ? "" : " ") + word;
    if (squeezed.starts_with(words)) return squeezed;
  }
  return "(none)";
}

TEST(FigureTable, SaysInWordsWhatIsWanted) {
  EXPECT_EQ(wanted(kKnown[0]), "<= 0.5");
  EXPECT_EQ(wanted(kKnown[1]), "1 +- 0.05");
  EXPECT_EQ(wanted(kKnown[2]), "0");
  EXPECT_EQ(wanted(kKnown[3]), ">= 5");
  EXPECT_EQ(wanted(kKnown[4]), "");
}

TEST(FigureTable, TellsOfEachFigureWhetherItIsAsWanted) {
  const std::map<std::string, Figure> figures{{"error_mm", std::vector<double>{0.0123456, 0.6}},
                                              {"force_N", std::vector<double>{1.002, 0.951}},
                                              {"skew", 0.0},
                                              {"factor", 4.0},
                                              {"nodes", 412.0}};
  EXPECT_EQ(line_of(figures, "figure"), "figure arm 1 arm 2 wanted");
  EXPECT_EQ(line_of(figures, "error"), "error [mm] 0.01235 0.6 <= 0.5 NOT OK");
  EXPECT_EQ(line_of(figures, "force"), "force [N] 1.002 0.951 1 +- 0.05 ok");
  EXPECT_EQ(line_of(figures, "skew"), "skew 0 0 ok");
  EXPECT_EQ(line_of(figures, "factor"), "factor 4 >= 5 NOT OK");
  EXPECT_EQ(line_of(figures, "nodes"), "nodes 412");
}

TEST(FigureTable, WhatCouldNotBeMeasuredIsADash) {
  const std::map<std::string, Figure> figures{{"error_mm", std::vector<double>{std::nan(""), 0.1}},
                                              {"force_N", std::vector<double>{std::nan(""), HUGE_VAL}}};
  EXPECT_EQ(line_of(figures, "error"), "error [mm] - 0.1 <= 0.5 NOT OK");
  EXPECT_EQ(line_of(figures, "force"), "force [N] - - 1 +- 0.05 NOT OK");
  EXPECT_EQ(figure_table(figures, kKnown, kColumns).find("nan"), std::string::npos);
}

TEST(FigureTable, ARunThatDidNotComeToItsEndIsNotJudged) {
  const std::map<std::string, Figure> figures{{"error_mm", std::vector<double>{0.1, 0.6}}};
  const std::string table = figure_table(figures, kKnown, kColumns, false);
  EXPECT_EQ(table.find("OK"), std::string::npos) << table;
  EXPECT_NE(table.find("<= 0.5"), std::string::npos) << table;
}

TEST(FigureTable, AFigureOfTheStopIsJudgedInARunThatDidNotComeToItsEnd) {
  const std::vector<FigureInfo> known{
      {.key = "stop", .words = "steps", .unit = "", .high = 100, .always = true}};
  EXPECT_NE(figure_table({{"stop", 101.}}, known, {}, false).find("NOT OK"), std::string::npos);
  EXPECT_EQ(figure_table({{"stop", 100.}}, known, {}, false).find("NOT OK"), std::string::npos);
}

TEST(FigureTable, AFigureWithMoreNumbersThanHeadingsDoesNotReachIntoWhatIsWanted) {
  const std::vector<FigureInfo> known{{.key = "P", .words = "mass centre", .unit = "m"},
                                      {.key = "w", .words = "weight", .unit = "N", .high = 3}};
  const std::vector<std::string_view> columns{"arm1"};
  const std::string table = figure_table({{"P", std::vector{1., 2., 3.}}, {"w", 2.5}}, known, columns);
  std::istringstream lines(table);
  std::string heading, P, w;
  std::getline(lines, heading), std::getline(lines, P), std::getline(lines, w);
  EXPECT_LE(P.size(), heading.find("wanted")) << table;
  EXPECT_EQ(w.find("<= 3"), heading.find("wanted")) << table;
}

TEST(FigureVerdict, NamesEachFigureThatIsNotAsWanted) {
  std::map<std::string, Figure> figures{{"error_mm", std::vector<double>{0.0123456, 29.1}},
                                        {"force_N", std::vector<double>{0.9, 1.1}},
                                        {"skew", 0.0},
                                        {"nodes", 412.0}};
  FigureVerdict v = judge(figures, kKnown);
  EXPECT_EQ(v.judged, 3U);
  EXPECT_EQ(to_string(v),
            "2 of 3 figures missed what is wanted: error_mm 29.1 (wanted <= 0.5), force_N 0.9 and 1.1 "
            "(wanted 1 +- 0.05)");
  figures["error_mm"] = 0.5;
  figures["force_N"] = 1.0;
  v = judge(figures, kKnown);
  EXPECT_TRUE(v.missed.empty());
  EXPECT_EQ(to_string(v), "all 3 figures are as wanted");
  figures.erase("skew");
  EXPECT_EQ(to_string(judge(figures, kKnown)), "both figures are as wanted");
  figures.erase("force_N");
  EXPECT_EQ(to_string(judge(figures, kKnown)), "the figure is as wanted");
}

TEST(FigureVerdict, DoesNotJudgeWhatIsNotWantedOrDoesNotApply) {
  const FigureVerdict v = judge({{"nodes", std::nan("")}, {"unknown", 1.0}}, kKnown);
  EXPECT_EQ(v.judged, 0U);
  EXPECT_EQ(to_string(v), "");
}

TEST(FigureVerdict, WhatShouldHaveBeenMeasuredAndWasNotIsMissed) {
  const FigureVerdict v = judge({{"error_mm", std::vector<double>{0.1, std::nan("")}},
                                 {"force_N", std::vector<double>{0.9, HUGE_VAL}},
                                 {"skew", std::nan("")},
                                 {"factor", 6.0}},
                                kKnown);
  EXPECT_EQ(
      to_string(v),
      "3 of 4 figures missed what is wanted: error_mm not measured (wanted <= 0.5), force_N 0.9 and not "
      "measured (wanted 1 +- 0.05), skew not measured (wanted 0)");
}

TEST(FigureTable, AFigureThatNobodyKnowsComesLastUnderItsKey) {
  const std::map<std::string, Figure> figures{{"a_new_one", 3.0}, {"nodes", 412.0}};
  const std::string table = figure_table(figures, kKnown, kColumns);
  EXPECT_EQ(line_of(figures, "a_new_one"), "a_new_one 3");
  EXPECT_LT(table.find("nodes"), table.find("a_new_one"));
}

TEST(FigureTable, HasTheValuesBelowTheirColumnsAndNoBlanksAtTheEndOfALine) {
  const std::map<std::string, Figure> figures{
      {"nodes", std::vector<double>{1, 2, 3}}, {"skew", 0.0}, {"x", 5.0}};
  const std::string table = figure_table(figures, kKnown, kColumns);
  EXPECT_EQ(line_of(figures, "nodes"), "nodes 1 2 3") << "more values than columns";
  std::istringstream in(table);
  std::string first, line;
  std::getline(in, first);
  const std::size_t column = first.find("arm 1") + std::string("arm 1").size();
  int lines = 0;
  for (; std::getline(in, line); ++lines) {
    EXPECT_NE(line.back(), ' ') << line;
    EXPECT_NE(line.at(column - 1), ' ') << "flush with its heading: " << line;
  }
  EXPECT_EQ(lines, 3);
  EXPECT_EQ(first.find("  figure"), 0U);
  EXPECT_TRUE(first.ends_with("wanted"));
}

TEST(FigureTable, AFigureIsFoundByItsKey) {
  const TaskFigures figures{{{.key = "a", .words = "a", .unit = ""}, 1.0},
                            {{.key = "b", .words = "b", .unit = ""}, 2.0}};
  EXPECT_EQ(std::get<double>(figure(figures, "b")), 2);
  EXPECT_THROW(std::ignore = figure(figures, "c"), std::out_of_range);
}

TEST(FigureTable, WhatAFigureMeansIsFoundByItsKey) {
  ASSERT_NE(info_of("skew", kKnown), nullptr);
  EXPECT_EQ(info_of("skew", kKnown)->key, "skew");
  EXPECT_EQ(info_of("skewed", kKnown), nullptr);
}

TEST(FigureVerdict, BoundsAreAsWantedAndWhatIsBeyondIsNot) {
  const auto missed = [](const char* key, double value) {
    return !judge({{key, value}}, kKnown).missed.empty();
  };
  EXPECT_FALSE(missed("force_N", 0.95));
  EXPECT_FALSE(missed("force_N", 1.05));
  EXPECT_TRUE(missed("force_N", 0.9499));
  EXPECT_TRUE(missed("force_N", 1.0501));
  EXPECT_FALSE(missed("factor", 5));
  EXPECT_TRUE(missed("factor", 4.999));
  EXPECT_FALSE(missed("skew", 0));
  EXPECT_TRUE(missed("skew", 1));
  EXPECT_TRUE(missed("skew", -1));
}

}  // namespace
}  // namespace mrroc::mp
