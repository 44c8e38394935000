// The receptors' target, as read from a configuration.
#include "base/target/target_config.hpp"

#include <gtest/gtest.h>

#include "base/fault.hpp"

namespace mrroc {
namespace {

Config parsed(const std::string& text) { return Config::parse(text, "test.toml"); }

TEST(LookedFor, WithoutAWordItIsTheFrameworksOwnBoardAndTag) {
  const Board board = read_board(parsed(""));
  EXPECT_EQ(board.columns, kBoard.columns);
  EXPECT_EQ(board.rows, kBoard.rows);
  EXPECT_EQ(board.square, kBoard.square);
  EXPECT_EQ(board.margin, kBoard.margin);
  const Tag tag = read_tag(parsed(""));
  EXPECT_EQ(tag.id, kTag.id);
  EXPECT_EQ(tag.edge, kTag.edge);
  EXPECT_EQ(tag.margin, kTag.edge / 4);
}

TEST(LookedFor, EveryNumberCanBeSet) {
  const Board board =
      read_board(parsed("[chessboard]\ncolumns = 5\nrows = 4\nsquare = 0.03\nmargin = 0.01\n"));
  EXPECT_EQ(board.columns, 5);
  EXPECT_EQ(board.rows, 4);
  EXPECT_EQ(board.square, 0.03);
  EXPECT_EQ(board.margin, 0.01);
  const Tag tag = read_tag(parsed("[apriltag]\nid = 586\nedge = 0.2\n"));
  EXPECT_EQ(tag.id, 586);
  EXPECT_EQ(tag.edge, 0.2);
  EXPECT_EQ(tag.margin, 0.05) << "a quarter of the edge, unless it is said";
  EXPECT_EQ(read_tag(parsed("[apriltag]\nwhite = 0.01\n")).margin, 0.01);
}

TEST(LookedFor, ABoardThatLooksTheSameUpsideDownIsRefused) {
  for (const auto& [columns, rows] : {std::pair(9, 6), std::pair(3, 4), std::pair(5, 20)})
    EXPECT_NO_THROW((void)read_board(parsed("[chessboard]\ncolumns = " + std::to_string(columns) +
                                            "\nrows = " + std::to_string(rows) + "\n")));
  for (const auto& [columns, rows] : {std::pair(9, 7), std::pair(8, 6), std::pair(6, 9), std::pair(3, 3)})
    EXPECT_THROW((void)read_board(parsed("[chessboard]\ncolumns = " + std::to_string(columns) +
                                         "\nrows = " + std::to_string(rows) + "\n")),
                 FaultError)
        << columns << " x " << rows;
}

TEST(LookedFor, NumbersBeyondTheirBoundsAreRefused) {
  for (const char* const text :
       {"[chessboard]\ncolumns = 1\n", "[chessboard]\ncolumns = 21\n", "[chessboard]\nrows = 2\n",
        "[chessboard]\nrows = 22\n", "[chessboard]\nsquare = 0.001\n", "[chessboard]\nsquare = 1.1\n",
        "[chessboard]\nmargin = -0.1\n", "[chessboard]\nmargin = 1.1\n"})
    EXPECT_THROW((void)read_board(parsed(text)), FaultError) << text;
  for (const char* const text :
       {"[apriltag]\nid = -1\n", "[apriltag]\nid = 587\n", "[apriltag]\nedge = 0.001\n",
        "[apriltag]\nedge = 2.1\n", "[apriltag]\nwhite = -0.1\n", "[apriltag]\nwhite = 1.1\n"})
    EXPECT_THROW((void)read_tag(parsed(text)), FaultError) << text;
}

}  // namespace
}  // namespace mrroc
