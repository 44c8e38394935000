#include "tasks/rubik/solver/second_phase.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

TEST(Arrangement, IsSeenThroughSymmetriesAsTheCubeIs) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 20; ++n) {
    const Cube cube = random_cube(random);
    for (int s = 0; s < kAxisSymmetries; ++s)
      EXPECT_EQ(SeenArrangements::get().of(cube, s), Arrangement::of(conjugate(cube, symmetry(s))));
  }
}

TEST(SecondPhase, StartsAtTheCoordinatesOfTheCube) {
  std::mt19937_64 random(2);
  const SecondPhase second(test::small_tables());
  for (int n = 0; n < 200; ++n) {
    Cube cube;
    for (int k = 0; k < 40; ++k) cube = cube * turn(kSecondPhaseMoves[random() % kSecondPhaseMoves.size()]);
    const Moves way = random_moves(6, random);
    constexpr int kAnyLength = 20;
    const auto state =
        second.start(Arrangement::of(after(cube, inverse(way))), Arrangement::of(after({}, way)), kAnyLength);
    ASSERT_TRUE(state);
    EXPECT_EQ(static_cast<int>(state->corners), kCornerPermutation.of(cube));
    EXPECT_EQ(static_cast<int>(state->edges), kEdgePermutation.of(cube));
    EXPECT_EQ(static_cast<int>(state->slice), kSlicePermutation.of(cube));
  }
}

}  // namespace
}  // namespace mrroc::rubik
