// Turns of a face that jams in one direction.
#include "tasks/rubik/plan/jams.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace mrroc::rubik {
namespace {

TEST(Jams, ATurnDoesTheSameWhateverJams) {
  for (int blocked = 0; blocked < 4; ++blocked)
    for (int k = 0; k < kMoves; ++k) {
      const Move move(k);
      Jams jams;
      if (blocked & 1) jams.add(move.face(), 1);
      if (blocked & 2) jams.add(move.face(), -0.3);
      const TurnWay way = way_of(move, jams);
      EXPECT_EQ((way.quarters + 4) % 4, move.quarters()) << blocked << ' ' << to_string(move);
      const bool free = blocked == 0 || blocked == 3;
      EXPECT_TRUE(blocked != 1 || way.quarters < 0);
      EXPECT_TRUE(blocked != 2 || way.quarters > 0);
      EXPECT_TRUE(!free || std::abs(way.quarters) <= 2);
      EXPECT_EQ(way.either_way, move.quarters() == 2 && free);
    }
}

TEST(Jams, AreThoseOfOneFace) {
  Jams jams;
  jams.add(Face::R, 1);
  EXPECT_TRUE(jams.has(Face::R, 0.1));
  EXPECT_FALSE(jams.has(Face::R, -1));
  EXPECT_EQ(way_of(Move(Face::L, 1), jams).quarters, 1);
  EXPECT_EQ(way_of(Move(Face::R, 1), jams).quarters, -3);
  EXPECT_EQ(way_of(Move(Face::R, 3), jams).quarters, -1);
  EXPECT_EQ(way_of(Move(Face::R, 2), jams).quarters, -2);
}

}  // namespace
}  // namespace mrroc::rubik
