#include "base/cube/move.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/cube/vocabulary.hpp"
#include "base/fault.hpp"

namespace mrroc::cube {
namespace {

TEST(Move, IsWrittenAndReadBack) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 100; ++k) {
    const Moves moves = random_moves(k % 25, random);
    EXPECT_EQ(parse_moves(to_string(moves)), moves);
  }
  EXPECT_EQ(to_string(parse_moves("RU2'F3 , D3' L'")), "R U2 F' D L'");
  EXPECT_TRUE(parse_moves("  ").empty());
}

TEST(Move, IsRefusedWithItsPlaceWhenItIsNone) {
  for (const char* text : {"R X", "R r", "R 2", "R''", "R22", "M"}) {
    try {
      static_cast<void>(parse_moves(text));
      ADD_FAILURE() << text;
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, kBadCube);
      EXPECT_NE(std::string(e.what()).find("is no turn"), std::string::npos);
    }
  }
}

TEST(Move, IsUndoneByItsInverse) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 100; ++k) {
    const Cube cube = random_cube(random);
    const Moves moves = random_moves(20, random);
    EXPECT_EQ(after(after(cube, moves), inverse(moves)), cube);
    EXPECT_EQ(after({}, inverse(moves)), inverse(after({}, moves)));
  }
}

TEST(Move, TakesApostrophesAsPeopleTypeAndTypesetThem) {
  for (const char* text : {"R' U2' F", "R\u2019 U2\u2019 F", "R\u2032U2\u2032F"})
    EXPECT_EQ(parse_moves(text), parse_moves("R3 U2 F")) << text;
}

TEST(Move, SequencesReachTheKnownNumbersOfCubes) {
  // 18, 243, 3240 cubes are 1, 2, 3 turns from solved; the rules of succession leave one sequence for each.
  std::set<std::string> seen{""};
  std::vector<Moves> sequences{{}};
  std::set<std::pair<std::array<std::uint8_t, 8>, std::array<std::uint8_t, 12>>> cubes{
      {Cube{}.corners, Cube{}.edges}};
  for (const std::size_t expected : {18U, 243U, 3240U}) {
    std::vector<Moves> longer;
    for (const Moves& sequence : sequences)
      for (int m = 0; m < kMoves; ++m) {
        if (!may_follow(sequence.empty() ? nullptr : &sequence.back(), Move(m))) continue;
        longer.push_back(sequence);
        longer.back().emplace_back(m);
        const Cube cube = after({}, longer.back());
        cubes.emplace(cube.corners, cube.edges);
      }
    EXPECT_EQ(longer.size(), expected);
    sequences = longer;
  }
  EXPECT_EQ(cubes.size(), 1U + 18U + 243U + 3240U);
}

TEST(Move, RandomCubesAreSpreadEvenly) {
  std::mt19937_64 random(3);
  std::array<int, kCornerValues> first_corner{};
  std::array<int, kEdgeValues> last_edge{};
  constexpr int kDraws = 24000;
  for (int k = 0; k < kDraws; ++k) {
    const Cube cube = random_cube(random);
    ASSERT_TRUE(is_reachable(cube));
    ++first_corner[cube.corners[0]];
    ++last_edge[cube.edges[11]];
  }
  for (const int n : first_corner) EXPECT_NEAR(n, 1000, 150);
  for (const int n : last_edge) EXPECT_NEAR(n, 1000, 150);
}

}  // namespace
}  // namespace mrroc::cube
