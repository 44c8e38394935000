#include "tasks/rubik/solver/two_phase.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

TEST(TwoPhase, SolvesEveryCubeInFewTurns) {
  std::mt19937_64 random(1);
  std::size_t sum = 0;
  constexpr int kCubes = 12;
  for (int k = 0; k < kCubes; ++k) {
    const Cube cube = random_cube(random);
    const TwoPhaseResult result = solve_two_phase(test::small_bounds(), cube, {.nodes = 3000});
    ASSERT_EQ(after(cube, result.moves), Cube{});
    EXPECT_LE(result.moves.size(), 24U);
    sum += result.moves.size();
  }
  EXPECT_LT(static_cast<double>(sum) / kCubes, 21.0);
}

TEST(TwoPhase, GivesTheSameSolutionForTheSameNumberOfNodes) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 5; ++k) {
    const Cube cube = random_cube(random);
    const SearchLimits limits{.nodes = 2000};
    EXPECT_EQ(solve_two_phase(test::small_bounds(), cube, limits).moves,
              solve_two_phase(test::small_bounds(), cube, limits).moves);
  }
}

TEST(TwoPhase, ImprovesTheLongerItSearches) {
  std::mt19937_64 random(3);
  std::size_t first = 0, last = 0;
  for (int k = 0; k < 4; ++k) {
    const Cube cube = random_cube(random);
    std::size_t before = 99;
    for (const std::uint64_t nodes : {1U, 1000U, 100000U}) {
      const Moves moves = solve_two_phase(test::small_bounds(), cube, {.nodes = nodes}).moves;
      ASSERT_EQ(after(cube, moves), Cube{});
      ASSERT_LE(moves.size(), before);
      before = moves.size();
      (nodes == 1 ? first : last) += nodes == 1000 ? 0 : moves.size();
    }
  }
  EXPECT_LT(last, first);
}

TEST(TwoPhase, EndsByItselfWhereNothingCanBeShorter) {
  std::mt19937_64 random(4);
  EXPECT_TRUE(solve_two_phase(test::small_bounds(), {}, {}).moves.empty());
  for (int turns = 1; turns <= 6; ++turns) {
    const Moves scramble = random_moves(turns, random);
    const Cube cube = after({}, scramble);
    const TwoPhaseResult result = solve_two_phase(test::small_bounds(), cube, {});
    EXPECT_EQ(after(cube, result.moves), Cube{});
    EXPECT_LE(result.moves.size(), scramble.size());
  }
}

TEST(TwoPhase, StopsAtASolutionThatIsGoodEnough) {
  std::mt19937_64 random(5);
  const Cube cube = random_cube(random);
  const TwoPhaseResult result = solve_two_phase(test::small_bounds(), cube, {}, 23);
  EXPECT_EQ(after(cube, result.moves), Cube{});
  EXPECT_LE(result.moves.size(), 23U);
}

TEST(TwoPhase, SharesTheSearchAmongThreads) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 5; ++k) {
    const Cube cube = random_cube(random);
    const TwoPhaseResult result = solve_two_phase(test::small_bounds(), cube, {.nodes = 4000, .threads = 4});
    EXPECT_EQ(after(cube, result.moves), Cube{});
    EXPECT_LE(result.moves.size(), 24U);
  }
}

// States deep inside the second phase's group begin with a first phase of no turns.
TEST(TwoPhase, SolvesCubesOfTheSecondPhasesGroup) {
  std::mt19937_64 random(7);
  for (int k = 0; k < 6; ++k) {
    Cube cube;
    for (int n = 0; n < 60; ++n) cube = cube * turn(kSecondPhaseMoves[random() % kSecondPhaseMoves.size()]);
    const TwoPhaseResult result = solve_two_phase(test::small_bounds(), cube, {.nodes = 2000});
    EXPECT_EQ(after(cube, result.moves), Cube{});
    EXPECT_LE(result.moves.size(), 24U);
  }
}

}  // namespace
}  // namespace mrroc::rubik
