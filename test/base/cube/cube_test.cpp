#include <gtest/gtest.h>

#include "base/cube/cube.hpp"
#include "base/cube/move.hpp"

namespace mrroc::cube {
namespace {

int order_of(const Cube& cube) {
  int order = 1;
  for (Cube power = cube; power != Cube{}; power = power * cube) ++order;
  return order;
}

TEST(Cube, IsAGroup) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 200; ++k) {
    const Cube a = random_cube(random), b = random_cube(random), c = random_cube(random);
    EXPECT_EQ((a * b) * c, a * (b * c));
    EXPECT_EQ(a * inverse(a), Cube{});
    EXPECT_EQ(inverse(a) * a, Cube{});
    EXPECT_EQ(inverse(a * b), inverse(b) * inverse(a));
    EXPECT_EQ(a * Cube{}, a);
  }
}

TEST(Cube, HasTheKnownOrdersOfTurns) {
  for (int m = 0; m < kMoves; ++m) EXPECT_EQ(order_of(turn(Move(m))), Move(m).quarters() == 2 ? 2 : 4);
  EXPECT_EQ(order_of(after({}, parse_moves("R U"))), 105);
  EXPECT_EQ(order_of(after({}, parse_moves("R U R' U'"))), 6);
  EXPECT_EQ(order_of(after({}, parse_moves("R U2 D' B D'"))), 1260);  // the largest order there is
  EXPECT_EQ(order_of(after({}, parse_moves("U R2 F B R B2 R U2 L B2 R U' D' R2 F R' L B2 U2 F2"))),
            2);  // all flipped
}

TEST(Cube, IsReachableAfterTurnsOnly) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 200; ++k) {
    const Cube cube = after(random_cube(random), random_moves(5, random));
    EXPECT_TRUE(is_reachable(cube));
    Cube twisted = cube, flipped = cube, exchanged = cube;
    twisted.corners[3] = static_cast<std::uint8_t>(twisted.corners[3] / 3 * 3 + (twisted.corners[3] + 1) % 3);
    flipped.edges[7] ^= 1;
    std::swap(exchanged.edges[2], exchanged.edges[9]);
    EXPECT_FALSE(is_reachable(twisted));
    EXPECT_FALSE(is_reachable(flipped));
    EXPECT_FALSE(is_reachable(exchanged));
  }
}

}  // namespace
}  // namespace mrroc::cube
