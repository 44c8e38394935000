// Inner corners of a board from its dark squares: what is a corner, how far a lattice reaches, where corners are
// located. Boards that face the camera, drawn square by square.
#include "vsp/chessboard/inner_corners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

namespace mrroc::vsp::chessboard {
namespace {

constexpr int kDark = 60, kLight = 200;

/// Brightness of the square in a row and column; beyond the board it is the margin's.
using Paint = std::function<int(int row, int column)>;
int plain(int row, int column) { return (row + column) % 2 == 0 ? kDark : kLight; }

/// A board in the middle of a picture, all of whose dark squares are known.
class DrawnBoard {
 public:
  /// @param first  which of the dark squares the lattice begins with
  DrawnBoard(const Board& board, int square, const Paint& paint = plain, int margin = kLight,
             std::size_t first = 0)
      : board_(board),
        square_(square),
        grey((board.rows + 5) * square, (board.columns + 5) * square, CV_8U, margin) {
    std::vector<std::pair<int, int>> places;
    for (int r = 0; r <= board.rows; ++r)
      for (int c = 0; c <= board.columns; ++c) {
        cv::rectangle(grey, cv::Rect((c + 2) * square, (r + 2) * square, square, square), paint(r, c),
                      cv::FILLED);
        if ((r + c) % 2 != 0) continue;
        places.emplace_back(r, c);
        const cv::Point2f low = corner(r - 1, c - 1), high = corner(r, c);
        quadrangles.push_back(
            {{low, {high.x, low.y}, high, {low.x, high.y}}, 0.5F * (low + high), static_cast<float>(square)});
      }
    const auto& [row, column] = places[first % places.size()];
    for (std::size_t k = 0; k < places.size(); ++k)
      lattice.push_back({k, places[k].second - column, places[k].first - row, 0});
  }
  [[nodiscard]] cv::Point2f corner(int row, int column) const {
    return {static_cast<float>((column + 3) * square_) - 0.5F,
            static_cast<float>((row + 3) * square_) - 0.5F};
  }
  [[nodiscard]] std::optional<InnerCorners> found() const {
    return inner_corners(grey, quadrangles, lattice, board_);
  }

 private:
  Board board_;
  int square_;

 public:
  cv::Mat grey;
  std::vector<Quadrangle> quadrangles;
  Lattice lattice;
};

constexpr Board kSmall{.columns = 5, .rows = 4};
bool is_found(const Paint& paint, int margin = kLight) {
  return DrawnBoard(kSmall, 16, paint, margin).found().has_value();
}

TEST(InnerCornersOfSquares, AreFoundFromTheSquaresThatAreKnown) {
  for (const int square : {5, 8, 12, 16, 24, 40}) {
    const DrawnBoard board(kSmall, square);
    const auto found = board.found();
    ASSERT_TRUE(found) << square;
    EXPECT_NEAR(found->shortest, square, 0.05) << square;
    std::size_t n = 0;
    for (int r = 0; r < kSmall.rows; ++r)
      for (int c = 0; c < kSmall.columns; ++c, ++n) {
        EXPECT_NEAR(found->pixels[n].x(), board.corner(r, c).x, 0.02) << square;
        EXPECT_NEAR(found->pixels[n].y(), board.corner(r, c).y, 0.02) << square;
      }
  }
}

TEST(InnerCornersOfSquares, MayBeBlackAndWhite) {
  EXPECT_TRUE(is_found([](int r, int c) { return (r + c) % 2 == 0 ? 0 : 255; }, 255));
}

TEST(InnerCornersOfSquares, DifferByMoreThanFourteenGreyLevels) {
  const auto with = [](int contrast) {
    return is_found([=](int r, int c) { return (r + c) % 2 == 0 ? 100 : 100 + contrast; }, 100 + contrast);
  };
  EXPECT_FALSE(with(0));
  EXPECT_FALSE(with(14));
  EXPECT_TRUE(with(15));
}

// The two light squares at a corner lie in neighbouring rows, and so do the dark ones.
TEST(InnerCornersOfSquares, DifferByMoreThanHalfOfWhatSquaresOfOneColourDo) {
  for (const int odd : {0, 1}) {
    const auto light = [odd](int more) {
      return is_found(
          [=](int r, int c) { return (r + c) % 2 == 0 ? 60 : (r % 2 == odd ? 100 + more : 100); });
    };
    EXPECT_TRUE(light(79)) << "40 of 79";
    EXPECT_FALSE(light(80));
    const auto dark = [odd](int less) {
      return is_found(
          [=](int r, int c) { return (r + c) % 2 != 0 ? 140 : (r % 2 == odd ? 100 - less : 100); });
    };
    EXPECT_TRUE(dark(79));
    EXPECT_FALSE(dark(80));
  }
}

// At half of the way to the middles of the squares and at three quarters, if there is room for both.
TEST(InnerCornersOfSquares, AreLookedAtInTwoPlacesWhereSquaresAreTwelvePixelsWide) {
  const auto with = [](int square, double from, double to) {
    DrawnBoard board(kSmall, square);
    const cv::Point2f at = board.corner(1, 2);
    for (int v = 0; v < board.grey.rows; ++v)
      for (int u = 0; u < board.grey.cols; ++u) {
        const double away =
            std::max(std::abs(static_cast<float>(u) - at.x), std::abs(static_cast<float>(v) - at.y));
        if (away > from * square && away < to * square) board.grey.at<unsigned char>(v, u) = 130;
      }
    return board.found().has_value();
  };
  EXPECT_TRUE(with(11, 0, 0.3)) << "looked at in the squares' middles only";
  EXPECT_FALSE(with(11, 0.36, 0.64));
  EXPECT_FALSE(with(13, 0, 0.3));
  EXPECT_FALSE(with(40, 0.16, 0.24));
  EXPECT_FALSE(with(40, 0.32, 0.43));
  EXPECT_TRUE(with(40, 0.45, 0.55)) << "not looked at there";
  EXPECT_TRUE(with(40, 0.25, 0.31));
}

// The first of the squares is in the middle: there is room for 14 corners to either side.
TEST(InnerCornersOfSquares, ReachFourteenToEitherSide) {
  const auto with = [](int columns, int rows, bool last) {
    const Board board{.columns = columns, .rows = rows};
    const auto all = DrawnBoard(board, 8);
    return DrawnBoard(board, 8, plain, kLight, last ? all.lattice.size() - 1 : 0).found().has_value();
  };
  EXPECT_TRUE(with(14, 3, false));
  EXPECT_FALSE(with(15, 3, false));
  EXPECT_TRUE(with(3, 14, false));
  EXPECT_FALSE(with(3, 15, false));
  // The last square's upper left corner is its own place.
  EXPECT_TRUE(with(15, 3, true));
  EXPECT_FALSE(with(16, 4, true));
  EXPECT_TRUE(with(3, 15, true));
  EXPECT_FALSE(with(4, 16, true));
}

// A quarter of a square beyond the board, and one pixel more.
TEST(InnerCornersOfSquares, AreABoardWhoseMarginIsInThePicture) {
  constexpr int kSquare = 10;
  const DrawnBoard board(kSmall, kSquare);
  const auto within = [&](int left, int up, int right, int low) {
    std::vector<Quadrangle> moved = board.quadrangles;
    const cv::Point2f by(static_cast<float>(left), static_cast<float>(up));
    for (Quadrangle& q : moved) {
      for (cv::Point2f& c : q.corner) c -= by;
      q.centre -= by;
    }
    const cv::Mat part = board.grey(cv::Range(up, low), cv::Range(left, right));
    return inner_corners(part.clone(), moved, board.lattice, kSmall).has_value();
  };
  // Pixels 17 and 17 are the margin's at the upper left, 82 and 72 at the lower right.
  EXPECT_TRUE(within(16, 16, 84, 74));
  EXPECT_FALSE(within(17, 16, 84, 74));
  EXPECT_FALSE(within(16, 17, 84, 74));
  EXPECT_FALSE(within(16, 16, 83, 74));
  EXPECT_FALSE(within(16, 16, 84, 73));
}

TEST(InnerCornersOfSquares, AreThoseOfTheBoardOrThereIsNone) {
  const DrawnBoard drawn({.columns = 7, .rows = 5}, 12);
  for (int columns = 2; columns < 10; ++columns)
    for (int rows = 2; rows < 10; ++rows) {
      const bool is = (columns == 7 && rows == 5) || (columns == 5 && rows == 7);
      const auto found =
          inner_corners(drawn.grey, drawn.quadrangles, drawn.lattice, {.columns = columns, .rows = rows});
      EXPECT_EQ(found.has_value(), is) << columns << ' ' << rows;
    }
}

// A square that was lost, or is none, does not matter; one that was turned is told by its cell.
TEST(InnerCornersOfSquares, FollowTheTurnsOfTheSquares) {
  DrawnBoard board({.columns = 6, .rows = 5}, 14);
  const auto straight = board.found();
  for (Cell& cell : board.lattice) {
    cell.turn = static_cast<int>(cell.quadrangle % 4);
    auto& corner = board.quadrangles[cell.quadrangle].corner;
    std::rotate(corner.begin(), corner.begin() + cell.turn, corner.end());
  }
  const auto turned = board.found();
  ASSERT_TRUE(straight && turned);
  EXPECT_EQ(straight->pixels, turned->pixels);
  const Lattice all = board.lattice;
  board.lattice = {all[4], all[7], all[8], all[5]};
  const auto few = board.found();
  ASSERT_TRUE(few);
  for (std::size_t k = 0; k < few->pixels.size(); ++k)
    EXPECT_LT((few->pixels[k] - straight->pixels[k]).norm(), 0.01) << k;
}

// From any three of its squares that touch, seen from anywhere.
TEST(InnerCornersOfSquares, GrowFromAnyThreeSquaresInAnyView) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> any(-1, 1);
  const Board board{.columns = 8, .rows = 6};
  const DrawnBoard straight(board, 24);
  for (int run = 0; run < 60; ++run) {
    // The picture's corners, each moved by up to 40 pixels.
    const auto width = static_cast<float>(straight.grey.cols),
               height = static_cast<float>(straight.grey.rows);
    const std::vector<cv::Point2f> from{{0, 0}, {width, 0}, {width, height}, {0, height}};
    std::vector<cv::Point2f> to;
    for (const cv::Point2f& p : from)
      to.push_back(p + cv::Point2f(60 + 40 * any(random), 60 + 40 * any(random)));
    const cv::Mat view = cv::getPerspectiveTransform(from, to);
    DrawnBoard seen = straight;
    cv::warpPerspective(straight.grey, seen.grey, view, {straight.grey.cols + 120, straight.grey.rows + 120},
                        cv::INTER_AREA, cv::BORDER_CONSTANT, cv::Scalar(kLight));
    cv::GaussianBlur(seen.grey, seen.grey, {}, 0.8);
    const auto moved = [&](const cv::Point2f& p) {
      std::vector<cv::Point2f> result;
      cv::perspectiveTransform(std::vector<cv::Point2f>{p}, result, view);
      return result.front();
    };
    for (Quadrangle& q : seen.quadrangles) {
      for (cv::Point2f& c : q.corner) c = moved(c);
      q.centre = moved(q.centre);
    }
    // A square, and two of those that touch it at a corner.
    const auto& all = straight.lattice;
    const Cell& first = all[static_cast<std::size_t>(random()) % all.size()];
    seen.lattice = {first};
    for (const Cell& cell : all)
      if (std::abs(cell.i - first.i) == 1 && std::abs(cell.j - first.j) == 1 && seen.lattice.size() < 3)
        seen.lattice.push_back(cell);
    if (seen.lattice.size() < 3) continue;
    for (Cell& cell : seen.lattice) {
      cell.i -= first.i;
      cell.j -= first.j;
    }
    std::rotate(seen.lattice.begin(), seen.lattice.begin() + run % 3, seen.lattice.end());
    const auto found = seen.found();
    ASSERT_TRUE(found) << run;
    std::size_t n = 0;
    double shortest = 1e9;
    for (int r = 0; r < board.rows; ++r)
      for (int c = 0; c < board.columns; ++c, ++n) {
        const cv::Point2f p = moved(straight.corner(r, c));
        ASSERT_LT((found->pixels[n] - Vector2(p.x, p.y)).norm(), 0.2) << run << ' ' << r << ' ' << c;
        if (c > 0) shortest = std::min(shortest, (found->pixels[n] - found->pixels[n - 1]).norm());
        if (r > 0) shortest = std::min(shortest, (found->pixels[n] - found->pixels[n - 8]).norm());
      }
    EXPECT_NEAR(found->shortest, shortest, 0.3) << run;
  }
}

// OpenCV's cornerSubPix in windows of 0.45 squares to either side, 2 to 8 pixels, in 20 steps.
TEST(LocatedCorners, AreThoseOfTheirWindows) {
  std::mt19937 random(2);
  std::uniform_real_distribution<> off(-1.5, 1.5);
  cv::Mat grey = DrawnBoard({.columns = 9, .rows = 6}, 20).grey;
  cv::GaussianBlur(grey, grey, {}, 1.2);
  cv::Mat noise(grey.size(), CV_8U);
  cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 30);
  grey += noise;
  const std::array<std::pair<double, int>, 9> windows{
      {{2, 2}, {5.4, 2}, {5.6, 3}, {10, 5}, {12.1, 5}, {12.3, 6}, {16.6, 7}, {16.8, 8}, {60, 8}}};
  for (const auto& [shortest, window] : windows) {
    InnerCorners corners{{}, shortest};
    std::vector<cv::Point2f> points;
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 9; ++c) {
        corners.pixels.emplace_back((c + 3) * 20 - 0.5 + off(random), (r + 3) * 20 - 0.5 + off(random));
        points.emplace_back(static_cast<float>(corners.pixels.back().x()),
                            static_cast<float>(corners.pixels.back().y()));
      }
    cv::cornerSubPix(grey, points, {window, window}, {-1, -1},
                     {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.003});
    bool near = true;
    for (std::size_t k = 0; k < points.size(); ++k)
      near = near && (corners.pixels[k] - Vector2(points[k].x, points[k].y)).norm() <= shortest / 2;
    ASSERT_EQ(locate(grey, corners), near) << shortest;
    if (!near) continue;
    for (std::size_t k = 0; k < points.size(); ++k)
      EXPECT_EQ(corners.pixels[k], Vector2(points[k].x, points[k].y)) << shortest;
  }
}

TEST(LocatedCorners, AreLeftWhereTheyAreInAPictureThatIsTooSmallForTheWindow) {
  cv::Mat grey = DrawnBoard(kSmall, 20).grey(cv::Rect(50, 50, 60, 22)).clone();
  const auto moves = [](const cv::Mat& picture, const Vector2& from) {
    InnerCorners corners{.pixels = {from}, .shortest = 20};
    EXPECT_TRUE(locate(picture, corners));
    return corners.pixels[0] != from;
  };
  EXPECT_TRUE(moves(grey, {10, 10})) << "a window of 8 pixels to either side, and 6 more";
  EXPECT_FALSE(moves(grey(cv::Rect(0, 0, 60, 21)), {10, 10}));
  EXPECT_FALSE(moves(grey.t()(cv::Rect(0, 0, 21, 60)), {10, 10}));
}

TEST(LocatedCorners, MayLieOnThePicturesBorder) {
  const cv::Mat grey(60, 80, CV_8U, cv::Scalar(100));
  for (const Vector2& p : {Vector2(0, 0), Vector2(79, 0), Vector2(0, 59), Vector2(79, 59)}) {
    InnerCorners corners{.pixels = {p}, .shortest = 20};
    EXPECT_TRUE(locate(grey, corners)) << p.transpose();
  }
}

}  // namespace
}  // namespace mrroc::vsp::chessboard
