// Silence of drives and of the control subsystem, in simulated steps.
#include "edp/watchdog.hpp"

#include <gtest/gtest.h>

namespace mrroc::edp {
namespace {

using Verdict = Watchdog::Verdict;

TEST(Watchdog, TripsOnceAfterSoManyStepsWithoutAState) {
  Watchdog dog(50);
  for (int round = 0; round < 3; ++round) {
    for (int k = 1; k < 50; ++k) ASSERT_EQ(dog.no_state(), Verdict::well) << k;
    EXPECT_EQ(dog.no_state(), Verdict::trip);
    EXPECT_EQ(dog.silent(), 50);
    for (int k = 0; k < 1000; ++k) ASSERT_EQ(dog.no_state(), Verdict::well);
    dog.state();
    EXPECT_EQ(dog.silent(), 0);
  }
}

TEST(Watchdog, AStateInTimeStartsTheCountAnew) {
  Watchdog dog(50);
  for (int k = 0; k < 10000; ++k) {
    ASSERT_EQ(dog.no_state(), Verdict::well);
    if (k % 49 == 48) dog.state();
  }
}

TEST(Watchdog, DeceleratesWhenACommandIsMissingAfterOneThatCame) {
  Watchdog dog(50);
  EXPECT_EQ(dog.macrostep(false), Verdict::well);  // there has been none yet
  EXPECT_EQ(dog.macrostep(true), Verdict::well);
  EXPECT_EQ(dog.macrostep(true), Verdict::well);
  EXPECT_EQ(dog.macrostep(false), Verdict::decelerate);
  EXPECT_EQ(dog.macrostep(false), Verdict::well);  // it holds
  EXPECT_EQ(dog.macrostep(true), Verdict::well);
  EXPECT_EQ(dog.macrostep(false), Verdict::decelerate);
  EXPECT_EQ(dog.holds(), 2);
}

}  // namespace
}  // namespace mrroc::edp
