// The second phase of Kociemba's algorithm: from the group of kSecondPhaseMoves to the solved cube.
#pragma once
#include <optional>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/arrangement.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Longest second phase that is searched; the tables tell distances up to here apart.
inline constexpr int kLongestSecondPhase = 11;

/// Searches ends of solutions. One object per thread.
class SecondPhase {
 public:
  /// @param tables  outlives this object
  explicit SecondPhase(const Tables& tables) : tables_(tables) {}

  /// State at which an end begins.
  struct State {
    unsigned corners, edges, slice;  ///< permutations of these, see coordinates.hpp
  };
  /// @param before, turns  an arrangement and what turns that lead into the group make of it
  /// @return the state there; nothing when corners and slice alone need more turns than longest
  [[nodiscard]] std::optional<State> start(const Arrangement& before, const Arrangement& turns,
                                           int longest) const;
  /// @param k  a turn, kSecondPhaseMoves[k]
  /// @return the state after it
  [[nodiscard]] State after(const State& s, std::size_t k) const {
    return {tables_.corner_permutation_moves[s.corners * kSecondPhaseMoves.size() + k],
            tables_.edge_permutation_moves[s.edges * kSecondPhaseMoves.size() + k],
            tables_.slice_permutation_moves[s.slice * kSecondPhaseMoves.size() + k]};
  }
  /// @return whether corners and slice alone need at most so many turns; then the memory that tells how far the state
  ///         is from solved is on its way
  [[nodiscard]] bool is_near(const State& s, int longest) const;

  /// Searches a shortest end.
  /// @param last  the turn before, which the end must not repeat; nullptr: none
  /// @param longest  ends longer than this are of no use
  /// @return whether there is one; then end() is it
  bool solve(const State& begin, const Move* last, int longest);
  /// @return turns of the end that solve() has found; valid until its next call
  [[nodiscard]] const Moves& end() const { return end_; }

 private:
  /// A coordinate's class and the symmetry that leads to its representative.
  struct Seen {
    std::uint32_t corner_class, symmetry;
  };
  [[nodiscard]] Seen seen(unsigned corners) const;
  [[nodiscard]] unsigned slice_bound(const Seen& seen, unsigned slice) const;
  [[nodiscard]] int bound(const State& s) const;
  bool search(const State& s, const Move* last, int turns);

  const Tables& tables_;
  Moves end_;
};

}  // namespace mrroc::rubik
