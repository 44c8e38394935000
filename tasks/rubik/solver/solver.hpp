// The cube's solver: the common interface of tables, bounds and both algorithms.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/limits.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Up to so many turns a shortest solution is searched before any other.
inline constexpr int kGuaranteedOptimal = 14;

/// Which search found a solution.
enum class Search : std::uint8_t { ida_star, two_phase };

/// A solution, and what is known about shorter ones.
struct Solution {
  Moves moves{};      ///< solves the cube
  int lower_bound{};  ///< no solution has fewer turns
  Search by{};        ///< found it
  /// @return whether it is proven that no solution is shorter
  [[nodiscard]] bool optimal() const { return static_cast<int>(moves.size()) <= lower_bound; }
};

/// @return for people: which search found it, and what is proven
[[nodiscard]] std::string describe(const Solution& solution);

/// Limits of the two searches of CubeSolver::solve().
struct SolveLimits {
  SearchLimits shortest{};   ///< of iterative-deepening A*, which comes first
  SearchLimits two_phase{};  ///< of the two-phase algorithm, if there is no shortest solution
  /// Of wall time for both: what the first one has used up is taken from the second; max: none.
  std::chrono::microseconds both{std::chrono::microseconds::max()};
};

/// Solves cubes. Any number of threads may use one object.
class CubeSolver {
 public:
  /// Opens the tables, and makes those that are missing: seconds or minutes, see TableSet.
  /// @param folder  where the tables are, usually table_folder(); empty: they are made anew and not kept
  /// @param threads  for making tables, at least 1
  CubeSolver(TableSet set, const std::filesystem::path& folder, int threads, const TableWatch& watch = {})
      : tables_(set, folder, threads, watch), bounds_(tables_) {}
  CubeSolver(const CubeSolver&) = delete;
  CubeSolver& operator=(const CubeSolver&) = delete;

  /// A shortest solution, proven, if it has up to kGuaranteedOptimal turns and limits.shortest suffice to find it, else
  /// a short one as of solve_in_two_phases(). With one thread, nodes as limits and no budget it is the same in every run.
  /// @param cube  reachable
  [[nodiscard]] Solution solve(const Cube& cube, const SolveLimits& limits) const;

  /// A short solution by the two-phase algorithm, better the longer it may search. There is always one, the first
  /// after about a millisecond. With one thread, limits.nodes and no budget it is the same in every run.
  /// @param cube  reachable
  [[nodiscard]] Solution solve_in_two_phases(const Cube& cube, const SearchLimits& limits) const;

  /// A shortest solution: proven to be one if it has up to kGuaranteedOptimal turns or the limits suffice, else the
  /// best that the two-phase algorithm found in a tenth of the budget.
  /// @param cube  reachable
  [[nodiscard]] Solution solve_optimally(const Cube& cube, const SearchLimits& limits) const;

 private:
  Tables tables_;
  Bounds bounds_;
};

}  // namespace mrroc::rubik
