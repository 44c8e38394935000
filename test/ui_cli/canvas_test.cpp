// The canvas on which the screen is laid out.
#include <gtest/gtest.h>

#include "ui_cli/canvas.hpp"

namespace mrroc::test {
namespace {

using ui::Canvas;

TEST(Canvas, CutsOffWhatIsOutside) {
  Canvas c({2, 5});
  EXPECT_EQ(c.put(0, 3, "abc"), 6);
  c.put(1, -2, "abc");
  c.put(7, 0, "abc");
  c.put_right(1, 5, "de");
  EXPECT_EQ(c.text(), "   ab\nc  de\n");
}

TEST(Canvas, WritesUtf8) {
  Canvas c({1, 4});
  c.put(0, 0, U"aé█😀");
  EXPECT_EQ(c.text(0), "aé█😀");
}

}  // namespace
}  // namespace mrroc::test
