#include "tasks/rubik/solver/entrances.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

bool in_group(const Cube& cube) { return kTwist.of(cube) == 0 && kFlipSlice.of(cube) == kFlipSlice.of({}); }

/// @return number of ways of so many turns that enter the group with the last one
int count_ways(const Cube& cube, const Move* last, int turns) {
  if (turns == 0) return in_group(cube) ? 1 : 0;
  if (in_group(cube)) return 0;
  int count = 0;
  for (const Move& m : all_moves())
    if (may_follow(last, m)) count += count_ways(cube * turn(m), &m, turns - 1);
  return count;
}

/// A random cube of the group, after random turns.
Cube near_group(int turns, std::mt19937_64& random) {
  Cube cube;
  for (int n = 0; n < 40; ++n) cube = cube * turn(kSecondPhaseMoves[random() % kSecondPhaseMoves.size()]);
  return after(cube, random_moves(turns, random));
}

TEST(Entrances, AreAllTheWaysThereAre) {
  std::mt19937_64 random(1);
  const Tables& tables = test::small_tables();
  for (int turns = 1; turns <= 4; ++turns)
    for (int n = 0; n < 12; ++n) {
      const Cube cube = near_group(turns, random);
      const CosetState state = tables.state_of(cube);
      const auto entrances = tables.entrances.find(turns, state.flip_slice_class, state.twist);
      const Cube seen = conjugate(cube, symmetry(state.symmetry));
      EXPECT_EQ(2 * static_cast<int>(entrances.size()), count_ways(seen, nullptr, turns));
    }
}

TEST(Entrances, LeadIntoTheGroupWithTheLastTurnEitherWay) {
  std::mt19937_64 random(2);
  const Tables& tables = test::small_tables();
  int ways = 0;
  for (int n = 0; n < 200; ++n) {
    constexpr int kTurns = Entrances::kMostTurns;
    const Cube cube = near_group(kTurns, random);
    const CosetState state = tables.state_of(cube);
    const Cube seen = conjugate(cube, symmetry(state.symmetry));
    for (const auto& entrance : tables.entrances.find(kTurns, state.flip_slice_class, state.twist)) {
      Cube there = seen;
      for (const Move m : entrance.turns) {
        ASSERT_FALSE(in_group(there));
        there = there * turn(m);
      }
      ASSERT_TRUE(in_group(there));
      EXPECT_EQ(Arrangement::of(after({}, {entrance.turns.begin(), entrance.turns.end()})), entrance.pieces);
      const Move half = kSecondPhaseMoves[entrance.half_turn];
      EXPECT_EQ(there * turn(half), there * turn(entrance.turns.back()) * turn(entrance.turns.back()));
      ++ways;
    }
  }
  EXPECT_GT(ways, 100);
}

TEST(Entrances, OfACubeInTheGroupTakeNoTurns) {
  const Tables& tables = test::small_tables();
  const CosetState solved = tables.state_of({});
  const auto none = tables.entrances.find(0, solved.flip_slice_class, solved.twist);
  ASSERT_EQ(none.size(), 1U);
  EXPECT_EQ(none[0].pieces, Arrangement::of({}));
  EXPECT_EQ(none[0].half_turn, 0);
  EXPECT_TRUE(tables.entrances.find(1, solved.flip_slice_class, solved.twist).empty());
}

}  // namespace
}  // namespace mrroc::rubik
