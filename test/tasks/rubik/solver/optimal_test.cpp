#include "tasks/rubik/solver/optimal.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "base/cube/facelets.hpp"
#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

using Key = std::pair<std::array<std::uint8_t, kCorners>, std::array<std::uint8_t, kEdges>>;

TEST(OptimalSolver, FindsTheDistancesOfABreadthFirstSearch) {
  std::map<Key, int> distance{{{Cube{}.corners, Cube{}.edges}, 0}};
  std::vector<Cube> level{{}};
  for (int turns = 1; turns <= 3; ++turns) {
    std::vector<Cube> next;
    for (const Cube& cube : level)
      for (int m = 0; m < kMoves; ++m) {
        const Cube c = cube * turn(Move(m));
        if (distance.try_emplace({c.corners, c.edges}, turns).second) next.push_back(c);
      }
    level = next;
  }
  EXPECT_EQ(distance.size(), 1U + 18U + 243U + 3240U);
  for (const auto& [key, turns] : distance) {
    const Cube cube{key.first, key.second};
    const OptimalResult result = solve_optimally(test::small_bounds(), cube, {});
    ASSERT_TRUE(result.moves);
    ASSERT_EQ(after(cube, *result.moves), Cube{});
    ASSERT_EQ(static_cast<int>(result.moves->size()), turns);
    ASSERT_EQ(result.lower_bound, turns);
  }
}

TEST(OptimalSolver, SolvesKnownCubesInTheirFewestTurns) {
  struct Known {
    const char* facelets;
    std::size_t turns;
  };
  for (const Known& known : {Known{"DDFBUFULLBRRURRLDRBUUFFFFBBRDDRDLFRDLLRULLUUDUFFDBBBBL", 10},
                             Known{"BULBUDRFFDRBLRFUDDUDLUFFBFLURFLDBRBRDLBLLBUDLDRRUBUFRF", 10},
                             Known{"FFFFUUFRRDLLBRDBRULFFLFDRDDBRLRDURLBUUUBLBBBDDDRLBULFU", 10}}) {
    const Cube cube = cube_from_facelets(known.facelets);
    const OptimalResult result = solve_optimally(test::small_bounds(), cube, {});
    ASSERT_TRUE(result.moves);
    EXPECT_EQ(after(cube, *result.moves), Cube{});
    EXPECT_EQ(result.moves->size(), known.turns);
  }
}

TEST(OptimalSolver, NeverNeedsMoreTurnsThanTheScramble) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 60; ++k) {
    const Moves scramble = random_moves(1 + k % 9, random);
    const Cube cube = after({}, scramble);
    const OptimalResult alone = solve_optimally(test::small_bounds(), cube, {});
    const OptimalResult shared = solve_optimally(test::small_bounds(), cube, {.threads = 3});
    const OptimalResult mirrored =
        solve_optimally(test::small_bounds(), conjugate(cube, symmetry(k % kSymmetries)), {});
    ASSERT_TRUE(alone.moves && shared.moves && mirrored.moves);
    EXPECT_LE(alone.moves->size(), scramble.size());
    EXPECT_EQ(after(cube, *alone.moves), Cube{});
    EXPECT_EQ(after(cube, *shared.moves), Cube{});
    EXPECT_EQ(shared.moves->size(), alone.moves->size());
    EXPECT_EQ(mirrored.moves->size(), alone.moves->size());
  }
}

TEST(OptimalSolver, SaysHowFarItCameWhenALimitEndsIt) {
  std::mt19937_64 random(4);
  const Cube cube = random_cube(random);
  const OptimalResult result = solve_optimally(test::small_bounds(), cube, {.nodes = 1000});
  EXPECT_FALSE(result.moves);
  EXPECT_GE(result.lower_bound, test::small_bounds().lower_bound(CubePair::of(cube)));
  EXPECT_LE(result.nodes, 1200U);
  const OptimalResult none = solve_optimally(test::small_bounds(), cube, {}, {.shortest = 0, .longest = 8});
  EXPECT_FALSE(none.moves);
  EXPECT_EQ(none.lower_bound, 9);
}

}  // namespace
}  // namespace mrroc::rubik
