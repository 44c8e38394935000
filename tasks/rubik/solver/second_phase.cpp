#include "tasks/rubik/solver/second_phase.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace mrroc::rubik {
namespace {

constexpr int kFirstSliceEdge = 8;

/// @return at(0) ... at(3), numbers from 0 to 7, in three bits each
template <class At>
constexpr unsigned pack_four(At&& at) {
  return at(0) | at(1) << 3U | at(2) << 6U | at(3) << 9U;
}

/// Numbers of permutations, in lexicographic order, by halves.
struct HalfRanks {
  std::array<std::uint16_t, 1 << 12> first{};  ///< share of the first four of eight
  std::array<std::uint8_t, 1 << 12> last{};    ///< share of the last four: number of their order

  constexpr HalfRanks() {
    for (unsigned four = 0; four < first.size(); ++four) {
      unsigned rank = 0, order = 0, used = 0;
      for (unsigned k = 0; k < 4; ++k) {
        const unsigned v = (four >> (3 * k)) & 7;
        rank = rank * (8 - k) + v - static_cast<unsigned>(std::popcount(used & ((1U << v) - 1)));
        unsigned smaller = 0;
        for (unsigned j = k + 1; j < 4; ++j) smaller += ((four >> (3 * j)) & 7) < v;
        order = order * (4 - k) + smaller;
        used |= 1U << v;
      }
      first[four] = static_cast<std::uint16_t>(kSlicePermutations * rank);
      last[four] = static_cast<std::uint8_t>(order);
    }
  }
};
constexpr HalfRanks kRanks;

/// @return number of the permutation at(0) ... at(7), as kCornerPermutation and kEdgePermutation count
template <class At>
unsigned rank_of_eight(At&& at) {
  return kRanks.first[pack_four(at)] + kRanks.last[pack_four([&at](int k) { return at(4 + k); })];
}

/// @return number of the permutation at(0) ... at(3) of any four numbers, as kSlicePermutation counts
template <class At>
unsigned rank_of_four(At&& at) {
  return kRanks.last[pack_four([&at](int k) { return at(k) & 7U; })];
}

}  // namespace

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
  for (std::size_t k = 0; k < kSecondPhaseMoves.size(); ++k) {
    const Move& m = kSecondPhaseMoves[k];
    if (!may_follow(last, m)) continue;
    const State next = after(s, k);
    if (bound(next) > turns - 1) continue;
    end_.push_back(m);
    if (search(next, &m, turns - 1)) return true;
    end_.pop_back();
  }
  return false;
}

std::optional<SecondPhase::State> SecondPhase::start(const Arrangement& before, const Arrangement& turns,
                                                     int longest) const {
  State s{};
  s.corners = rank_of_eight([&](int k) { return before.corners[turns.corners[k]]; });
  s.slice = rank_of_four([&](int k) { return before.edges[turns.edges[kFirstSliceEdge + k]]; });
  if (static_cast<int>(slice_bound(seen(s.corners), s.slice)) > longest) return std::nullopt;
  s.edges = rank_of_eight([&](int k) { return before.edges[turns.edges[k]]; });
  return s;
}

bool SecondPhase::is_near(const State& s, int longest) const {
  const Seen c = seen(s.corners);
  if (static_cast<int>(slice_bound(c, s.slice)) > longest) return false;
  const unsigned edges = tables_.edge_permutation_seen[s.edges * kAxisSymmetries + c.symmetry];
  __builtin_prefetch(tables_.phase2_address(c.corner_class, edges));
  return true;
}

bool SecondPhase::solve(const State& begin, const Move* last, int longest) {
  end_.clear();
  for (int turns = bound(begin); turns <= longest; ++turns)
    if (search(begin, last, turns)) return true;
  return false;
}

}  // namespace mrroc::rubik
