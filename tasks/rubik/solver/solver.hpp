// The cube's solver: tables, bounds and both algorithms behind one door.
#pragma once
#include <filesystem>

#include "tasks/rubik/cube/move.hpp"
#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/limits.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Up to so many turns a shortest solution is searched whatever the limits.
inline constexpr int kGuaranteedOptimal = 14;

/// A solution, and what is known about shorter ones.
struct Solution {
  Moves moves;        ///< solves the cube
  int lower_bound{};  ///< no solution has fewer turns
  /// @return whether it is proven that no solution is shorter
  [[nodiscard]] bool optimal() const { return static_cast<int>(moves.size()) <= lower_bound; }
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

  /// A short solution by the two-phase algorithm, better the longer it may search. There is always one, the first
  /// after about a millisecond. With one thread, limits.nodes and no budget it is the same in every run.
  /// @param cube  reachable
  /// @param good_enough  a solution of at most so many turns ends the search
  [[nodiscard]] Solution solve(const Cube& cube, const SearchLimits& limits, int good_enough = 0) const;

  /// A shortest solution: proven to be one if it has up to kGuaranteedOptimal turns or the limits suffice, else the
  /// best that the two-phase algorithm found in a tenth of the budget.
  /// @param cube  reachable
  [[nodiscard]] Solution solve_optimally(const Cube& cube, const SearchLimits& limits) const;

 private:
  Tables tables_;
  Bounds bounds_;
};

}  // namespace mrroc::rubik
