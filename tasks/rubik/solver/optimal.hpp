// Finds shortest solutions: iterative-deepening A* (Korf 1985, 1997) with pruning tables as bounds.
#pragma once
#include <optional>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/limits.hpp"

namespace mrroc::rubik {

/// Result of the search for a shortest solution.
struct OptimalResult {
  std::optional<Moves>
      moves;          ///< a shortest solution; nothing if there is none so short, or a limit ended the search
  int lower_bound{};  ///< no solution is shorter
  std::uint64_t nodes{};  ///< expanded
};

/// Which lengths to search, both included.
struct Lengths {
  int shortest{0};  ///< turns
  int longest{20};  ///< no cube needs more (Rokicki, Kociemba, Davidson, Dethridge 2013)
};

/// Searches for a shortest solution.
/// @param cube  reachable
/// @param lengths  that there is no solution shorter than lengths.shortest is taken for granted
[[nodiscard]] OptimalResult solve_optimally(const Bounds& bounds, const Cube& cube,
                                            const SearchLimits& limits, const Lengths& lengths = {});

}  // namespace mrroc::rubik
