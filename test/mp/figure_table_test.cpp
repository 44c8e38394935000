#include "mp/figure_table.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

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
  EXPECT_EQ(line_of(figures, "error"), "error [mm] - 0.1 <= 0.5 ok");
  EXPECT_EQ(line_of(figures, "force"), "force [N] - - 1 +- 0.05");
  EXPECT_EQ(figure_table(figures, kKnown, kColumns).find("nan"), std::string::npos);
}

TEST(FigureTable, ARunThatDidNotComeToItsEndIsNotJudged) {
  const std::map<std::string, Figure> figures{{"error_mm", std::vector<double>{0.1, 0.6}}};
  const std::string table = figure_table(figures, kKnown, kColumns, false);
  EXPECT_EQ(table.find("OK"), std::string::npos) << table;
  EXPECT_NE(table.find("<= 0.5"), std::string::npos) << table;
}

TEST(FigureTable, AFigureThatNobodyKnowsComesLastUnderItsKey) {
  const std::map<std::string, Figure> figures{{"a_new_one", 3.0}, {"nodes", 412.0}};
  const std::string table = figure_table(figures, kKnown, kColumns);
  EXPECT_EQ(line_of(figures, "a_new_one"), "a_new_one 3");
  EXPECT_LT(table.find("nodes"), table.find("a_new_one"));
}

}  // namespace
}  // namespace mrroc::mp
