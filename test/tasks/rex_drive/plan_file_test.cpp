#include "tasks/rex_drive/plan/plan_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "base/fault.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"

namespace mrroc::rex_drive {
namespace {

/// @return what is wrong with the text; empty: nothing
std::string error_of(const std::string& text) {
  try {
    std::ignore = parse_plans(text, "my.txt");
    return {};
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_plan);
    EXPECT_FALSE(e.remedy().empty());
    return e.what();
  }
}

TEST(PlanFile, HasPointsCommentsStartAndPlans) {
  const PlanList list =
      parse_plans("# a way\nstart 1 2 0.5\r\n0 0 # here\n\n  1\t0\nplan\n1 1\n2 1", "my.txt");
  EXPECT_EQ(list.name, "my.txt");
  EXPECT_EQ(list.start.y, 2);
  EXPECT_EQ(list.start.phi, 0.5);
  ASSERT_EQ(list.plans.size(), 2U);
  EXPECT_EQ(list.plans[0], (MapPoints{{0, 0, 3}, {1, 0, 5}}));
  EXPECT_EQ(list.plans[1].back(), (MapPoint{2, 1, 8}));
}

TEST(PlanFile, AMarkOfTheByteOrderBeforeTheTextIsLeftOut) {
  const PlanList list = parse_plans("\xEF\xBB\xBFstart 0 0 1\n0 0\n1 0\n", "my.txt");
  EXPECT_EQ(list.start.phi, 1);
  EXPECT_EQ(list.plans[0].size(), 2U);
  EXPECT_NE(error_of("0 0\n\xEF\xBB\xBF"
                     "1 0\n"),
            "");
}

TEST(PlanFile, SaysOfASinglePointWhereTheWayToItBegins) {
  const auto remedy_of = [](const std::string& text) {
    try {
      std::ignore = parse_plans(text, "my.txt");
    } catch (const FaultError& e) {
      return std::string(e.remedy());
    }
    return std::string("it is driven");
  };
  EXPECT_EQ(remedy_of("start 0.5 1 0\n1 1\n"),
            "write '0.5 1', where the platform stands, on the line before it");
  EXPECT_EQ(remedy_of("0 0\n1 0\nplan\n1 1\n"),
            "write '1 0', where the plan before ends, on the line before it");
  EXPECT_EQ(remedy_of("start 0.5 1 0\n0.5 1\n1 1\n"), "it is driven");
}

TEST(PlanFile, BeginsAtTheOriginUnlessItSaysOtherwise) {
  const PlanList list = parse_plans("0 0\n1 0\n", "my.txt");
  EXPECT_EQ(list.start.x, 0);
  EXPECT_EQ(list.start.phi, 0);
}

TEST(PlanFile, ANumberMayHaveASign) {
  const PlanList list = parse_plans("start +0.5 -1 +1e-1\n+0.5 -0.25\n+1 +2\n", "my.txt");
  EXPECT_EQ(list.start.x, 0.5);
  EXPECT_EQ(list.start.phi, 0.1);
  EXPECT_EQ(list.plans[0][0], (MapPoint{0.5, -0.25, 2}));
  EXPECT_EQ(list.plans[0][1], (MapPoint{1, 2, 3}));
  for (const char* word : {"+", "++1", "+-1", "-+1", "+nought"})
    EXPECT_EQ(error_of(std::string("0 0\n1 ") + word + "\n"),
              fmt::format("my.txt:2: '{}' is not a number", word));
}

TEST(PlanFile, SaysWhatIsWrongAndInWhichLine) {
  EXPECT_EQ(error_of("0 0\n1 zero\n"), "my.txt:2: 'zero' is not a number");
  EXPECT_EQ(error_of("0 0\n1\n"), "my.txt:2: a number is missing");
  EXPECT_EQ(error_of("0 0\n1 2 3\n"), "my.txt:2: '3' is too much");
  EXPECT_EQ(error_of("0 0\nnan 2\n"), "my.txt:2: a number is not finite");
  EXPECT_EQ(error_of("0 0\n1 inf\n"), "my.txt:2: inf is beyond 1000 m");
  EXPECT_EQ(error_of("0 0\n1e9 1\n"), "my.txt:2: 1e9 is beyond 1000 m");
  EXPECT_EQ(error_of("0 0\n1e999 1\n"), "my.txt:2: 1e999 is beyond 1000 m");
  EXPECT_EQ(error_of("0 0\nstart 0 0 0\n1 0\n"), "my.txt:2: 'start' is not the first line");
  EXPECT_EQ(error_of("start 0 0\n1 0\n"), "my.txt:1: a number is missing");
  EXPECT_EQ(error_of("start 0 0 180\n1 0\n"), "my.txt:1: phi 180 is more than a turn");
  EXPECT_EQ(error_of("start 0 0 -6.29\n1 0\n"), "my.txt:1: phi -6.29 is more than a turn");
  EXPECT_EQ(error_of("start 0 0 6.28\n1 0\n2 0\n"), "");
  EXPECT_EQ(error_of("0 0\n"), "my.txt:1: a plan has one point only, and a way has two at least");
  EXPECT_EQ(error_of("# nothing\n"), "my.txt:1: there is no point in it");
  EXPECT_EQ(error_of(""), "my.txt: there is no point in it");
  EXPECT_EQ(error_of("0 0\n1 0\nplan\nplan\n"), "my.txt:4: a plan has no points");
  EXPECT_EQ(error_of("1 1\n1 1.01\n1.02 1\n"), "my.txt:3: the points of a plan are all within 0.05 m");
  EXPECT_EQ(error_of(std::string("0 0\n\0 1\n", 8)), "my.txt: this is not a text");
}

TEST(PlanFile, RefusesTooManyPointsBeforeItHasReadThemAll) {
  std::string text;
  for (int k = 0; k < 1'000'000; ++k) text += k % 2 == 0 ? "0 0\n" : "1 0\n";
  EXPECT_EQ(error_of(text), "my.txt:10001: there are over 10000 points");
}

TEST(PlanFile, SurvivesRandomBytesAndRandomChanges) {
  std::mt19937 random(1);
  const std::string good = "start 0 0 1\n0 0\n1 0.5 # c\nplan\n2 2\n3 3\n";
  for (int n = 0; n < 20'000; ++n) {
    std::string text = good;
    for (int k = 0; k < 3; ++k) text[random() % text.size()] = static_cast<char>(random() % 256);
    try {
      for (const MapPoints& plan : parse_plans(text, "f").plans)
        for (const MapPoint& p : plan) ASSERT_TRUE(std::abs(p.x) <= 1000 && std::abs(p.y) <= 1000);
    } catch (const FaultError& e) {
      ASSERT_EQ(e.fault().code, FaultCode::bad_plan);
    }
  }
}

TEST(PlanFile, MissingFilesAndFoldersAreBadPlans) {
  for (const char* file : {"/no/such/file", "/tmp"}) try {
      std::ignore = load_plans(file);
      ADD_FAILURE() << file;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_plan) << file;
    }
}

TEST(PlanFile, WhatIsWrittenIsReadAgain) {
  for (const std::string_view name : built_in_plan_names()) {
    const PlanList list = built_in_plan(name), read = parse_plans(to_text(list), "again");
    ASSERT_EQ(read.plans.size(), list.plans.size());
    EXPECT_EQ(read.start.phi, list.start.phi);
    for (std::size_t k = 0; k < list.plans.size(); ++k) {
      ASSERT_EQ(read.plans[k].size(), list.plans[k].size());
      for (std::size_t p = 0; p < list.plans[k].size(); ++p)
        EXPECT_EQ(read.plans[k][p].x, list.plans[k][p].x);
    }
  }
}

TEST(PlanFile, ANameWithLinesInItIsStillOneComment) {
  PlanList list = parse_plans("1 0\n2 0\n", "my\n3 0\r\x1b.txt");
  const std::string text = to_text(list);
  EXPECT_TRUE(text.starts_with("# my?3 0??.txt\n")) << text;
  EXPECT_EQ(parse_plans(text, "again").points(), 2U);
}

TEST(PlanFile, LongPlansAreCutAndGoOn) {
  PlanList list;
  std::string text;
  for (int k = 0; k < 150; ++k) text += std::to_string(0.3 * k) + " 0\n";
  list = parse_plans(text, "long");
  ASSERT_EQ(list.plans.size(), 3U);
  EXPECT_EQ(list.points(), 150U);
  const auto plans = to_messages(list, 0.5);
  EXPECT_EQ(plans[0].n, 50);
  EXPECT_EQ(plans[0].ahead, static_cast<int>(kPlanAhead));
  EXPECT_NEAR(plans[0].point[50][0], 0.3 * 50, 1e-9);
  EXPECT_EQ(plans[2].ahead, 0);
}

TEST(PlanFile, APlanOfAnyLengthIsWrittenAndReadAgain) {
  for (std::size_t n = 2; n <= 190; ++n) {
    std::string text;
    for (std::size_t k = 0; k < n; ++k) text += std::to_string(0.3 * static_cast<double>(k)) + " 0\n";
    const PlanList list = parse_plans(text, "long"), read = parse_plans(to_text(list), "again");
    EXPECT_EQ(list.points(), n);
    ASSERT_EQ(read.plans.size(), list.plans.size()) << n;
    for (std::size_t k = 0; k < list.plans.size(); ++k) {
      EXPECT_GE(list.plans[k].size(), 2U) << n;
      EXPECT_LE(list.plans[k].size(), kPointsOfPlan) << n;
      EXPECT_EQ(read.plans[k].size(), list.plans[k].size()) << n;
    }
  }
}

TEST(PlanFile, ALongPlanThatStandsForAPartIsRefusedBeforeItIsWritten) {
  std::string text;
  for (int k = 0; k < 62; ++k) text += "0 0\n";
  EXPECT_EQ(error_of(text + text + "1 0\n"), "my.txt:125: the points of a plan are all within 0.05 m");
}

TEST(PlanFile, TheNameOfAFileCannotWriteLines) {
  PlanList list = built_in_plan("pivot");
  list.name = "a\nstart 1 1 1\r\n7 7";
  EXPECT_EQ(parse_plans(to_text(list), "again").points(), list.points());
}

TEST(PlanFile, APlanThatTurnsBackDoesNotGoOn) {
  const auto plans = to_messages(parse_plans("1 0\n2 0\nplan\n1 0\n0 0\n", "back"), 0.5);
  EXPECT_EQ(plans[0].ahead, 0);
}

TEST(PlanFile, ALegThatIsNotFreeIsToldWithItsLine) {
  const PlanList list = parse_plans("1 0\n2 0\n3 0\n", "my.txt");
  const auto wall = [](const MapPoint&, const MapPoint& to) {
    return to.x > 2.5 ? std::string("a wall") : "";
  };
  try {
    check_legs(list, wall);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(std::string(e.what()), "my.txt:3: the way from (2, 0) to (3, 0): a wall");
  }
}

TEST(PlanFile, AStartThatIsNotFreeIsToldWithItsLine) {
  const auto wall = [](const MapPoint& from, const MapPoint&) {
    return from.x > 2.5 ? std::string("a wall") : "";
  };
  try {
    check_start(parse_plans("# here\nstart 3 1 0\n1 0\n2 0\n", "my.txt"), wall);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(std::string(e.what()), "my.txt:2: the start (3, 1): a wall");
  }
}

TEST(BuiltInPlans, KeepToTheFreePartOfTheRoom) {
  for (const std::string_view name : built_in_plan_names()) {
    const PlanList list = built_in_plan(name);
    for (const MapPoints& plan : list.plans)
      for (const MapPoint& p : plan) {
        EXPECT_LE(std::abs(p.x), 2.2) << name;
        EXPECT_LE(std::abs(p.y), 1.4) << name;
      }
  }
}

TEST(BuiltInPlans, TheLapsOfTheFigureEightComeBackToTheCrossingInEvenSteps) {
  const PlanList list = built_in_plan("figure_eight");
  ASSERT_EQ(list.plans.size(), 2U);
  for (const MapPoints& lap : list.plans) {
    ASSERT_EQ(lap.size(), 24U);
    EXPECT_NEAR(lap.back().x, 0, 1e-9);
    EXPECT_NEAR(lap.back().y, 0, 1e-9);
    MapPoint before{};
    for (const MapPoint& p : lap) {
      EXPECT_NEAR(p.y, p.x * std::sqrt(std::max(0., 1 - p.x * p.x / 4)) * (p.x * p.y < 0 ? -1 : 1), 1e-9);
      EXPECT_NEAR(std::hypot(p.x - before.x, p.y - before.y), 0.5, 0.03);
      before = p;
    }
  }
}

}  // namespace
}  // namespace mrroc::rex_drive
