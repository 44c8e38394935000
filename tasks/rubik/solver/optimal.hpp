// Shortest solutions: iterative-deepening A* (Korf 1985, 1997) with pruning tables as bounds.
#pragma once
#include <functional>
#include <optional>

#include "tasks/rubik/cube/move.hpp"
#include "tasks/rubik/solver/limits.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Up to so many turns a search for the shortest solution goes on beyond its budget.
inline constexpr int kGuaranteedOptimal = 14;

/// What the search for the shortest solution has found.
struct OptimalResult {
  std::optional<Moves> moves;  ///< a shortest solution; nothing when a limit ended the search before
  int lower_bound{};           ///< no solution is shorter
  std::uint64_t nodes{};       ///< expanded
};

/// Searches for a shortest solution.
/// @param cube  reachable
/// @param longest  solutions longer than this are not searched; then moves is empty and lower_bound is longest + 1
[[nodiscard]] OptimalResult solve_optimally(const Tables& tables, const Cube& cube,
                                            const SearchLimits& limits, int longest = 20);

}  // namespace mrroc::rubik
