#include "tasks/rubik/solver/two_phase.hpp"

#include <array>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "tasks/rubik/solver/second_phase.hpp"

namespace mrroc::rubik {
namespace {

/// Longer solutions are not looked for; two phases never need as many.
constexpr int kNoSolution = 31;

/// The shortest solution so far, of all threads.
class Best {
 public:
  explicit Best(int good_enough) : good_enough_(good_enough) {}

  [[nodiscard]] int length() const { return length_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool found() const { return length() < kNoSolution; }
  [[nodiscard]] bool good_enough() const { return length() <= good_enough_; }
  void offer(const Moves& moves) {
    const std::lock_guard guard(mutex_);
    if (static_cast<int>(moves.size()) >= length()) return;
    moves_ = moves;
    length_ = static_cast<int>(moves.size());
  }
  [[nodiscard]] const Moves& moves() const { return moves_; }

 private:
  const int good_enough_;
  std::atomic<int> length_{kNoSolution};
  std::mutex mutex_;
  Moves moves_;
};

/// One of the six ways to look at a cube: along an axis, the cube or its inverse.
class Variant {
 public:
  Variant(const Cube& cube, int axis, bool inverted)
      : pair_(CubePair::of(conjugate(inverted ? inverse(cube) : cube, symmetry(axis_rotation(axis))))),
        back_(inverse_symmetry(axis_rotation(axis))),
        inverted_(inverted) {}

  [[nodiscard]] const CubePair& pair() const { return pair_; }
  /// @return what solves the cube itself, when the moves solve this variant
  [[nodiscard]] Moves solution(const Moves& moves) const {
    Moves result;
    for (const Move m : moves) result.push_back(conjugate(m, symmetry(back_)));
    return inverted_ ? inverse(result) : result;
  }

 private:
  CubePair pair_;
  int back_;
  bool inverted_;
};

/// Searches first phases, for one thread.
class FirstPhase {
 public:
  FirstPhase(const Bounds& bounds, Best& best, Stopwatch& watch)
      : tables_(bounds.tables()), bounds_(bounds), best_(best), counter_(watch), second_(tables_) {}

  /// Tries all begins of so many turns.
  void search(const Variant& variant, int turns);
  [[nodiscard]] bool over() const { return over_; }
  [[nodiscard]] std::uint64_t nodes() const { return nodes_; }

 private:
  /// Twist, flips and slice.
  struct State {
    std::uint32_t flip_slice_class;
    std::uint8_t symmetry;  ///< leads to the class's representative
    std::uint16_t twist;
    std::uint16_t twist_seen;  ///< through the symmetry
  };
  [[nodiscard]] State state_of(const Cube& cube) const;
  [[nodiscard]] State after(const State& s, Move m) const;
  void expand(const State& s, int left);
  void finish();
  const CubePair& pair();

  const Tables& tables_;
  const Bounds& bounds_;
  Best& best_;
  NodeCounter counter_;
  SecondPhase second_;
  const Variant* variant_{};
  Moves path_;
  std::array<CubePair, kNoSolution + 1> pairs_;  ///< after the first k turns of the path
  std::size_t known_{};                          ///< pairs that are up to date
  std::uint64_t nodes_{};
  bool over_{};
};

FirstPhase::State FirstPhase::state_of(const Cube& cube) const {
  const std::uint32_t member = tables_.flip_slices.member_of[kFlipSlice.of(cube)];
  const auto twist = static_cast<std::uint16_t>(kTwist.of(cube));
  const auto s = static_cast<std::uint8_t>(member % kAxisSymmetries);
  return {member / kAxisSymmetries, s, twist, tables_.twist_seen[twist * kAxisSymmetries + s]};
}

FirstPhase::State FirstPhase::after(const State& s, Move m) const {
  const unsigned seen = tables_.moves_seen[m.index * kAxisSymmetries + s.symmetry];
  const std::uint32_t member = tables_.flip_slice_moves[s.flip_slice_class * kMoves + seen];
  const std::uint8_t symmetry =
      tables_.symmetry_product[member % kAxisSymmetries * kAxisSymmetries + s.symmetry];
  const std::uint16_t twist = tables_.twist_moves[s.twist * kMoves + m.index];
  return {member / kAxisSymmetries, symmetry, twist, tables_.twist_seen[twist * kAxisSymmetries + symmetry]};
}

/// @return cube and inverse after the turns of the path
const CubePair& FirstPhase::pair() {
  for (; known_ <= path_.size(); ++known_)
    pairs_[known_] = FastTurns::get().after(pairs_[known_ - 1], path_[known_ - 1]);
  return pairs_[path_.size()];
}

/// The path leads into the group: tries to end there.
void FirstPhase::finish() {
  const int longest = std::min(best_.length() - 1 - static_cast<int>(path_.size()), kLongestSecondPhase);
  if (longest < 0 || !second_.solve(pair().cube, path_.empty() ? nullptr : &path_.back(), longest)) return;
  Moves moves = path_;
  moves.insert(moves.end(), second_.end().begin(), second_.end().end());
  best_.offer(variant_->solution(moves));
}

/// @param left  turns of the first phase that are left, at least 1
void FirstPhase::expand(const State& s, int left) {
  ++nodes_;
  over_ = over_ || (counter_.count() && best_.found()) || best_.good_enough();
  if (over_) return;
  const int spare = best_.length() - 1 - static_cast<int>(path_.size());
  if (spare < left) return;
  if (spare < bounds_.largest() && bounds_.exceeds(pair(), spare)) return;

  struct Child {
    State state;
    Move move;
  };
  std::array<Child, kMoves> children;
  int count = 0;
  const Move* const last = path_.empty() ? nullptr : &path_.back();
  for (int m = 0; m < kMoves; ++m) {
    if (!may_follow(last, Move(m))) continue;
    Child& child = children[count++];
    child = {after(s, Move(m)), Move(m)};
    __builtin_prefetch(tables_.phase1_address(child.state.flip_slice_class, child.state.twist_seen));
  }
  for (int k = 0; k < count && !over_; ++k) {
    const Child& child = children[k];
    const auto distance =
        static_cast<int>(tables_.phase1(child.state.flip_slice_class, child.state.twist_seen));
    // The group is entered with the last turn of the first phase, not before.
    if (distance > left - 1 || (distance == 0 && left > 1)) continue;
    path_.push_back(child.move);
    if (left == 1)
      finish();
    else
      expand(child.state, left - 1);
    path_.pop_back();
    known_ = std::min(known_, path_.size() + 1);
  }
}

void FirstPhase::search(const Variant& variant, int turns) {
  variant_ = &variant;
  path_.clear();
  pairs_[0] = variant.pair();
  known_ = 1;
  const State s = state_of(variant.pair().cube);
  const auto distance = static_cast<int>(tables_.phase1(s.flip_slice_class, s.twist_seen));
  if (distance > turns) return;
  if (turns > 0)
    expand(s, turns);
  else
    finish();
}

std::vector<Variant> variants_of(const Cube& cube) {
  std::vector<Variant> variants;
  for (int axis = 0; axis < kAxes; ++axis)
    for (const bool inverted : {false, true}) variants.emplace_back(cube, axis, inverted);
  return variants;
}

}  // namespace

TwoPhaseResult solve_two_phase(const Bounds& bounds, const Cube& cube, const SearchLimits& limits,
                               int good_enough) {
  const std::vector<Variant> variants = variants_of(cube);
  Stopwatch watch(limits);
  Best best(good_enough);
  std::atomic<int> next{0};
  std::atomic<std::uint64_t> nodes{0};
  const auto run = [&] {
    FirstPhase search(bounds, best, watch);
    const int count = static_cast<int>(variants.size());
    for (int job = next++; job / count < best.length() && !search.over(); job = next++)
      search.search(variants[job % count], job / count);
    nodes += search.nodes();
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < limits.threads; ++k) others.emplace_back(run);
    run();
  }
  return {best.moves(), nodes};
}

}  // namespace mrroc::rubik
