// Lattices made of dark squares as stage (38) gives them, of all sizes, places and turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "vsp/chessboard/chain.hpp"

namespace mrroc::vsp::chessboard {
namespace {

/// Corners clockwise in the picture from the upper left one of a square that is not turned.
Quadrangle square(cv::Point2f centre, float edge, float turn = 0) {
  Quadrangle q;
  q.centre = centre;
  q.shortest = edge;
  const float h = edge / 2, c = std::cos(turn), s = std::sin(turn);
  const std::array<cv::Point2f, 4> corners{{{-h, -h}, {h, -h}, {h, h}, {-h, h}}};
  for (std::size_t k = 0; k < 4; ++k)
    q.corner[k] =
        centre + cv::Point2f(c * corners[k].x - s * corners[k].y, s * corners[k].x + c * corners[k].y);
  return q;
}
std::size_t largest(const std::vector<Quadrangle>& squares) {
  const auto all = lattices(squares);
  return all.empty() ? 0 : all.front().size();
}

// Also where a part of the board lies outside of the picture's upper left corner.
TEST(LatticeOfAnyBoard, HasAllSquaresInTheirPlaces) {
  std::mt19937 random(7);
  const auto uniform = [&](float a, float b) { return std::uniform_real_distribution<float>(a, b)(random); };
  for (int run = 0; run < 300; ++run) {
    const float edge = uniform(6, 70), turn = uniform(-3, 3);
    const cv::Point2f right(edge * std::cos(turn), edge * std::sin(turn)), down(-right.y, right.x);
    const cv::Point2f middle(uniform(0, 900), uniform(0, 700)), origin = middle - 2.5F * right - 2.0F * down;
    std::vector<Quadrangle> squares;
    std::vector<std::pair<int, int>> places;
    for (int j = 0; j < 5; ++j)
      for (int i = 0; i < 6; ++i)
        if ((i + j) % 2 == 0) {
          const float off = 0.06F * edge;
          squares.push_back(square(origin + static_cast<float>(i) * right + static_cast<float>(j) * down +
                                       cv::Point2f(uniform(-off, off), uniform(-off, off)),
                                   edge, turn));
          places.emplace_back(i, j);
        }
    const auto all = lattices(squares);
    ASSERT_EQ(all.size(), 1U) << run;
    ASSERT_EQ(all[0].size(), squares.size()) << run;
    const auto& [first_i, first_j] = places[all[0].front().quadrangle];
    for (const Cell& cell : all[0]) {
      EXPECT_EQ(cell.i, places[cell.quadrangle].first - first_i) << run;
      EXPECT_EQ(cell.j, places[cell.quadrangle].second - first_j) << run;
      EXPECT_EQ(cell.turn, 0) << run;
    }
  }
}

TEST(LatticeOfAnyBoard, NoSquareIsInTwoLattices) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> place(0, 200), edge(8, 30);
  for (int run = 0; run < 50; ++run) {
    std::vector<Quadrangle> squares;
    for (int k = 0; k < 120; ++k) squares.push_back(square({place(random), place(random)}, edge(random)));
    std::vector<int> uses(squares.size(), 0);
    std::size_t before = squares.size();
    for (const Lattice& lattice : lattices(squares)) {
      EXPECT_GE(lattice.size(), 3U);
      EXPECT_LE(lattice.size(), before);
      before = lattice.size();
      for (const Cell& cell : lattice) {
        ++uses[cell.quadrangle];
        EXPECT_EQ((cell.i + cell.j) % 2, 0);
      }
    }
    EXPECT_LE(*std::ranges::max_element(uses), 1);
  }
}

// The third square meets the first one's lower left corner in all cases.
const Quadrangle kFirst = square({100, 100}, 20), kThird = square({80, 120}, 20);

TEST(LatticeNeighbour, IsTheNearestOfThoseThatFit) {
  for (const bool near_one_first : {true, false}) {
    std::vector<Quadrangle> squares{kFirst, kThird, square({121, 121}, 20), square({126, 126}, 20)};
    if (!near_one_first) std::swap(squares[2], squares[3]);
    const auto all = lattices(squares);
    ASSERT_EQ(all.size(), 1U);
    ASSERT_EQ(all[0].size(), 3U);
    const std::size_t near = near_one_first ? 2 : 3;
    EXPECT_TRUE(std::ranges::any_of(all[0], [near](const Cell& c) { return c.quadrangle == near; }));
  }
}

// Otherwise one square would belong to two others at one corner.
TEST(LatticeNeighbour, HasNoNearerOneItself) {
  // The second square's corner is nearer to the fourth one's than to the first one's.
  const Quadrangle second = square({124, 124}, 20);
  EXPECT_EQ(largest({kFirst, kThird, second}), 3U);
  Quadrangle fourth = square({112.5F - 22.5F, 112.5F - 22.5F}, 45);
  fourth.shortest = 59;
  EXPECT_EQ(largest({kFirst, kThird, second, fourth}), 0U);
  fourth.shortest = 61;
  EXPECT_EQ(largest({kFirst, kThird, second, fourth}), 3U) << "it is too large to be a neighbour of either";
}

TEST(LatticeNeighbour, IsSeenOnTheOtherSideOfTheCornerAlsoAtASlant) {
  const auto turned_about_the_corner = [](float degrees) {
    const float turn = degrees * 3.14159265F / 180;
    const cv::Point2f to(10 * std::cos(turn) - 10 * std::sin(turn),
                         10 * std::sin(turn) + 10 * std::cos(turn));
    return largest({kFirst, kThird, square(cv::Point2f(110, 110) + to, 20, turn)});
  };
  EXPECT_EQ(turned_about_the_corner(0), 3U);
  EXPECT_EQ(turned_about_the_corner(70), 3U);
  EXPECT_EQ(turned_about_the_corner(-70), 3U);
  EXPECT_EQ(turned_about_the_corner(76), 0U);
  EXPECT_EQ(turned_about_the_corner(-76), 0U);
}

// No board has more than forty corners in sixteen pixels.
TEST(LatticeNeighbour, IsOneOfTheFirstFortyCornersInItsPlace) {
  const auto with = [](int corners) {
    std::vector<Quadrangle> squares;
    for (int k = 0; k < corners / 4; ++k) squares.push_back(square({104, 104}, 2));
    // Half or a quarter of it in the place from 96 to 112.
    if (corners % 4 == 2) squares.push_back(square({96, 104}, 2));
    if (corners % 4 == 1) squares.push_back(square({96, 96}, 2));
    squares.insert(squares.end(), {kFirst, kThird, square({120, 120}, 20)});
    return largest(squares);
  };
  EXPECT_EQ(with(36), 3U);
  EXPECT_EQ(with(38), 3U) << "with the two that meet there they are forty";
  EXPECT_EQ(with(40), 0U);
  // One of 39 and one of 41 corners.
  std::vector<Quadrangle> squares;
  for (int k = 0; k < 9; ++k) squares.push_back(square({104, 104}, 2));
  squares.insert(squares.end(),
                 {square({96, 104}, 2), square({96, 96}, 2), kFirst, kThird, square({120, 120}, 20)});
  EXPECT_EQ(largest(squares), 0U) << "the second of them is the forty-first";
}

TEST(LatticeOfThree, IsTheSmallest) {
  EXPECT_EQ(largest({kFirst}), 0U);
  EXPECT_EQ(largest({kFirst, kThird}), 0U);
  EXPECT_EQ(largest({kFirst, kThird, square({120, 120}, 20)}), 3U);
  EXPECT_EQ(largest({}), 0U);
}

}  // namespace
}  // namespace mrroc::vsp::chessboard
