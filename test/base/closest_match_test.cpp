#include "base/closest_match.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mrroc::test {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndExchanges) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("stifness", "stiffness"), 1U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("clokc", "clock"), 1U);
}

TEST(EditDistance, IsSymmetricAndZeroOnlyForEqualWords) {
  std::mt19937 random(1);
  const auto word = [&] {
    std::string result(random() % 8, 'a');
    for (char& c : result) c = static_cast<char>('a' + random() % 3);
    return result;
  };
  for (int k = 0; k < 2000; ++k) {
    const std::string a = word();
    const std::string b = word();
    EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
    EXPECT_EQ(edit_distance(a, b) == 0, a == b);
    EXPECT_LE(edit_distance(a, b), std::max(a.size(), b.size()));
  }
}

TEST(ClosestMatch, IsTheClosestWordOrNone) {
  const WordSet words{"build", "test", "bench", "clean"};
  EXPECT_EQ(closest_match("biuld", words), "build");
  EXPECT_EQ(closest_match("tests", words), "test");
  EXPECT_EQ(closest_match("bench", words), "bench");
  EXPECT_EQ(closest_match("dinosaur", words), "");
  EXPECT_EQ(closest_match("x", {}), "");
}

TEST(ClosestMatch, OfWordsThatAreAsNearBeginsLikeTheWordForLongest) {
  EXPECT_EQ(closest_match("--sped", {"--seed", "--speed"}), "--speed");
  EXPECT_EQ(closest_match("--sed", {"--seed", "--set"}), "--seed") << "the first of equals";
}

TEST(ClosestMatch, IsTheShortestWordThatWasNotFinished) {
  const WordSet words{"start", "status", "statistics", "xe"};
  EXPECT_EQ(closest_match("stat", words), "status");
  EXPECT_EQ(closest_match("stati", words), "statistics");
  EXPECT_EQ(closest_match("st", words), "start");
  EXPECT_EQ(closest_match("x", words), "xe") << "one letter says nothing, but is near";
}

TEST(ClosestMatch, OfOrdersIsOneThatHardlyAnybodyCanMeanOtherwise) {
  const WordSet queries{"doctor", "explain", "list", "log", "manual", "status", "view", "watch"};
  const WordSet orders{"start", "stop", "pause", "resume", "trigger", "emergency_stop"};
  const auto near = [&](const char* word) { return closest_match(word, queries, orders); };
  for (const char* word : {"stat", "state", "stats", "sta", "st", "staus"})
    EXPECT_EQ(near(word), "status") << word;
  EXPECT_EQ(near("show"), "") << "two letters from stop";
  EXPECT_EQ(near("step"), "stop") << "one slip";
  EXPECT_EQ(near("lst"), "list");
  EXPECT_EQ(near("strat"), "start");
  EXPECT_EQ(near("star"), "start");
  EXPECT_EQ(near("emergency-stop"), "emergency_stop");
  EXPECT_EQ(near("emerg"), "emergency_stop");
  EXPECT_EQ(near("pasue"), "pause");
}

}  // namespace
}  // namespace mrroc::test
