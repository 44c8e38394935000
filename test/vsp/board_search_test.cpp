// Boards that the search keeps, counts and gives up, on drawn boards that face the camera.
#include "vsp/chessboard/board_search.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

namespace mrroc::vsp::chessboard {
namespace {

constexpr int kLight = 230, kDark = 30, kTable = 120;

cv::Mat table(int width, int height, int grey = kTable) { return {height, width, CV_8U, cv::Scalar(grey)}; }

/// Draws squares, the upper left one dark, with a light margin around them.
void draw_squares(cv::Mat& grey, int columns, int rows, cv::Point at, int square, int dark = kDark,
                  int light = kLight) {
  cv::rectangle(grey, cv::Rect(at.x - square, at.y - square, (columns + 2) * square, (rows + 2) * square),
                light, cv::FILLED);
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      if ((r + c) % 2 == 0)
        cv::rectangle(grey, cv::Rect(at.x + c * square, at.y + r * square, square, square), dark, cv::FILLED);
}
void draw(cv::Mat& grey, const Board& board, cv::Point at, int square, int dark = kDark, int light = kLight) {
  draw_squares(grey, board.columns + 1, board.rows + 1, at, square, dark, light);
}
cv::Mat blurred(const cv::Mat& grey, double blur = 0.7) {
  cv::Mat result;
  cv::GaussianBlur(grey, result, {}, blur);
  return result;
}
Search everywhere(const cv::Mat& grey, int block = 61) {
  return {0, 0, grey.cols, grey.rows, 1, block, 6, {}};
}

void expect_corners(const InnerCorners& found, const Board& board, cv::Point at, int square,
                    double tolerance = 0.1) {
  ASSERT_EQ(found.pixels.size(), static_cast<std::size_t>(board.corners()));
  for (int r = 0; r < board.rows; ++r)
    for (int c = 0; c < board.columns; ++c) {
      const Vector2 p(at.x + (c + 1) * square - 0.5, at.y + (r + 1) * square - 0.5);
      EXPECT_LT((found.pixels[static_cast<std::size_t>(r * board.columns + c)] - p).norm(), tolerance)
          << r << ' ' << c;
    }
  EXPECT_NEAR(found.shortest, square, 2 * tolerance);
}

TEST(BoardShape, TellsWhereItsCornersSquaresAndEdgesAre) {
  const Board board{.columns = 5, .rows = 4, .square = 0.03, .margin = 0.01};
  EXPECT_EQ(board.corners(), 20);
  EXPECT_NEAR(board.width(), 0.2, 1e-12);
  EXPECT_NEAR(board.height(), 0.17, 1e-12);
  EXPECT_TRUE(Board::dark(0, 0));
  EXPECT_FALSE(Board::dark(0, 1));
  EXPECT_FALSE(Board::dark(3, 0));
  EXPECT_TRUE(Board::dark(3, 1));
  EXPECT_LT((board.corner(0, 0) - Vector3(-0.06, 0.045, 0)).norm(), 1e-12);
  EXPECT_LT((board.corner(3, 4) - Vector3(0.06, -0.045, 0)).norm(), 1e-12);
  EXPECT_EQ(kBoard.corners(), 54);
  EXPECT_NEAR(kBoard.width(), 0.3, 1e-12);
  EXPECT_NEAR(kBoard.height(), 0.225, 1e-12);
}

TEST(BoardSearch, OneOfSeveralIsAddedOnce) {
  const auto at = [](double x, double y) { return InnerCorners{{{x, y}, {x + 20, y}}, 20}; };
  std::vector<InnerCorners> boards;
  add(boards, at(100, 100));
  ASSERT_EQ(boards.size(), 1U);
  add(boards, at(109, 100));
  add(boards, at(100, 91));
  EXPECT_EQ(boards.size(), 1U) << "less than half a square away";
  add(boards, at(111, 100));
  EXPECT_EQ(boards.size(), 2U);
  add(boards, at(100, 120));
  EXPECT_EQ(boards.size(), 3U);
  add(boards, at(100, 121));
  EXPECT_EQ(boards.size(), 3U);
}

TEST(BoardSearch, OneBoardAndNothingElseIsOne) {
  SearchResult result;
  EXPECT_FALSE(result.is_one());
  result.boards.resize(1);
  EXPECT_TRUE(result.is_one());
  result.unresolved = true;
  EXPECT_FALSE(result.is_one());
  result.unresolved = false;
  result.boards.resize(2);
  EXPECT_FALSE(result.is_one());
}

TEST(BoardSearch, FindsCornersInAPartOfThePictureHoweverMuchItIsEnlarged) {
  cv::Mat grey = table(320, 240);
  draw(grey, kBoard, {90, 70}, 12);
  grey = blurred(grey);
  for (const int scale : {1, 2, 3}) {
    const SearchResult result = find_boards(grey, {60, 45, 190, 140, scale, 31, 6, {}}, kBoard);
    ASSERT_TRUE(result.is_one()) << scale;
    expect_corners(result.boards[0], kBoard, {90, 70}, 12);
  }
}

TEST(BoardSearch, CountsTheOutlinesOfDarkRegions) {
  cv::Mat grey = table(320, 240, kLight);
  const SearchResult nothing = find_boards(grey, everywhere(grey), kBoard);
  EXPECT_EQ(nothing.outlines, 0U);
  EXPECT_FALSE(nothing.unresolved);
  for (int k = 0; k < 7; ++k) cv::rectangle(grey, cv::Rect(20 + 40 * k, 100, 12, 12), kDark, cv::FILLED);
  EXPECT_EQ(find_boards(grey, everywhere(grey), kBoard).outlines, 7U);
}

// Eight dark squares in a lattice are no accident.
TEST(BoardSearch, ManySquaresBesideTheBoardMayBeAnotherOne) {
  const auto with = [](int columns, int rows, cv::Point at) {
    cv::Mat grey = table(640, 240);
    draw(grey, kBoard, {40, 40}, 20);
    draw_squares(grey, columns, rows, at, 20);
    return find_boards(blurred(grey), everywhere(grey), kBoard);
  };
  const SearchResult eight = with(5, 3, {420, 40});
  ASSERT_EQ(eight.boards.size(), 1U);
  EXPECT_TRUE(eight.unresolved);
  EXPECT_FALSE(eight.is_one());
  EXPECT_TRUE(with(13, 1, {300, 40}).is_one()) << "seven of them";
  const SearchResult seven = with(7, 2, {420, 40});
  ASSERT_EQ(seven.boards.size(), 1U);
  EXPECT_FALSE(seven.unresolved);
}

TEST(BoardSearch, WithoutABoardManySquaresAreUnresolved) {
  cv::Mat grey = table(320, 240);
  draw_squares(grey, 5, 4, {60, 60}, 20);
  const SearchResult result = find_boards(blurred(grey), everywhere(grey), kBoard);
  EXPECT_TRUE(result.boards.empty());
  EXPECT_TRUE(result.unresolved);
}

// The six largest lattices are grown.
TEST(BoardSearch, SixLatticesAreLookedAt) {
  for (const int larger : {5, 6}) {
    cv::Mat grey = table(760, 700);
    draw(grey, kBoard, {40, 40}, 14);
    for (int k = 0; k < larger; ++k) draw_squares(grey, 12, 9, {40 + 240 * (k % 3), 200 + 170 * (k / 3)}, 14);
    const SearchResult result = find_boards(blurred(grey), everywhere(grey, 41), kBoard);
    EXPECT_EQ(result.boards.size(), larger == 5 ? 1U : 0U);
    EXPECT_TRUE(result.unresolved);
  }
}

TEST(BoardSearch, AFaintBoardIsNone) {
  const auto with = [](int contrast) {
    cv::Mat grey = table(320, 240, 100 + contrast);
    draw(grey, kBoard, {60, 40}, 20, 100, 100 + contrast);
    return find_boards(blurred(grey), everywhere(grey), kBoard).boards.size();
  };
  EXPECT_EQ(with(16), 1U);
  EXPECT_EQ(with(13), 0U);
}

// The margin must be seen beside most of the dark squares of every side.
TEST(BoardSearch, ABoardEndsWhereItsMarginIsSeenOnEverySide) {
  constexpr int kSquare = 20;
  const cv::Point at(60, 50);
  const auto covered = [&](const cv::Rect& by) {
    cv::Mat grey = table(400, 300);
    draw(grey, kBoard, at, kSquare);
    cv::rectangle(grey, by, kDark, cv::FILLED);
    return find_boards(blurred(grey), everywhere(grey, 41), kBoard).boards.size();
  };
  const int right = at.x + 10 * kSquare, low = at.y + 7 * kSquare;
  const int gap = kSquare / 10;  // the squares at the edge stay apart from what covers the margin
  const auto above = [&](double squares) {
    return covered({at.x, at.y - kSquare, static_cast<int>(squares * kSquare), kSquare - gap});
  };
  const auto below = [&](double squares) {
    return covered({at.x, low + gap, static_cast<int>(squares * kSquare), kSquare - gap});
  };
  const auto left_of = [&](double squares) {
    return covered({at.x - kSquare, at.y, kSquare - gap, static_cast<int>(squares * kSquare)});
  };
  const auto right_of = [&](double squares) {
    return covered({right + gap, at.y, kSquare - gap, static_cast<int>(squares * kSquare)});
  };
  // Four dark squares of the upper and the lower side lie between inner corners, two or three of the others.
  EXPECT_EQ(above(10), 0U);
  EXPECT_EQ(below(10), 0U);
  EXPECT_EQ(left_of(7), 0U);
  EXPECT_EQ(right_of(7), 0U);
  EXPECT_EQ(above(2.8), 1U);
  EXPECT_EQ(above(4.8), 0U);
  EXPECT_EQ(below(2.8), 1U);
  EXPECT_EQ(below(4.8), 0U);
  EXPECT_EQ(left_of(1.5), 1U);
  EXPECT_EQ(left_of(2.8), 0U);
  EXPECT_EQ(right_of(1.8), 1U);
  EXPECT_EQ(right_of(3.8), 0U);
}

TEST(BoardSearch, TheBoardsEndsAreToldApartHoweverItLies) {
  cv::Mat upright = table(320, 320);
  draw(upright, kBoard, {60, 90}, 20);
  upright = blurred(upright);
  cv::Mat turned = upright.clone();
  for (int quarter = 0; quarter < 4; ++quarter) {
    const SearchResult result = find_boards(turned, everywhere(turned), kBoard);
    ASSERT_TRUE(result.is_one()) << quarter;
    const Vector2 first(79.5, 109.5), last(239.5, 209.5);
    const auto place = [&](Vector2 p) {
      for (int k = 0; k < quarter; ++k) p = Vector2(319 - p.y(), p.x());
      return p;
    };
    EXPECT_LT((result.boards[0].pixels.front() - place(first)).norm(), 0.1) << quarter;
    EXPECT_LT((result.boards[0].pixels.back() - place(last)).norm(), 0.1) << quarter;
    EXPECT_LT((result.boards[0].pixels[8] - place({239.5, 109.5})).norm(), 0.1) << quarter;
    cv::Mat next;
    cv::rotate(turned, next, cv::ROTATE_90_CLOCKWISE);
    turned = next;
  }
}

/// A lattice of three dark squares at the upper left of a board, with their outlines as stage (38) gives them.
std::vector<Quadrangle> three(cv::Point at, int square, Lattice& lattice) {
  std::vector<Quadrangle> all;
  for (const auto& [i, j] : {std::pair(0, 0), std::pair(1, 1), std::pair(0, 2)}) {
    const auto x = static_cast<float>(at.x + i * square) - 0.5F,
               y = static_cast<float>(at.y + j * square) - 0.5F;
    const auto s = static_cast<float>(square);
    lattice.push_back({all.size(), i, j, 0});
    all.push_back({{{{x, y}, {x + s, y}, {x + s, y + s}, {x, y + s}}}, {x + s / 2, y + s / 2}, s});
  }
  return all;
}

// Twelve rounds of growing, and lattices of 14 corners to either side: boards of 20 corners are found by squares in
// their middle.
TEST(InnerCornersTest, ThreeSquaresGrowToTheBoardTwelveTimesInAnyDirection) {
  const auto found = [](int columns, int from) {
    const Board board{.columns = columns, .rows = 4};
    constexpr int kSquare = 12;
    cv::Mat grey = table(kSquare * (columns + 6), 120);
    draw(grey, board, {36, 30}, kSquare);
    grey = blurred(grey);
    Lattice lattice;
    const auto squares = three({36 + from * kSquare, 30}, kSquare, lattice);
    const auto corners = inner_corners(grey, squares, lattice, board);
    if (corners) expect_corners(*corners, board, {36, 30}, kSquare);
    return corners.has_value();
  };
  EXPECT_TRUE(found(7, 0));
  EXPECT_TRUE(found(12, 0));
  EXPECT_FALSE(found(13, 0));
  EXPECT_FALSE(found(19, 0)) << "too far";
  EXPECT_TRUE(found(19, 8));
}

TEST(InnerCornersTest, ABoardOfOtherCountsIsNotTheBoard) {
  constexpr int kSquare = 16;
  const auto found = [](int columns, int rows) {
    cv::Mat grey = table(280, 220);
    draw(grey, {.columns = columns, .rows = rows}, {36, 30}, kSquare);
    grey = blurred(grey);
    Lattice lattice;
    const auto squares = three({36, 30}, kSquare, lattice);
    return inner_corners(grey, squares, lattice, {.columns = 7, .rows = 6}).has_value();
  };
  EXPECT_TRUE(found(7, 6));
  for (const auto& [columns, rows] : {std::pair(8, 6), {6, 6}, {7, 7}, {7, 5}, {9, 6}, {7, 8}, {8, 7}})
    EXPECT_FALSE(found(columns, rows)) << columns << " x " << rows;
  EXPECT_TRUE(found(6, 7)) << "the same board, lying";
  Lattice lattice;
  const auto squares = three({4, 4}, 3, lattice);
  EXPECT_FALSE(inner_corners(table(15, 100), squares, lattice, kBoard)) << "a picture that is too small";
}

TEST(InnerCornersTest, LocateMovesCornersByLessThanHalfASquare) {
  constexpr int kSquare = 20;
  cv::Mat grey = table(320, 240);
  draw(grey, kBoard, {60, 40}, kSquare);
  grey = blurred(grey);
  InnerCorners truth;
  truth.shortest = kSquare;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c)
      truth.pixels.emplace_back(60 + (c + 1) * kSquare - 0.5, 40 + (r + 1) * kSquare - 0.5);
  std::mt19937 random(1);
  std::uniform_real_distribution<> off(-3, 3);
  InnerCorners rough = truth;
  for (Vector2& p : rough.pixels) p += Vector2(off(random), off(random));
  ASSERT_TRUE(locate(grey, rough));
  expect_corners(rough, kBoard, {60, 40}, kSquare, 0.05);
  for (const Vector2& outside :
       {Vector2(-0.1, 50), Vector2(50, -0.1), Vector2(319.1, 50), Vector2(50, 239.1)}) {
    rough = truth;
    rough.pixels[7] = outside;
    EXPECT_FALSE(locate(grey, rough)) << outside.transpose();
  }
  rough = truth;
  rough.shortest = 2;
  rough.pixels[3] += Vector2(1.6, 0);
  EXPECT_FALSE(locate(grey, rough)) << "farther than half of what lies between corners";
  const cv::Mat small = grey(cv::Rect(60, 40, 21, 21));
  InnerCorners one{{{19, 19}}, kSquare};
  EXPECT_TRUE(locate(small, one)) << "too small to locate anything";
  EXPECT_EQ(one.pixels[0], Vector2(19, 19));
}

// Enlarging is for boards whose squares are a few pixels wide.
TEST(FindEverywhere, EnlargesThePictureForSmallSquares) {
  for (const int square : {40, 20, 10, 7, 6, 5}) {
    cv::Mat grey = table(640, 480);
    draw(grey, kBoard, {60, 60}, square);
    grey = blurred(grey, 0.5);
    std::vector<InnerCorners> known;
    find_everywhere(grey, kBoard, 6, known);
    ASSERT_EQ(known.size(), 1U) << square;
    expect_corners(known[0], kBoard, {60, 60}, square, 0.2);
  }
}

class SmallBoard : public testing::Test {
 protected:
  /// Found in an enlarged picture only.
  static constexpr int kSquare = 5;
  static cv::Mat picture(int width) {
    cv::Mat grey = table(width, 480);
    draw(grey, kBoard, {30, 430}, kSquare);
    return grey;
  }
  static std::size_t found(const cv::Mat& grey, std::vector<InnerCorners> known = {}) {
    find_everywhere(blurred(grey, 0.5), kBoard, 6, known);
    return known.size();
  }
};

TEST_F(SmallBoard, WidePicturesAreNotEnlarged) {
  EXPECT_EQ(kWidest, 800);
  EXPECT_EQ(found(picture(800)), 1U);
  EXPECT_EQ(found(picture(801)), 0U);
}

TEST_F(SmallBoard, PicturesFullOfOutlinesAreNotEnlarged) {
  const auto with = [](int dots) {
    cv::Mat grey = picture(640);
    for (int k = 0; k < dots; ++k)
      cv::rectangle(grey, cv::Rect(140 + 10 * (k % 45), 10 + 10 * (k / 45), 5, 5), kDark, cv::FILLED);
    return grey;
  };
  const auto outlines = [](const cv::Mat& grey) {
    const Search search{0, 0, grey.cols, grey.rows, 1, kSmallSurroundings, 6, {}};
    return static_cast<int>(find_boards(blurred(grey, 0.5), search, kBoard).outlines);
  };
  const int most = 1400 + 1500 - outlines(with(1400));
  ASSERT_EQ(outlines(with(most)), 1500);
  EXPECT_EQ(found(with(most)), 1U);
  EXPECT_EQ(found(with(most + 1)), 0U);
}

TEST(FindEverywhere, LooksAtLargeSurroundingsOfAnEighthOfTheWidth) {
  EXPECT_EQ(kSmallSurroundings, 21);
  for (const auto& [width, edge] : {std::pair(10, 21),
                                    {160, 21},
                                    {175, 21},
                                    {176, 23},
                                    {191, 23},
                                    {192, 25},
                                    {640, 81},
                                    {655, 81},
                                    {656, 83}})
    EXPECT_EQ(large_surroundings(width), edge) << width;
}

TEST_F(SmallBoard, TheSearchIsOverWhenTwoAreKnownOrOneAndNothingElse) {
  const auto far = [](double x) { return InnerCorners{{{x, 400}, {x + 20, 400}}, 20}; };
  EXPECT_EQ(found(picture(640), {far(300), far(400)}), 2U);
  EXPECT_EQ(found(picture(640), {far(300)}), 1U) << "nothing to be seen beside it";
  cv::Mat grey = picture(640);
  draw_squares(grey, 5, 4, {300, 100}, 30);
  EXPECT_EQ(found(grey, {far(300)}), 2U) << "what lies there may be another board: one goes on";
}

}  // namespace
}  // namespace mrroc::vsp::chessboard
