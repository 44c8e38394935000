// Lattices of dark squares that are no board: on the board that was found they do not matter, elsewhere they do.
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "vsp/chessboard/board_search.hpp"

namespace mrroc::vsp::chessboard {
namespace {

constexpr Board kLarge{.columns = 4, .rows = 3};
constexpr int kSquare = 100, kDark = 30, kLight = 230;
const cv::Point kAt(260, 240);  // the upper left of its squares

/// The board, with a pattern of 5 x 5 squares of 8 pixels around a place.
SearchResult with_pattern_at(const cv::Point& middle) {
  cv::Mat grey(960, 1040, CV_8U, cv::Scalar(kLight));
  for (int r = 0; r <= kLarge.rows; ++r)
    for (int c = 0; c <= kLarge.columns; ++c)
      if ((r + c) % 2 == 0)
        cv::rectangle(grey, cv::Rect(kAt.x + c * kSquare, kAt.y + r * kSquare, kSquare, kSquare), kDark,
                      cv::FILLED);
  const cv::Rect pattern(middle.x - 24, middle.y - 24, 48, 48);
  cv::rectangle(grey, pattern, kLight, cv::FILLED);
  for (int r = 0; r < 5; ++r)
    for (int c = 0; c < 5; ++c)
      if ((r + c) % 2 == 0)
        cv::rectangle(grey, cv::Rect(middle.x - 20 + 8 * c, middle.y - 20 + 8 * r, 8, 8), kDark, cv::FILLED);
  cv::GaussianBlur(grey, grey, {}, 0.6);
  return find_boards(grey, {0, 0, grey.cols, grey.rows, 1, 31, 6, {}}, kLarge);
}

TEST(UnresolvedLattice, LiesBetweenTheInnerCornersOrItMayBeAnotherBoard) {
  int inside = 0, outside = 0;
  for (int r = -1; r <= kLarge.rows + 1; ++r)
    for (int c = -1; c <= kLarge.columns + 1; ++c) {
      const bool light = (r + c) % 2 != 0;
      const bool on_board = r >= 0 && r <= kLarge.rows && c >= 0 && c <= kLarge.columns;
      if (on_board && !light) continue;
      // The light margin must be seen in its middle: beside the board the pattern lies farther out.
      const auto away = [](int n, int last) { return n < 0 ? -60 : n > last ? 60 : 0; };
      const SearchResult result =
          with_pattern_at({kAt.x + c * kSquare + kSquare / 2 + away(c, kLarge.columns),
                           kAt.y + r * kSquare + kSquare / 2 + away(r, kLarge.rows)});
      ASSERT_EQ(result.boards.size(), 1U) << r << ' ' << c;
      const bool between = r > 0 && r < kLarge.rows && c > 0 && c < kLarge.columns;
      EXPECT_EQ(result.unresolved, !between) << r << ' ' << c;
      ++(between ? inside : outside);
    }
  EXPECT_GT(inside, 1);
  EXPECT_GT(outside, 10);
}

}  // namespace
}  // namespace mrroc::vsp::chessboard
