#include "tasks/rubik/solver/first_phase.hpp"

#include <algorithm>
#include <bit>

#include "tasks/rubik/cube/symmetry.hpp"
#include "tasks/rubik/solver/first_phase_moves.hpp"

namespace mrroc::rubik {
namespace {

/// Enough for memory to arrive while a block is worked on, and all blocks of a search stay in the second cache.
constexpr std::size_t kBlock = 256;

/// Along the axis of the first phase a state near the group looks near, and so does its inverse: only the others
/// are worth a look.
constexpr std::array kViewOrder{1, 2, 4, 5};

/// With so few turns of the first phase left, going on costs no more than a look at the other axes.
constexpr int kNotWorthALook = 2;

constexpr std::uint32_t kAllTurns = (1U << kMoves) - 1;

}  // namespace

Variant::Variant(const Cube& cube, int axis, bool inverted)
    : pair_(CubePair::of(conjugate(inverted ? inverse(cube) : cube, symmetry(axis_rotation(axis))))),
      back_(inverse_symmetry(axis_rotation(axis))),
      inverted_(inverted) {}

Moves Variant::solution(const Moves& moves) const {
  Moves result;
  for (const Move m : moves) result.push_back(conjugate(m, symmetry(back_)));
  return inverted_ ? inverse(result) : result;
}

FirstPhase::FirstPhase(const Bounds& bounds, BestSolution& best, Stopwatch& watch)
    : tables_(bounds.tables()), bounds_(bounds), best_(best), counter_(watch), second_(tables_) {
  for (Block& block : blocks_) block.reserve(kBlock + kMoves);
}

FirstPhase::State FirstPhase::state_of(const Cube& cube) const {
  const std::uint32_t member = tables_.flip_slices.member_of[kFlipSlice.of(cube)];
  const auto s = static_cast<std::uint8_t>(member % kAxisSymmetries);
  return {member / kAxisSymmetries, tables_.twist_seen[kTwist.of(cube) * kAxisSymmetries + s], s};
}

FirstPhase::State FirstPhase::after(const State& s, int seen_move) const {
  const std::uint32_t member = tables_.flip_slice_moves[s.flip_slice_class * kMoves + seen_move];
  const std::uint32_t further = member % kAxisSymmetries;
  const unsigned twist = tables_.twist_moves[s.twist * kMoves + seen_move];
  return {member / kAxisSymmetries, tables_.twist_seen[twist * kAxisSymmetries + further],
          tables_.symmetry_product[further * kAxisSymmetries + s.symmetry]};
}

/// Fetches what expand() needs. g++ 12 takes a function that does nothing but fetch for one without effect, and leaves
/// out calls of it: it has to become part of its caller.
[[gnu::always_inline]] inline void FirstPhase::prefetch(const State& s) const {
  if (tables_.has_move_words()) __builtin_prefetch(tables_.move_word_address(s.flip_slice_class, s.twist));
  const std::uint32_t* const row = tables_.flip_slice_moves.data() + s.flip_slice_class * kMoves;
  __builtin_prefetch(row);
  __builtin_prefetch(row + kMoves - 1);
}

/// @return mask of the seen turns after which the group is within reach, as far as the table of move words tells
std::uint32_t FirstPhase::useful_turns(const State& s, int left) const {
  if (!tables_.has_move_words()) return kAllTurns;
  const MoveWord word(*tables_.move_word_address(s.flip_slice_class, s.twist));
  const int slack = left - word.distance();
  std::uint32_t turns = slack == 0 ? word.nearer() : slack == 1 ? word.not_farther() : kAllTurns;
  // The group is entered with the last turn of the first phase, not before.
  if (left > 1 && word.distance() == 1) turns &= ~word.nearer();
  if (left > 1 && word.distance() == 0) turns &= ~word.not_farther();
  return turns;
}

void FirstPhase::expand(const Node& node, int left, Block& next) const {
  const Move* const last = node.parent != nullptr ? &node.move : nullptr;
  const std::size_t begin = next.size();
  const int back = inverse_symmetry(node.state.symmetry);
  for (std::uint32_t turns = useful_turns(node.state, left); turns != 0; turns &= turns - 1) {
    const int seen = std::countr_zero(turns);
    const Move m(tables_.moves_seen[seen * kAxisSymmetries + back]);
    if (!may_follow(last, m)) continue;
    next.push_back({after(node.state, seen), m, &node, {}});
    if (!tables_.has_move_words())
      __builtin_prefetch(tables_.phase1_address(next.back().state.flip_slice_class, next.back().state.twist));
  }
  if (!tables_.has_move_words()) {
    const auto useless = [this, left](const Node& n) {
      const auto distance = static_cast<int>(tables_.phase1(n.state.flip_slice_class, n.state.twist));
      return distance > left - 1 || (distance == 0 && left > 1);
    };
    next.erase(std::remove_if(next.begin() + static_cast<std::ptrdiff_t>(begin), next.end(), useless),
               next.end());
  }
  for (std::size_t k = begin; k < next.size(); ++k) {
    prefetch(next[k].state);
    next[k].pair = FastTurns::get().after(node.pair, next[k].move);
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
      const CubePair& pair = block[k].pair;
      if (other_cube) coordinates[k] = bounds_.coordinates(view < kAxes ? pair.cube : pair.inverse);
      probes[k] = bounds_.probe(coordinates[k], view % kAxes);
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < block.size(); ++k) {
      if (bounds_.bound(probes[k], spare) > spare) continue;
      coordinates[kept] = coordinates[k];
      if (kept != k) block[kept] = block[k];
      ++kept;
    }
    block.resize(kept);
  }
}

/// The node is in the group: tries to end there.
void FirstPhase::finish(const Node& node, const SecondPhase::State& begin, int depth) {
  const Move* const last = node.parent != nullptr ? &node.move : nullptr;
  if (!second_.solve(begin, last, longest_end(depth))) return;
  Moves moves;
  for (const Node* n = &node; n->parent != nullptr; n = n->parent) moves.push_back(n->move);
  std::ranges::reverse(moves);
  moves.insert(moves.end(), second_.end().begin(), second_.end().end());
  best_.offer(variant_->solution(moves));
}

void FirstPhase::finish_all(const Block& block, int depth) {
  std::array<std::optional<SecondPhase::State>, kBlock + kMoves> begins;
  for (std::size_t k = 0; k < block.size(); ++k)
    begins[k] = second_.start(block[k].pair.cube, longest_end(depth));
  for (std::size_t k = 0; k < block.size() && !is_over(); ++k)
    if (begins[k]) finish(block[k], *begins[k], depth);
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
  if (left > kNotWorthALook && spare < bounds_.largest() - 1) drop_hopeless(block, spare);
  if (left == 0) return finish_all(block, depth);
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
  const State s = state_of(variant.pair().cube);
  if (static_cast<int>(tables_.phase1(s.flip_slice_class, s.twist)) > turns) return;
  blocks_[0].assign(1, {s, Move(), nullptr, variant.pair()});
  descend(0, turns);
}

}  // namespace mrroc::rubik
