#include "tasks/rubik/solver/first_phase.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <span>

#include "base/cube/symmetry.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/first_phase_moves.hpp"

namespace mrroc::rubik {
namespace {

/// Enough for the memory of a block to arrive together, and all blocks of a search stay in the second cache.
constexpr std::size_t kBlock = 128;

/// Along the axis of the first phase a state near the group looks near, and so does its inverse: only the others
/// are worth a look.
constexpr std::array kViewOrder{1, 2, 4, 5};

constexpr std::uint32_t kAllTurns = (1U << kMoves) - 1;

}  // namespace

Variant::Variant(const Cube& cube, int axis, bool inverted)
    : cube_(conjugate(inverted ? inverse(cube) : cube, symmetry(axis_rotation(axis)))),
      back_(inverse_symmetry(axis_rotation(axis))),
      inverted_(inverted) {}

Moves Variant::solution(const Moves& moves) const {
  Moves result;
  for (const Move m : moves) result.push_back(conjugate(m, symmetry(back_)));
  return inverted_ ? inverse(result) : result;
}

FirstPhase::FirstPhase(const Bounds& bounds, BestSolution& best, Stopwatch& watch)
    : tables_(bounds.tables()),
      turns_(FastTurns::get()),
      arrangements_(SeenArrangements::get()),
      bounds_(bounds),
      best_(best),
      counter_(watch),
      second_(tables_) {}

/// Fetches what expand() or finish_all() needs. g++ 12 takes a function that does nothing but fetch for one without
/// effect, and leaves out calls of it: it has to become part of its caller.
[[gnu::always_inline]] inline void FirstPhase::prefetch(const CosetState& s, int left) const {
  if (left <= Entrances::kMostTurns) return tables_.entrances.prefetch(left, s.flip_slice_class, s.twist);
  if (tables_.has_move_words()) __builtin_prefetch(tables_.move_word_address(s.flip_slice_class, s.twist));
  const std::uint32_t* const row = tables_.flip_slice_moves.data() + s.flip_slice_class * kMoves;
  __builtin_prefetch(row);
  __builtin_prefetch(row + kMoves - 1);
}

/// @return mask of the seen turns that may follow the one that led to the node
std::uint32_t FirstPhase::followers(const Node& node) const {
  if (node.parent == nullptr) return kAllTurns;
  return tables_.followers_seen[node.move.index * kAxisSymmetries + node.state.symmetry];
}

/// @return those of the seen turns after which the group is within reach, as far as the tables tell; more than
///         Entrances::kMostTurns are left
std::uint32_t FirstPhase::useful_turns(const CosetState& s, std::uint32_t turns, int left) const {
  std::uint32_t useful = 0;
  if (tables_.has_move_words()) {
    const MoveWord word(*tables_.move_word_address(s.flip_slice_class, s.twist));
    const int slack = left - word.distance();
    useful = slack == 0 ? word.nearer() : slack == 1 ? word.not_farther() : kAllTurns;
    // The group is entered with the last turn of the first phase only.
    if (word.distance() == 1) useful &= ~word.nearer();
    if (word.distance() == 0) useful &= ~word.not_farther();
    return useful & turns;
  }
  for (; turns != 0; turns &= turns - 1) {
    const CosetState next = tables_.after(s, std::countr_zero(turns));
    const auto distance = static_cast<int>(tables_.phase1(next.flip_slice_class, next.twist));
    if (distance > 0 && distance < left) useful |= turns & -turns;
  }
  return useful;
}

void FirstPhase::expand(const Node& node, int left, Block& next) const {
  const int back = inverse_symmetry(node.state.symmetry);
  for (std::uint32_t turns = useful_turns(node.state, followers(node), left); turns != 0;
       turns &= turns - 1) {
    const int seen = std::countr_zero(turns);
    const Move m(tables_.moves_seen[seen * kAxisSymmetries + back]);
    next.emplace_back(tables_.after(node.state, seen), turns_, m, node);
  }
}

/// Leaves out states that need more than so many turns.
void FirstPhase::drop_hopeless(Block& block, int spare) const {
  std::array<AxisCoordinates, kBlock + kMoves> coordinates;
  std::array<Probe, kBlock + kMoves> probes;
  for (std::size_t v = 0; v < kViewOrder.size(); ++v) {
    const int view = kViewOrder[v];
    const bool other_cube = v == 0 || view / kAxes != kViewOrder[v - 1] / kAxes;
    for (std::size_t k = 0; k < block.size(); ++k) {
      const Cube& cube = block[k].cube;
      if (other_cube) coordinates[k] = bounds_.coordinates(view < kAxes ? cube : inverse(cube));
      probes[k] = bounds_.probe(coordinates[k], view % kAxes);
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (bounds_.bound(probes[k], spare) > spare) continue;
      coordinates[kept] = coordinates[k];
      if (kept != k) block[kept] = block[k];
      ++kept;
    }
    block.erase(block.begin() + static_cast<std::ptrdiff_t>(kept), block.end());
  }
}

/// Tries to end where the begin leads.
void FirstPhase::finish(const Begin& begin, int depth, int left) {
  const auto& turns = begin.entrance->turns;
  Moves entrance(turns.begin(), turns.begin() + left);
  if (begin.reversed) entrance.back() = entrance.back().inverse();
  if (!second_.solve(begin.state, entrance.empty() ? nullptr : &entrance.back(), longest_end(depth + left)))
    return;
  Moves moves;
  for (const Node* n = begin.node; n->parent != nullptr; n = n->parent) moves.push_back(n->move);
  std::ranges::reverse(moves);
  const int back = inverse_symmetry(begin.node->state.symmetry);
  const auto unseen = [&](Move m) { return Move(tables_.moves_seen[m.index * kAxisSymmetries + back]); };
  std::ranges::transform(entrance, std::back_inserter(moves), unseen);
  std::ranges::transform(second_.end(), std::back_inserter(moves), unseen);
  best_.offer(variant_->solution(moves));
}

/// Keeps the begin, if the second phase may be as short as this.
void FirstPhase::note(const Begin& begin, int longest) {
  if (second_.is_near(begin.state, longest)) begins_.push_back(begin);
}

/// Tries all ways into the group of so many turns from the block of the depth.
void FirstPhase::finish_all(const Block& block, int depth, int left) {
  std::array<std::span<const Entrances::Entrance>, kBlock + kMoves> entrances;
  for (std::size_t k = 0; k < block.size(); ++k) {
    entrances[k] = tables_.entrances.find(left, block[k].state.flip_slice_class, block[k].state.twist);
    __builtin_prefetch(entrances[k].data());
  }
  const int longest = longest_end(depth + left);
  begins_.clear();
  for (std::size_t k = 0; k < block.size() && !is_over(); ++k) {
    const Node& node = block[k];
    const Arrangement seen = arrangements_.of(node.cube, node.state.symmetry);
    const std::uint32_t turns = followers(node);
    for (const Entrances::Entrance& entrance : entrances[k]) {
      if (left > 0 && ((turns >> entrance.turns[0].index) & 1) == 0) continue;
      // Counterclockwise the last turn leads elsewhere in the group, to a state at most one turn nearer.
      const auto state = second_.start(seen, entrance.pieces, longest + 1);
      if (!state) continue;
      note({&node, &entrance, false, *state}, longest);
      if (left > 0) note({&node, &entrance, true, second_.after(*state, entrance.half_turn)}, longest);
    }
  }
  for (const Begin& begin : begins_) {
    if (over_ || best_.good_enough()) return;
    finish(begin, depth, left);
  }
}

/// @return turns of a second phase, behind so many, that make a solution shorter than the best one
int FirstPhase::longest_end(int depth) const {
  return std::min(best_.length() - 1 - depth, kLongestSecondPhase);
}

/// Counts a node. @return whether the search is to end
bool FirstPhase::is_over() {
  ++nodes_;
  over_ = over_ || (counter_.count() && best_.found()) || best_.good_enough();
  return over_;
}

/// Searches on from the block of the depth, with so many turns of the first phase left.
void FirstPhase::descend(int depth, int left) {
  Block& block = blocks_[depth];
  const int spare = best_.length() - 1 - depth;
  if (spare < left) return;
  if (spare < bounds_.largest() - 1) drop_hopeless(block, spare);
  for (const Node& node : block) prefetch(node.state, left);
  if (left <= Entrances::kMostTurns) return finish_all(block, depth, left);
  Block& next = blocks_[depth + 1];
  next.clear();
  for (const Node& node : block) {
    if (is_over()) return;
    expand(node, left, next);
    if (next.size() < kBlock) continue;
    descend(depth + 1, left - 1);
    next.clear();
  }
  if (!next.empty()) descend(depth + 1, left - 1);
}

void FirstPhase::search(const Variant& variant, int turns) {
  variant_ = &variant;
  const CosetState s = tables_.state_of(variant.cube());
  if (static_cast<int>(tables_.phase1(s.flip_slice_class, s.twist)) > turns) return;
  blocks_[0].assign(1, {s, variant.cube()});
  descend(0, turns);
}

}  // namespace mrroc::rubik
