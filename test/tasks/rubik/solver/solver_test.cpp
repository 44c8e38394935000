#include "tasks/rubik/solver/solver.hpp"

#include <gtest/gtest.h>

namespace mrroc::rubik {
namespace {

TEST(CubeSolver, SolvesAndSaysWhatIsProven) {
  std::mt19937_64 random(1);
  const CubeSolver solver(TableSet::small, MRROC_TEST_TABLES, 1);
  const Cube near = after({}, random_moves(8, random));
  const Solution shortest = solver.solve_optimally(near, {});
  EXPECT_EQ(after(near, shortest.moves), Cube{});
  EXPECT_TRUE(shortest.optimal());
  EXPECT_LE(shortest.moves.size(), 8U);

  const Solution quick = solver.solve(near, {.nodes = 500});
  EXPECT_EQ(after(near, quick.moves), Cube{});
  EXPECT_GE(quick.moves.size(), shortest.moves.size());
  EXPECT_LE(quick.lower_bound, static_cast<int>(shortest.moves.size()));

  const Solution solved = solver.solve_optimally({}, {});
  EXPECT_TRUE(solved.moves.empty());
  EXPECT_TRUE(solved.optimal());
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
