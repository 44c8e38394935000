// Times at which nodes that do not confirm a stop are ended.
#include "mp/stop_escalation.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

using namespace std::chrono_literals;

class Escalation : public testing::Test {
 protected:
  /// The supervisor looks ten times a second for so long, and somebody has not confirmed.
  void wait(std::chrono::milliseconds time) {
    for (const auto end = now_ + time; now_ < end;) stop_.wait(now_ += 100ms);
  }
  StopEscalation::Clock::time_point now_{};
  StopEscalation stop_{now_};
};

TEST_F(Escalation, NodesHaveThreeSecondsToConfirmAndHalfASecondToEnd) {
  wait(2900ms);
  EXPECT_FALSE(stop_.asks());
  wait(100ms);
  EXPECT_TRUE(stop_.asks());
  wait(400ms);
  EXPECT_FALSE(stop_.kills());
  wait(100ms);
  EXPECT_TRUE(stop_.kills());
}

TEST_F(Escalation, ASecondWordLeavesThemHalfASecond) {
  wait(400ms);
  stop_.hurry();
  EXPECT_FALSE(stop_.asks());
  wait(100ms);
  EXPECT_TRUE(stop_.asks());
  EXPECT_FALSE(stop_.kills());
  wait(500ms);
  EXPECT_TRUE(stop_.kills());
}

TEST_F(Escalation, TimeCountsFromTheLastMomentInWhichAllHadConfirmed) {
  wait(2900ms);
  stop_.settle(now_);
  wait(2900ms);
  EXPECT_FALSE(stop_.asks());
}

TEST_F(Escalation, ASupervisorThatWasNotRunHasNotWaited) {
  stop_.wait(now_ += 1h);
  EXPECT_FALSE(stop_.asks());
}

TEST_F(Escalation, NamesThoseWhoWereAskedToEnd) {
  EXPECT_EQ(stop_.unconfirmed(), "");
  stop_.add("edp-arm1");
  stop_.add("simulator");
  EXPECT_EQ(stop_.unconfirmed(), "edp-arm1, simulator");
}

}  // namespace
}  // namespace mrroc::mp
