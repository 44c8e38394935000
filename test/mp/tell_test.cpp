// Lines of progress on a terminal that is too narrow for them.
#include "mp/tell.hpp"

#include <gtest/gtest.h>

namespace mrroc::mp {
namespace {

TEST(Tell, ALineOfProgressBreaksBetweenWordsAndGoesOnBehindItsTime) {
  EXPECT_EQ(folded("    0.50 s  solution: 3 turns: R U' F2", 28),
            "    0.50 s  solution: 3\n"
            "            turns: R U' F2");
}

TEST(Tell, ALineWithoutTimeGoesOnIndented) {
  EXPECT_EQ(folded("press, session press-1, seed 1", 20),
            "press, session\n"
            "  press-1, seed 1");
}

TEST(Tell, ALineThatFitsStaysAsItIs) {
  const std::string line = "    0.50 s  arm1  m = 1  approach";
  EXPECT_EQ(folded(line, static_cast<int>(line.size())), line);
  EXPECT_EQ(folded(line, 0), line) << "no terminal";
}

TEST(Tell, AWordThatIsWiderThanTheTerminalIsKept) {
  EXPECT_EQ(folded("run folder: runs/press-20260314-101500", 12),
            "run\n  folder:\n  runs/press-20260314-101500");
}

}  // namespace
}  // namespace mrroc::mp
