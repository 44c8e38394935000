// Texts that are longer than there is room for: cut and wrapped between words.
#include "base/wrap.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mrroc::test {
namespace {

using Lines = std::vector<std::string>;

TEST(Wrap, CutsBetweenWords) {
  EXPECT_EQ(cut("arm1 is busy; stop ends it", 26), "arm1 is busy; stop ends it");
  EXPECT_EQ(cut("arm1 is busy; stop ends it", 25), "arm1 is busy; stop ends..");
  EXPECT_EQ(cut("arm1 is busy; stop ends it", 24), "arm1 is busy; stop..");
  EXPECT_EQ(cut("arm1 is busy; stop ends it", 18), "arm1 is busy..");
  EXPECT_EQ(cut("arm1 is busy; stop ends it", 8), "") << "it would say nothing";
  EXPECT_EQ(cut("a-single-word-without-end", 12), "a-single-w..");
}

TEST(Wrap, KeepsEveryWordAndTheWidth) {
  std::mt19937 random(5);
  for (int k = 0; k < 200; ++k) {
    std::string text;
    for (int word = 0; word < 30; ++word)
      text += (word ? " " : "") + std::string(1 + random() % 9, static_cast<char>('a' + word % 26));
    const int width = static_cast<int>(10 + random() % 70);
    std::string joined;
    for (const std::string& line : wrap(text, width)) {
      EXPECT_LE(static_cast<int>(line.size()), width);
      joined += (joined.empty() ? "" : " ") + line;
    }
    EXPECT_EQ(joined, text);
  }
}

TEST(Wrap, LeavesWhatIsToBeTypedInOnePiece) {
  EXPECT_EQ(wrap("type `ip route add 224.0.0.0/4 dev lo` as root", 20),
            (Lines{"type", "`ip route add 224.0.0.0/4 dev lo`", "as root"}));
  EXPECT_EQ(wrap("", 20), Lines{});
  EXPECT_EQ(wrap("an unended `quote of words", 12), (Lines{"an unended", "`quote of words"}));
}

}  // namespace
}  // namespace mrroc::test
