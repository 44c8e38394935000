// Turns of a face that jams in one direction.
#include "tasks/rubik/plan/blocked_directions.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace mrroc::rubik {
namespace {

TEST(BlockedDirections, ATurnDoesTheSameWhateverJams) {
  for (int found = 0; found < 4; ++found)
    for (int k = 0; k < kMoves; ++k) {
      const Move move(k);
      BlockedDirections blocked;
      if (found & 1) blocked.add(move.face(), 1);
      if (found & 2) blocked.add(move.face(), -0.3);
      const TurnDirection direction = direction_of(move, blocked);
      EXPECT_EQ((direction.quarters + 4) % 4, move.quarters()) << found << ' ' << to_string(move);
      const bool free = found == 0 || found == 3;
      EXPECT_TRUE(found != 1 || direction.quarters < 0);
      EXPECT_TRUE(found != 2 || direction.quarters > 0);
      EXPECT_TRUE(!free || std::abs(direction.quarters) <= 2);
      EXPECT_EQ(direction.either_direction, move.quarters() == 2 && free);
    }
}

TEST(BlockedDirections, AreThoseOfOneFace) {
  BlockedDirections blocked;
  blocked.add(Face::R, 1);
  EXPECT_TRUE(blocked.has(Face::R, 0.1));
  EXPECT_FALSE(blocked.has(Face::R, -1));
  EXPECT_EQ(direction_of(Move(Face::L, 1), blocked).quarters, 1);
  EXPECT_EQ(direction_of(Move(Face::R, 1), blocked).quarters, -3);
  EXPECT_EQ(direction_of(Move(Face::R, 3), blocked).quarters, -1);
  EXPECT_EQ(direction_of(Move(Face::R, 2), blocked).quarters, -2);
}

}  // namespace
}  // namespace mrroc::rubik
