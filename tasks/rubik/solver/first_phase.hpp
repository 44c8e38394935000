// The first phase of Kociemba's algorithm: beginnings of solutions that lead into the second phase's group.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/best_solution.hpp"
#include "tasks/rubik/solver/bounds.hpp"
#include "tasks/rubik/solver/entrances.hpp"
#include "tasks/rubik/solver/fast_cube.hpp"
#include "tasks/rubik/solver/limits.hpp"
#include "tasks/rubik/solver/second_phase.hpp"

namespace mrroc::rubik {

/// One of the six ways to look at a cube: along an axis, the cube or its inverse.
class Variant {
 public:
  /// @param axis  0..2: that which is looked along as if it were that of U and D  @param inverted  takes the inverse
  Variant(const Cube& cube, int axis, bool inverted);

  /// @return the cube seen so
  [[nodiscard]] const Cube& cube() const { return cube_; }
  /// @return what solves the cube itself, when the moves solve this variant
  [[nodiscard]] Moves solution(const Moves& moves) const;

 private:
  Cube cube_;
  int back_;
  bool inverted_;
};

/// Searches begins of one length after the other. One object per thread.
///
/// The search goes depth first, but with blocks of states instead of single ones: the memory that a block needs is
/// fetched before the first one is looked at. The last turns come from Entrances.
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
  struct Node {
    CosetState state;
    Move move;           ///< that led here
    const Node* parent;  ///< nullptr: the begin of the search
    Cube cube;

    Node(const CosetState& s, const Cube& c) : state(s), parent(nullptr), cube(c) {}
    Node(const CosetState& s, const FastTurns& turns, Move m, const Node& before)
        : state(s), move(m), parent(&before), cube(turns.after(before.cube, m)) {}
  };
  using Block = std::vector<Node>;
  /// A way into the group from a node, and where the second phase begins.
  struct Begin {
    const Node* node;
    const Entrances::Entrance* entrance;
    bool reversed;  ///< the last turn is counterclockwise
    SecondPhase::State state;
  };

  void prefetch(const CosetState& s, int left) const;
  [[nodiscard]] std::uint32_t followers(const Node& node) const;
  [[nodiscard]] std::uint32_t useful_turns(const CosetState& s, std::uint32_t turns, int left) const;
  bool is_over();
  void descend(int depth, int left);
  void expand(const Node& node, int left, Block& next) const;
  void drop_hopeless(Block& block, int spare) const;
  [[nodiscard]] int longest_end(int depth) const;
  void finish_all(const Block& block, int depth, int left);
  void note(const Begin& begin, int longest);
  void finish(const Begin& begin, int depth, int left);

  const Tables& tables_;
  const FastTurns& turns_;
  const SeenArrangements& arrangements_;
  const Bounds& bounds_;
  BestSolution& best_;
  NodeCounter counter_;
  SecondPhase second_;
  const Variant* variant_{};
  std::array<Block, kMostTurns + 1> blocks_;  ///< by depth
  std::vector<Begin> begins_;
  std::uint64_t nodes_{};
  bool over_{};
};

}  // namespace mrroc::rubik
