#include "tasks/rubik/solver/second_phase.hpp"

#include <algorithm>

namespace mrroc::rubik {

int SecondPhase::bound(const State& s) const {
  const std::uint32_t member = tables_.corner_permutations.member_of[s.corners];
  const std::uint32_t corner_class = member / kAxisSymmetries;
  const std::uint32_t seen = member % kAxisSymmetries;
  const unsigned edges = tables_.edge_permutation_seen[s.edges * kAxisSymmetries + seen];
  const unsigned slice = tables_.slice_permutation_seen[s.slice * kAxisSymmetries + seen];
  return static_cast<int>(
      std::max(tables_.phase2(corner_class, edges), tables_.corner_slice(corner_class, slice)));
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

bool SecondPhase::solve(const Cube& cube, const Move* last, int longest) {
  const State s{static_cast<unsigned>(kCornerPermutation.of(cube)),
                static_cast<unsigned>(kEdgePermutation.of(cube)),
                static_cast<unsigned>(kSlicePermutation.of(cube))};
  end_.clear();
  for (int turns = bound(s); turns <= longest; ++turns)
    if (search(s, last, turns)) return true;
  return false;
}

}  // namespace mrroc::rubik
