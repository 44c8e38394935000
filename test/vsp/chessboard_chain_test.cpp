// The stages (35)-(40) one by one, on a board that faces the camera.
#include "vsp/chessboard/chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "test/vsp/plane_camera.hpp"
#include "vsp/chessboard/board_search.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp::chessboard {
namespace {

constexpr int kDarkSquares = 35;

class ChainTest : public testing::Test {
 protected:
  static const Image& picture() {
    static const Image picture_of_board =
        test::PlaneCamera(CameraModel{}, 2)
            .render(test::facing(0.5, 0, 0, 0.2), test::chessboard_texture(9, 6, 0.025, 0.025));
    return picture_of_board;
  }
  // The table around the plate is a dark quadrangle, too.
  static std::vector<Quadrangle> small_ones(const cv::Mat& binary) {
    std::vector<Quadrangle> found = quadrangles(contours(dilation(binary), {}), {});
    std::erase_if(found, [](const Quadrangle& q) { return q.shortest > 100; });
    return found;
  }
  cv::Mat grey_ = grey(picture().view());
  cv::Mat binary_ = threshold(grey_, 81, 6);
};

TEST_F(ChainTest, ThresholdFollowsTheBrightnessOfTheSurroundings) {
  cv::Mat shaded;
  grey_.convertTo(shaded, CV_32F);
  for (int v = 0; v < shaded.rows; ++v)
    for (int u = 0; u < shaded.cols; ++u) shaded.at<float>(v, u) *= 0.3F + 0.7F * static_cast<float>(u) / 640;
  shaded.convertTo(shaded, CV_8U);
  const auto squares = [](const cv::Mat& g) { return small_ones(threshold(g, 81, 6)).size(); };
  EXPECT_EQ(squares(grey_), kDarkSquares);
  EXPECT_EQ(squares(shaded), kDarkSquares);
}

TEST_F(ChainTest, DilationLetsLightGrowAndTakesSquaresApart) {
  const cv::Mat grown = dilation(binary_);
  cv::Mat lost;
  cv::bitwise_and(binary_, ~grown, lost);
  EXPECT_EQ(cv::countNonZero(lost), 0);
  EXPECT_GT(cv::countNonZero(grown), cv::countNonZero(binary_));
  cv::Mat labels;
  // Squares that touch at their corners are joined in the paper's picture, which lets dark grow.
  cv::Mat joined;
  cv::dilate(~binary_, joined, cv::Mat());
  const cv::Rect middle(220, 190, 200, 100);
  EXPECT_GT(cv::connectedComponents(~grown, labels, 8), kDarkSquares);
  EXPECT_LT(cv::connectedComponents(joined(middle), labels, 8), 3);
}

TEST_F(ChainTest, QuadranglesAreTheDarkSquaresWithTheirCornersClockwise) {
  const auto found = small_ones(binary_);
  ASSERT_EQ(found.size(), kDarkSquares);
  for (const Quadrangle& q : found) {
    EXPECT_NEAR(q.shortest, 30, 2.5);
    for (std::size_t k = 0; k < 4; ++k) {
      const cv::Point2f a = q.corner[(k + 1) % 4] - q.corner[k];
      const cv::Point2f b = q.corner[(k + 2) % 4] - q.corner[(k + 1) % 4];
      EXPECT_GT(a.cross(b), 0);
    }
  }
}

TEST_F(ChainTest, NeighboursMakeOneLatticeOfAllSquares) {
  const auto found = quadrangles(contours(dilation(binary_), {}), {});
  const auto all = lattices(found);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].size(), static_cast<std::size_t>(kDarkSquares));
  for (const Cell& cell : all[0]) EXPECT_EQ((cell.i + cell.j) % 2, 0);
}

TEST_F(ChainTest, SquaresThatDoNotTouchMakeNoLattice) {
  cv::Mat apart(480, 640, CV_8U, cv::Scalar(230));
  for (int k = 0; k < 12; ++k)
    cv::rectangle(apart, cv::Rect(30 + 60 * (k % 4), 30 + 60 * (k / 4), 30, 30), 20, cv::FILLED);
  const auto found = quadrangles(contours(dilation(threshold(apart, 81, 6)), {}), {});
  EXPECT_EQ(found.size(), 12U);
  EXPECT_TRUE(lattices(found).empty());
}

TEST_F(ChainTest, InnerCornersLieWhereTheLensProjectsThem) {
  const SearchResult result = find_boards(grey_, {0, 0, 640, 480, 1, 81, 6, {}}, kBoard);
  ASSERT_TRUE(result.is_one());
  const Pose T = test::facing(0.5, 0, 0, 0.2);
  double squares = 0;
  std::size_t n = 0;
  for (int r = 0; r < kBoard.rows; ++r)
    for (int c = 0; c < kBoard.columns; ++c)
      squares +=
          (project(CameraModel{}, T * kBoard.corner(r, c)) - result.boards[0].pixels[n++]).squaredNorm();
  EXPECT_LT(std::sqrt(squares / kBoard.corners()), 0.1);
}

TEST_F(ChainTest, WorkIsBoundedByTheLimits) {
  EXPECT_EQ(contours(dilation(binary_), {.contours = 10, .quadrangles = 800}).size(), 10U);
  EXPECT_EQ(WorkLimits{}.contours, 6000U);
  EXPECT_EQ(WorkLimits{}.quadrangles, 800U);
  EXPECT_EQ(Search{}.scale, 1);
  const auto outlines = contours(dilation(binary_), {});
  EXPECT_EQ(quadrangles(outlines, {.contours = 6000, .quadrangles = 7}).size(), 7U);
}

TEST_F(ChainTest, LostSquaresAreBridged) {
  cv::Mat dirty = grey_.clone();
  // A scratch joins two dark squares across a light one.
  const Quadrangle q = small_ones(binary_)[17];
  cv::line(dirty, q.centre, q.centre + 2 * (q.corner[1] - q.corner[0]), 20, 3);
  EXPECT_LT(small_ones(threshold(dirty, 81, 6)).size(), static_cast<std::size_t>(kDarkSquares));
  EXPECT_TRUE(find_boards(dirty, {0, 0, 640, 480, 1, 81, 6, {}}, kBoard).is_one());
}

/// A dark square as stage (38) gives it, corners clockwise from the upper left one.
Quadrangle square_at(float x, float y, float edge, float turn = 0) {
  Quadrangle q;
  q.centre = {x, y};
  q.shortest = edge;
  const float h = edge / 2, c = std::cos(turn), s = std::sin(turn);
  const std::array<cv::Point2f, 4> corners{{{-h, -h}, {h, -h}, {h, h}, {-h, h}}};
  for (std::size_t k = 0; k < 4; ++k)
    q.corner[k] = {x + c * corners[k].x - s * corners[k].y, y + s * corners[k].x + c * corners[k].y};
  return q;
}

TEST(Lattices, NeighboursMeetWithinHalfAnEdge) {
  const auto size = [](float gap) {
    const auto all =
        lattices({square_at(100, 100, 20), square_at(120 + gap, 120, 20), square_at(100, 140, 20)});
    return all.empty() ? 0U : all[0].size();
  };
  EXPECT_EQ(size(0), 3U);
  EXPECT_EQ(size(9.5F), 3U);
  EXPECT_EQ(size(10.5F), 0U) << "one has no neighbour: the others are two, too few";
}

TEST(Lattices, NeighboursAreOfSimilarSize) {
  const auto size = [](float edge) {
    const float next = 110 + edge / 2;
    const auto all =
        lattices({square_at(100, 100, 20), square_at(next, next, edge), square_at(100, 110 + edge + 10, 20)});
    return all.empty() ? 0U : all[0].size();
  };
  EXPECT_EQ(size(20), 3U);
  EXPECT_EQ(size(58), 3U);
  EXPECT_EQ(size(62), 0U);
  EXPECT_EQ(size(7.0F), 3U);
  EXPECT_EQ(size(6.4F), 0U);
}

TEST(Lattices, NeighboursLieOnOppositeSidesOfTheirCorner) {
  const auto size = [](float x, float y) {
    const auto all = lattices({square_at(100, 100, 20), square_at(120, 120, 20), square_at(x, y, 20)});
    return all.empty() ? 0U : all[0].size();
  };
  EXPECT_EQ(size(140, 140), 3U);
  EXPECT_EQ(size(140, 100), 3U);
  EXPECT_EQ(size(100, 140), 3U);
  EXPECT_EQ(size(80, 120), 3U);
  EXPECT_EQ(size(120, 100), 0U) << "side by side they share an edge";
}

TEST(Lattices, PlacesAndTurnsFollowFromTheCornersThatMeet) {
  std::vector<Quadrangle> squares;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 6; ++i)
      if ((i + j) % 2 == 0) {
        squares.push_back(square_at(100 + 20 * static_cast<float>(i), 80 + 20 * static_cast<float>(j), 20));
        auto& corner = squares.back().corner;
        std::rotate(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(squares.size() % 4),
                    corner.end());
      }
  const auto all = lattices(squares);
  ASSERT_EQ(all.size(), 1U);
  ASSERT_EQ(all[0].size(), squares.size());
  // Seen from its first square, which is turned by a quarter.
  const Quadrangle& first = squares[all[0].front().quadrangle];
  for (const Cell& cell : all[0]) {
    const Quadrangle& q = squares[cell.quadrangle];
    const cv::Point2f right = first.corner[1] - first.corner[0], down = first.corner[3] - first.corner[0];
    const cv::Point2f way = static_cast<float>(cell.i) * right + static_cast<float>(cell.j) * down;
    EXPECT_LT(cv::norm(q.centre - first.centre - way), 1e-2);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t at = (k + static_cast<std::size_t>(cell.turn)) % 4;
      EXPECT_LT(cv::norm(q.corner[k] - q.centre - (first.corner[at] - first.centre)), 1e-2) << k;
    }
  }
}

TEST(Lattices, TheLargestComesFirst) {
  std::vector<Quadrangle> squares;
  const auto diagonal = [&squares](int n, float y) {
    for (int k = 0; k < n; ++k)
      squares.push_back(square_at(50 + 20 * static_cast<float>(k), y + 20 * static_cast<float>(k), 20));
  };
  diagonal(2, 10);
  diagonal(3, 200);
  diagonal(5, 400);
  diagonal(4, 600);
  std::vector<std::size_t> sizes;
  for (const Lattice& lattice : lattices(squares)) sizes.push_back(lattice.size());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{5, 4, 3}));
}

std::vector<Quadrangle> of(const std::vector<cv::Point>& outline) { return quadrangles({outline}, {}); }
std::vector<cv::Point> rectangle(int width, int height) {
  return {{10, 10}, {10 + width, 10}, {10 + width, 10 + height}, {10, 10 + height}};
}

TEST(Quadrangles, HaveAnAreaOfNinePixelsAndEdgesThatDifferByLessThanFourTimes) {
  EXPECT_EQ(of(rectangle(3, 3)).size(), 1U);
  EXPECT_EQ(of(rectangle(4, 2)).size(), 0U);
  EXPECT_EQ(of(rectangle(100, 29)).size(), 1U);
  EXPECT_EQ(of(rectangle(29, 100)).size(), 1U);
  EXPECT_EQ(of(rectangle(100, 21)).size(), 0U);
  EXPECT_EQ(of(rectangle(21, 100)).size(), 0U);
}

TEST(Quadrangles, AreNotSeenFromTheSide) {
  const auto rhombus = [](double degrees) {
    const double a = degrees * 3.14159265 / 180;
    const cv::Point u(100, 0), v(static_cast<int>(100 * std::cos(a)), static_cast<int>(100 * std::sin(a)));
    const cv::Point at(10, 10);
    return of({at, at + u, at + u + v, at + v}).size();
  };
  EXPECT_EQ(rhombus(90), 1U);
  EXPECT_EQ(rhombus(40), 1U);
  EXPECT_EQ(rhombus(16), 0U);
}

TEST(Quadrangles, OutlinesWithOtherCornersAreNone) {
  EXPECT_EQ(of({{10, 10}, {60, 10}, {35, 60}}).size(), 0U) << "a triangle";
  EXPECT_EQ(of({{10, 10}, {90, 10}, {30, 30}, {10, 90}}).size(), 0U) << "one corner points inwards";
  // A little off is still a square.
  EXPECT_EQ(of({{10, 10}, {60, 8}, {110, 10}, {110, 110}, {10, 110}}).size(), 1U);
}

// What dilation has taken is given back: about a pixel to either side.
TEST(Quadrangles, AreAsLargeAsTheSquareInThePicture) {
  for (const bool clockwise : {true, false}) {
    cv::Mat picture(100, 100, CV_8U, cv::Scalar(255));
    cv::rectangle(picture, cv::Rect(30, 40, 24, 24), 0, cv::FILLED);
    auto outlines = contours(dilation(picture), {});
    ASSERT_EQ(outlines.size(), 1U);
    if (clockwise) std::reverse(outlines[0].begin(), outlines[0].end());
    const auto found = quadrangles(outlines, {});
    ASSERT_EQ(found.size(), 1U);
    const Quadrangle& q = found[0];
    EXPECT_LT(cv::norm(q.centre - cv::Point2f(41.5F, 51.5F)), 0.01);
    EXPECT_NEAR(q.shortest, 24, 0.7);
    cv::Point2f sum(0, 0);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_NEAR(std::abs(q.corner[k].x - 41.5), 12, 0.35);
      EXPECT_NEAR(std::abs(q.corner[k].y - 51.5), 12, 0.35);
      const cv::Point2f a = q.corner[(k + 1) % 4] - q.corner[k],
                        b = q.corner[(k + 2) % 4] - q.corner[(k + 1) % 4];
      EXPECT_GT(a.cross(b), 0) << "clockwise, whichever way the outline goes";
      sum += q.corner[k];
    }
    EXPECT_LT(cv::norm(0.25F * sum - q.centre), 0.01);
  }
}

// Every corner goes outwards by 1.2 times 1.4 pixels.
TEST(Quadrangles, GrowByAsMuchAtEveryCorner) {
  for (const int edge : {4, 24, 60}) {
    const auto found = of(rectangle(edge, edge));
    ASSERT_EQ(found.size(), 1U);
    const float more = 1.2F * 1.4F / std::sqrt(2.0F), low = 10 - more,
                high = 10 + static_cast<float>(edge) + more;
    const std::array<cv::Point2f, 4> corners{{{low, low}, {high, low}, {high, high}, {low, high}}};
    const auto first = std::ranges::min_element(
        corners, {}, [&](cv::Point2f c) { return cv::norm(c - found[0].corner[0]); });
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_LT(
          cv::norm(corners[(static_cast<std::size_t>(first - corners.begin()) + k) % 4] - found[0].corner[k]),
          1e-3)
          << edge;
    EXPECT_NEAR(found[0].shortest, high - low, 1e-3);
    EXPECT_LT(cv::norm(found[0].centre - 0.5F * (corners[0] + corners[2])), 1e-3);
  }
}

/// @return the four corners of an outline: of the coarsest look at it that is needed
std::vector<cv::Point> four_corners(const std::vector<cv::Point>& outline) {
  std::vector<cv::Point> corners;
  for (const double share : {0.05, 0.09, 0.13}) {
    cv::approxPolyDP(outline, corners, share * cv::arcLength(outline, true), true);
    if (corners.size() <= 4) break;
  }
  return corners;
}

TEST(Quadrangles, AreThoseOutlinesThatAreOnesWithoutTheirBumps) {
  std::mt19937 random(1);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
  int found = 0;
  for (int run = 0; run < 20'000; ++run) {
    std::vector<cv::Point> outline;
    const int points = 4 + run % 6;
    const double size = uniform(4, 60), flat = uniform(0.15, 1), turn = uniform(0, 6.3),
                 bumpy = uniform(0, 0.8);
    for (int k = 0; k < points; ++k) {
      const double angle = 2 * M_PI * (k + uniform(-0.3, 0.3)) / points,
                   reach = size * (1 - bumpy * uniform(0, 1));
      const double x = reach * std::cos(angle), y = flat * reach * std::sin(angle);
      outline.emplace_back(static_cast<int>(100 + x * std::cos(turn) - y * std::sin(turn)),
                           static_cast<int>(100 + x * std::sin(turn) + y * std::cos(turn)));
    }
    const double area = cv::contourArea(outline), perimeter = cv::arcLength(outline, true);
    const auto corners = four_corners(outline);
    bool is = corners.size() == 4 && cv::isContourConvex(corners) && area >= 9 &&
              area >= 0.02 * perimeter * perimeter && cv::contourArea(corners) >= 0.6 * area;
    if (is) {
      const cv::Point2f middle = 0.25F * cv::Point2f(corners[0] + corners[1] + corners[2] + corners[3]);
      std::vector<double> edges;
      std::vector<cv::Point2f> grown;
      for (const cv::Point2f c : corners)
        grown.push_back(c + (c - middle) *
                                (1.2F * 1.4F / std::max(1.0F, static_cast<float>(cv::norm(c - middle)))));
      for (std::size_t k = 0; k < 4; ++k) edges.push_back(cv::norm(grown[k] - grown[(k + 1) % 4]));
      is = *std::ranges::max_element(edges) < 4 * *std::ranges::min_element(edges);
    }
    const auto all = of(outline);
    ASSERT_EQ(all.size(), is ? 1U : 0U) << run;
    found += is ? 1 : 0;
  }
  EXPECT_GT(found, 2000);
}

TEST(Outlines, AreThoseOfDarkRegionsWithoutTheirHoles) {
  cv::Mat picture(100, 100, CV_8U, cv::Scalar(255));
  cv::rectangle(picture, cv::Rect(10, 10, 50, 50), 0, cv::FILLED);
  cv::rectangle(picture, cv::Rect(20, 20, 20, 20), 255, cv::FILLED);
  cv::rectangle(picture, cv::Rect(80, 80, 2, 1), 0, cv::FILLED);
  const auto found = contours(picture, {});
  ASSERT_EQ(found.size(), 1U) << "neither the hole nor what has less than four corners";
  EXPECT_EQ(cv::boundingRect(found[0]), cv::Rect(10, 10, 50, 50));
}

TEST(Threshold, APixelIsDarkWhenItIsDarkerThanItsSurroundingsByMoreThanTheOffset) {
  cv::Mat grey(40, 40, CV_8U, cv::Scalar(100));
  grey.at<unsigned char>(10, 10) = 92;
  grey.at<unsigned char>(30, 30) = 96;
  const cv::Mat binary = threshold(grey, 21, 6);
  EXPECT_EQ(binary.at<unsigned char>(10, 10), 0);
  EXPECT_EQ(binary.at<unsigned char>(30, 30), 255);
  EXPECT_EQ(binary.at<unsigned char>(20, 20), 255);
  EXPECT_EQ(cv::countNonZero(binary), 40 * 40 - 1);
}

}  // namespace
}  // namespace mrroc::vsp::chessboard
