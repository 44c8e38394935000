// Effort of the searches: only these tests find a weaker bound, or a turn that is tried in vain.
#include <gtest/gtest.h>

#include "tasks/rubik/solver/optimal.hpp"
#include "tasks/rubik/solver/two_phase.hpp"
#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

Cube scrambled(const char* turns) { return after({}, parse_moves(turns)); }

TEST(SearchEffort, OfTheOptimalSearchIsTheseNodes) {
  struct Case {
    const char* scramble;
    int turns;
    std::uint64_t nodes;
  };
  for (const Case& c : {Case{"R U F", 3, 3},
                        {"R U2 F' L D2 B", 6, 6},
                        {"R U2 F' L D2 B R' F2 U", 9, 16},
                        {"F B' L2 D R' U2 B2 L'", 8, 8}}) {
    const OptimalResult r = solve_optimally(test::small_bounds(), scrambled(c.scramble), {});
    EXPECT_EQ(r.lower_bound, c.turns) << c.scramble;
    EXPECT_EQ(r.nodes, c.nodes) << c.scramble;
  }
}

TEST(SearchEffort, OfTwoPhasesIsTheseNodesAndItsFirstSolutionIsThis) {
  struct Case {
    const char *scramble, *solution;
    std::uint64_t nodes;
  };
  for (const Case& c : {Case{"R U F", "F' U' R'", 1},
                        {"R U2 F' L D2 B", "B' D2 L' F U2 R'", 1},
                        {"R U2 F' L D2 B R' F2 U L2 D' B2 R F' U2",
                         "R' U D' L D2 B2 L R F D' R U2 B2 D2 R F2 R' B2 U2", 1359},
                        {"F B' L2 D R' U2 B2 L' F2 D2 R U' L B D' F R2",
                         "U' D F2 R' L F D' B2 L' U R2 U2 L' D2 R F2 L2 D2 B2 L'", 1464}}) {
    const TwoPhaseResult r = solve_two_phase(test::small_bounds(), scrambled(c.scramble), {.nodes = 1});
    EXPECT_EQ(to_string(r.moves), c.solution) << c.scramble;
    EXPECT_EQ(r.nodes, c.nodes) << c.scramble;
  }
}

TEST(SearchEffort, ALimitOfNodesIsKeptToWithinABlock) {
  const Cube cube = scrambled("R U2 F' L D2 B R' F2 U L2 D' B2 R F' U2");
  for (const std::uint64_t nodes : {5000U, 20'000U}) {
    const std::uint64_t used = solve_two_phase(test::small_bounds(), cube, {.nodes = nodes}).nodes;
    EXPECT_GE(used, nodes);
    EXPECT_LT(used, nodes + 600);
  }
}

}  // namespace
}  // namespace mrroc::rubik
