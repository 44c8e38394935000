#include "tasks/rubik/solver/solver.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

TEST(CubeSolver, SolvesAndSaysWhatIsProven) {
  std::mt19937_64 random(1);
  const CubeSolver solver(TableSet::small, test::tables_folder(), 1);
  const Cube near = after({}, random_moves(8, random));
  const Solution shortest = solver.solve_optimally(near, {});
  EXPECT_EQ(after(near, shortest.moves), Cube{});
  EXPECT_TRUE(shortest.optimal());
  EXPECT_LE(shortest.moves.size(), 8U);

  const Solution quick = solver.solve_in_two_phases(near, {.nodes = 500});
  EXPECT_EQ(quick.by, Search::two_phase);
  EXPECT_EQ(after(near, quick.moves), Cube{});
  EXPECT_GE(quick.moves.size(), shortest.moves.size());
  EXPECT_LE(quick.lower_bound, static_cast<int>(shortest.moves.size()));

  const Solution solved = solver.solve_optimally({}, {});
  EXPECT_TRUE(solved.moves.empty());
  EXPECT_TRUE(solved.optimal());
}

TEST(CubeSolver, ProvesAShortSolutionFirstAndElseTakesTwoPhases) {
  std::mt19937_64 random(2);
  const CubeSolver solver(TableSet::small, test::tables_folder(), 1);
  const SolveLimits limits{.shortest = {.nodes = 20'000}, .two_phase = {.nodes = 500}};
  const Solution near = solver.solve(after({}, random_moves(8, random)), limits);
  EXPECT_EQ(near.by, Search::ida_star);
  EXPECT_TRUE(near.optimal());

  const Cube cube = random_cube(random);
  const Solution far = solver.solve(cube, limits);
  EXPECT_EQ(far.by, Search::two_phase);
  EXPECT_EQ(after(cube, far.moves), Cube{});
  EXPECT_FALSE(far.optimal());
  EXPECT_GE(far.lower_bound, solver.solve_in_two_phases(cube, {.nodes = 1}).lower_bound);
  EXPECT_EQ(solver.solve(cube, limits).moves, far.moves) << "the same in every run";
}

TEST(CubeSolver, TakesWhatTheFirstSearchUsesFromTheSecond) {
  using namespace std::chrono_literals;
  std::mt19937_64 random(3);
  const CubeSolver solver(TableSet::small, test::tables_folder(), 1);
  SolveLimits limits{.shortest = {.budget = 20ms}, .two_phase = {.budget = 20s}, .both = 40ms};
  const auto begin = std::chrono::steady_clock::now();
  static_cast<void>(solver.solve(random_cube(random), limits));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

TEST(CubeSolver, MakesTablesInMemoryWithoutAFolder) {
  std::vector<std::string> made;
  const TableWatch watch{[&made](std::string_view table, double part) {
                           if (part >= 1) made.emplace_back(table);
                         },
                         {}};
  const CubeSolver solver(TableSet::small, "", 2, watch);
  EXPECT_EQ(made,
            (std::vector<std::string>{"corner-slice", "corners-small", "phase2-small", "phase1-small"}));
  const Cube cube = after({}, parse_moves("R U F"));
  EXPECT_EQ(solver.solve_optimally(cube, {}).moves, parse_moves("F' U' R'"));
}

}  // namespace
}  // namespace mrroc::rubik
