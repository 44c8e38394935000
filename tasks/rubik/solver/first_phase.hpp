// The first phase of Kociemba's algorithm: begins of solutions that lead into the second phase's group.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "tasks/rubik/cube/move.hpp"
#include "tasks/rubik/solver/best_solution.hpp"
#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/limits.hpp"
#include "tasks/rubik/solver/second_phase.hpp"

namespace mrroc::rubik {

/// One of the six ways to look at a cube: along an axis, the cube or its inverse.
class Variant {
 public:
  /// @param axis  0..2: that which is looked along as if it were that of U and D  @param inverted  takes the inverse
  Variant(const Cube& cube, int axis, bool inverted);

  /// @return the cube seen so, with its inverse
  [[nodiscard]] const CubePair& pair() const { return pair_; }
  /// @return what solves the cube itself, when the moves solve this variant
  [[nodiscard]] Moves solution(const Moves& moves) const;

 private:
  CubePair pair_;
  int back_;
  bool inverted_;
};

/// Searches begins of one length after the other. One object per thread.
///
/// The search goes depth first, but with blocks of states instead of single ones: while the states of a block
/// are looked at one after the other, the memory for the next ones is on its way.
class FirstPhase {
 public:
  /// @param bounds, best, watch  outlive this object
  FirstPhase(const Bounds& bounds, BestSolution& best, Stopwatch& watch);

  /// Tries all begins of so many turns, and offers what becomes shorter than the best solution so far.
  /// @param turns  at most kMostTurns
  void search(const Variant& variant, int turns);
  /// @return whether the search is to end
  [[nodiscard]] bool over() const { return over_; }
  /// @return number of states that have been looked at
  [[nodiscard]] std::uint64_t nodes() const { return nodes_; }

  static constexpr int kMostTurns = 30;  ///< length of a begin

 private:
  /// Twist, flips and slice, seen through the symmetry that leads to the class's representative.
  struct State {
    std::uint32_t flip_slice_class;
    std::uint16_t twist;
    std::uint8_t symmetry;
  };
  struct Node {
    State state;
    Move move;           ///< that led here
    const Node* parent;  ///< nullptr: the begin of the search
    CubePair pair;
  };
  using Block = std::vector<Node>;

  [[nodiscard]] State state_of(const Cube& cube) const;
  [[nodiscard]] State after(const State& s, int seen_move) const;
  void prefetch(const State& s) const;
  [[nodiscard]] std::uint32_t useful_turns(const State& s, int left) const;
  bool is_over();
  void descend(int depth, int left);
  void expand(const Node& node, int left, Block& next) const;
  void drop_hopeless(Block& block, int spare) const;
  [[nodiscard]] int longest_end(int depth) const;
  void finish_all(const Block& block, int depth);
  void finish(const Node& node, const SecondPhase::State& begin, int depth);

  const Tables& tables_;
  const Bounds& bounds_;
  BestSolution& best_;
  NodeCounter counter_;
  SecondPhase second_;
  const Variant* variant_{};
  std::array<Block, kMostTurns + 1> blocks_;  ///< by depth
  std::uint64_t nodes_{};
  bool over_{};
};

}  // namespace mrroc::rubik
