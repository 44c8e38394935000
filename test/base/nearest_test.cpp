#include "base/nearest.hpp"

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

TEST(Nearest, IsTheClosestWordOrNone) {
  const WordSet words{"build", "test", "bench", "clean"};
  EXPECT_EQ(nearest("biuld", words), "build");
  EXPECT_EQ(nearest("tests", words), "test");
  EXPECT_EQ(nearest("bench", words), "bench");
  EXPECT_EQ(nearest("dinosaur", words), "");
  EXPECT_EQ(nearest("x", {}), "");
}

}  // namespace
}  // namespace mrroc::test
