#include "tasks/rubik/solver/second_phase.hpp"

#include <algorithm>

namespace mrroc::rubik {

SecondPhase::Seen SecondPhase::seen(unsigned corners) const {
  const std::uint32_t member = tables_.corner_permutations.member_of[corners];
  return {member / kAxisSymmetries, member % kAxisSymmetries};
}

/// @return turns that corners and slice need
unsigned SecondPhase::slice_bound(const Seen& seen, unsigned slice) const {
  return tables_.corner_slice(seen.corner_class,
                              tables_.slice_permutation_seen[slice * kAxisSymmetries + seen.symmetry]);
}

int SecondPhase::bound(const State& s) const {
  const Seen c = seen(s.corners);
  const unsigned edges = tables_.edge_permutation_seen[s.edges * kAxisSymmetries + c.symmetry];
  return static_cast<int>(std::max(tables_.phase2(c.corner_class, edges), slice_bound(c, s.slice)));
}

bool SecondPhase::search(const State& s, const Move* last, int turns) {
  // The bound is exact for each of the two tables: with no turns left both parts are solved.
  if (turns == 0) return true;
  constexpr std::size_t kCount = kSecondPhaseMoves.size();
  for (std::size_t k = 0; k < kCount; ++k) {
    const Move& m = kSecondPhaseMoves[k];
    if (!may_follow(last, m)) continue;
    const State next{tables_.corner_permutation_moves[s.corners * kCount + k],
                     tables_.edge_permutation_moves[s.edges * kCount + k],
                     tables_.slice_permutation_moves[s.slice * kCount + k]};
    if (bound(next) > turns - 1) continue;
    end_.push_back(m);
    if (search(next, &m, turns - 1)) return true;
    end_.pop_back();
  }
  return false;
}

std::optional<SecondPhase::State> SecondPhase::start(const Cube& cube, int longest) const {
  State s{static_cast<unsigned>(kCornerPermutation.of(cube)), 0,
          static_cast<unsigned>(kSlicePermutation.of(cube))};
  const Seen c = seen(s.corners);
  if (static_cast<int>(slice_bound(c, s.slice)) > longest) return std::nullopt;
  s.edges = static_cast<unsigned>(kEdgePermutation.of(cube));
  const unsigned edges = tables_.edge_permutation_seen[s.edges * kAxisSymmetries + c.symmetry];
  __builtin_prefetch(tables_.phase2_address(c.corner_class, edges));
  return s;
}

bool SecondPhase::solve(const State& begin, const Move* last, int longest) {
  end_.clear();
  for (int turns = bound(begin); turns <= longest; ++turns)
    if (search(begin, last, turns)) return true;
  return false;
}

}  // namespace mrroc::rubik
