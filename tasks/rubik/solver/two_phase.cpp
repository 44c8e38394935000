#include "tasks/rubik/solver/two_phase.hpp"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#include "tasks/rubik/solver/best_solution.hpp"
#include "tasks/rubik/solver/first_phase.hpp"

namespace mrroc::rubik {

TwoPhaseResult solve_two_phase(const Bounds& bounds, const Cube& cube, const SearchLimits& limits,
                               int good_enough) {
  std::vector<Variant> variants;
  for (int axis = 0; axis < kAxes; ++axis)
    for (const bool inverted : {false, true}) variants.emplace_back(cube, axis, inverted);
  Stopwatch watch(limits);
  BestSolution best(good_enough);
  std::atomic<int> next{0};
  std::atomic<std::uint64_t> nodes{0};
  const auto run = [&] {
    FirstPhase search(bounds, best, watch);
    const int count = static_cast<int>(variants.size());
    for (int job = next++; job / count < std::min(best.length(), FirstPhase::kMostTurns) && !search.over();
         job = next++)
      search.search(variants[job % count], job / count);
    nodes += search.nodes();
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < limits.threads; ++k) others.emplace_back(run);
    run();
  }
  return {best.moves(), nodes};
}

}  // namespace mrroc::rubik
