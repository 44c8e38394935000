// A run that stands still, and the notices to a person.
#include "mp/wait_notice.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

using namespace std::chrono_literals;

TEST(WaitNotice, ComesAfterTenSecondsAndThenAfterTwiceAsLongEachTime) {
  WaitNotice notice;
  const WaitNotice::Clock::time_point begin{1000s};
  std::vector<int> told;
  for (int s = 0; s <= 200; ++s)
    if (const auto waited = notice.look(begin + s * 1s, 0, "m = 1", true)) {
      EXPECT_EQ(waited->count(), s);
      told.push_back(s);
    }
  EXPECT_EQ(told, (std::vector{10, 20, 40, 80, 160}));
}

TEST(WaitNotice, ComesNotForARunThatGoesOn) {
  WaitNotice notice;
  const WaitNotice::Clock::time_point begin{1000s};
  for (int s = 0; s < 1000; ++s) EXPECT_FALSE(notice.look(begin + s * 1s, s, std::to_string(s / 10), true));
  EXPECT_FALSE(notice.look(begin + 999s + 1ms, 1000, "99", true));
  EXPECT_TRUE(notice.look(begin + 1000s, 1000, "99", true)) << "the first notice again";
}

TEST(WaitNotice, ABehaviourThatNoOrderEndsMayLastHalfAMinuteOfAnArmsTime) {
  for (const double speed : {1.0, 100.0}) {
    WaitNotice notice;
    const WaitNotice::Clock::time_point begin{1000s};
    int first = 0;
    for (int s = 0; s <= 60 && first == 0; ++s)
      if (notice.look(begin + s * 1s, speed * s, "m = 1", false)) first = s;
    EXPECT_EQ(first, speed == 1 ? 30 : 10) << speed;
  }
}

TEST(WaitText, NamesTheBehaviourItsEndAndTheOrder) {
  const Wait wait{.m = 3,
                  .behaviour = "lead to the start",
                  .until = "the operator's trigger",
                  .command = "trigger",
                  .order = "trigger 2"};
  EXPECT_EQ(what(wait), "m = 3, lead to the start, goes on until: the operator's trigger");
  EXPECT_EQ(to_string(wait),
            "m = 3, lead to the start, goes on until: the operator's trigger; the run waits for trigger 2: "
            "`ui_cli trigger`");
}

TEST(WaitText, TellsOfTheScript) {
  Wait wait{.m = 0,
            .behaviour = "wait for start",
            .until = "start",
            .command = "start",
            .order = "start",
            .scripted = true};
  EXPECT_NE(to_string(wait).find("; the script has ended; the run waits for start: `ui_cli start`"),
            std::string::npos)
      << to_string(wait);
  wait.next_in_script = 500;
  EXPECT_NE(to_string(wait).find("; the script's next order is for macrostep 500;"), std::string::npos)
      << to_string(wait);
}

TEST(WaitText, WhereNoOrderWouldHelpItNamesTheStop) {
  EXPECT_EQ(to_string({.m = 1, .behaviour = "approach", .until = "F_z above 3.6 N"}),
            "m = 1, approach, goes on until: F_z above 3.6 N; `ui_cli stop` ends the run");
  EXPECT_EQ(to_string({}), "the first behaviour has not begun; `ui_cli stop` ends the run");
}

TEST(WaitNotice, BothTimesAreCountedFromTheLastChangeAndToTheMoment) {
  WaitNotice notice;
  const WaitNotice::Clock::time_point begin{1000s};
  EXPECT_FALSE(notice.look(begin, 100, "m = 1", false));
  EXPECT_FALSE(notice.look(begin + 60s, 160, "m = 2", false)) << "it has just changed";
  EXPECT_FALSE(notice.look(begin + 69999ms, 190, "m = 2", false));
  EXPECT_FALSE(notice.look(begin + 70s, 189.9, "m = 2", false));
  const auto waited = notice.look(begin + 70s, 190, "m = 2", false);
  ASSERT_TRUE(waited);
  EXPECT_EQ(*waited, 10s);
  EXPECT_FALSE(notice.look(begin + 79999ms, 300, "m = 2", false));
  EXPECT_EQ(notice.look(begin + 83500ms, 300, "m = 2", false), 23s) << "whole seconds";
  EXPECT_FALSE(notice.look(begin + 105999ms, 300, "m = 2", false));
  EXPECT_EQ(notice.look(begin + 106s, 300, "m = 2", false), 46s) << "twice 23";
}

}  // namespace
}  // namespace mrroc::mp
