#include "tasks/rubik/solver/solver.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "tasks/rubik/solver/optimal.hpp"
#include "tasks/rubik/solver/two_phase.hpp"

namespace mrroc::rubik {

Solution CubeSolver::solve(const Cube& cube, const SearchLimits& limits, int good_enough) const {
  return {solve_two_phase(bounds_, cube, limits, good_enough).moves, bounds_.lower_bound(CubePair::of(cube))};
}

Solution CubeSolver::solve_optimally(const Cube& cube, const SearchLimits& limits) const {
  using std::chrono::steady_clock;
  const SearchLimits none{.threads = limits.threads};
  const steady_clock::time_point begin = steady_clock::now();
  const OptimalResult near =
      rubik::solve_optimally(bounds_, cube, none, {.shortest = 0, .longest = kGuaranteedOptimal});
  if (near.moves) return {*near.moves, near.lower_bound};

  const bool limited = limits.budget != none.budget || limits.nodes != none.nodes;
  Lengths lengths{.shortest = near.lower_bound};
  SearchLimits left = limits;
  Solution solution;
  if (limited) {
    SearchLimits tenth = limits;
    tenth.budget = limits.budget != none.budget ? limits.budget / 10 : limits.budget;
    tenth.nodes = limits.nodes != none.nodes ? limits.nodes / 10 : limits.nodes;
    solution.moves = solve_two_phase(bounds_, cube, tenth, near.lower_bound).moves;
    lengths.longest = static_cast<int>(solution.moves.size()) - 1;
  }
  if (limits.budget != none.budget) {
    const auto used = std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now() - begin);
    left.budget = std::max(std::chrono::microseconds(0), limits.budget - used);
  }
  OptimalResult far = rubik::solve_optimally(bounds_, cube, left, lengths);
  solution.lower_bound = far.lower_bound;
  if (far.moves) solution.moves = std::move(*far.moves);
  return solution;
}

}  // namespace mrroc::rubik
