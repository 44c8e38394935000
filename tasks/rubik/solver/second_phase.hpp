// The second phase of Kociemba's algorithm: from the group of kSecondPhaseMoves to the solved cube.
#pragma once
#include "tasks/rubik/cube/move.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Longest second phase that is searched; the tables tell distances up to here apart.
inline constexpr int kLongestSecondPhase = 11;

/// Searches ends of solutions. One object per thread.
class SecondPhase {
 public:
  /// @param tables  outlives this object
  explicit SecondPhase(const Tables& tables) : tables_(tables) {}

  /// Searches a shortest end.
  /// @param cube  of the group
  /// @param last  the turn before, which the end must not repeat; nullptr: none
  /// @param longest  ends longer than this are of no use
  /// @return whether there is one; then end() is it
  bool solve(const Cube& cube, const Move* last, int longest);
  [[nodiscard]] const Moves& end() const { return end_; }

 private:
  struct State {
    unsigned corners, edges, slice;
  };
  [[nodiscard]] int bound(const State& s) const;
  bool search(const State& s, const Move* last, int turns);

  const Tables& tables_;
  Moves end_;
};

}  // namespace mrroc::rubik
