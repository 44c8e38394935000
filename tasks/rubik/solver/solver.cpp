#include "tasks/rubik/solver/solver.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/counted.hpp"
#include "tasks/rubik/solver/optimal.hpp"
#include "tasks/rubik/solver/two_phase.hpp"

namespace mrroc::rubik {
namespace {

using std::chrono::microseconds;
using std::chrono::steady_clock;

constexpr Lengths kNear{.shortest = 0, .longest = kGuaranteedOptimal};

/// @return what is left of a budget that began to run then
microseconds left_of(microseconds budget, steady_clock::time_point begin) {
  if (budget == microseconds::max()) return budget;
  const auto used = std::chrono::duration_cast<microseconds>(steady_clock::now() - begin);
  return std::max(microseconds(0), budget - used);
}

}  // namespace

std::string describe(const Solution& solution) {
  const char* const by = solution.by == Search::ida_star ? "IDA*" : "two-phase";
  if (solution.optimal()) return fmt::format("{}: proven to be a shortest solution", by);
  return fmt::format("{}: not proven to be a shortest solution, at least {} {} needed", by,
                     counted(solution.lower_bound, "turn"), solution.lower_bound == 1 ? "is" : "are");
}

Solution CubeSolver::solve(const Cube& cube, const SolveLimits& limits) const {
  const steady_clock::time_point begin = steady_clock::now();
  OptimalResult near = rubik::solve_optimally(bounds_, cube, limits.shortest, kNear);
  if (near.moves) return {std::move(*near.moves), near.lower_bound, Search::ida_star};
  SearchLimits left = limits.two_phase;
  left.budget = std::min(left.budget, left_of(limits.both, begin));
  return {solve_two_phase(bounds_, cube, left, near.lower_bound).moves, near.lower_bound, Search::two_phase};
}

Solution CubeSolver::solve_in_two_phases(const Cube& cube, const SearchLimits& limits) const {
  return {solve_two_phase(bounds_, cube, limits).moves, bounds_.lower_bound(CubePair::of(cube)),
          Search::two_phase};
}

Solution CubeSolver::solve_optimally(const Cube& cube, const SearchLimits& limits) const {
  const SearchLimits none{.threads = limits.threads};
  const steady_clock::time_point begin = steady_clock::now();
  OptimalResult near = rubik::solve_optimally(bounds_, cube, none, kNear);
  if (near.moves) return {std::move(*near.moves), near.lower_bound, Search::ida_star};

  const bool limited = limits.budget != none.budget || limits.nodes != none.nodes;
  Lengths lengths{.shortest = near.lower_bound};
  Solution solution{.by = Search::two_phase};
  if (limited) {
    SearchLimits tenth = limits;
    tenth.budget = limits.budget != none.budget ? limits.budget / 10 : limits.budget;
    tenth.nodes = limits.nodes != none.nodes ? limits.nodes / 10 : limits.nodes;
    solution.moves = solve_two_phase(bounds_, cube, tenth, near.lower_bound).moves;
    lengths.longest = static_cast<int>(solution.moves.size()) - 1;
  }
  SearchLimits left = limits;
  left.budget = left_of(limits.budget, begin);
  OptimalResult far = rubik::solve_optimally(bounds_, cube, left, lengths);
  solution.lower_bound = far.lower_bound;
  if (far.moves) {
    solution.moves = std::move(*far.moves);
    solution.by = Search::ida_star;
  }
  return solution;
}

}  // namespace mrroc::rubik
