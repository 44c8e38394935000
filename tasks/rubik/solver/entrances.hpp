// The last turns of the first phase: all ways into the second phase's group that are a few turns long.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/arrangement.hpp"
#include "tasks/rubik/solver/coordinates.hpp"

namespace mrroc::rubik {

class Tables;

/// A state that is a few turns away from the group has mostly a single pair of ways into it: they are looked up instead
/// of searched turn by turn.
class Entrances {
 public:
  static constexpr int kMostTurns = 6;  ///< of a way

  /// A way into the group. The states that it passes before the last turn are outside. The last one is a clockwise
  /// quarter turn of a side: counterclockwise it leads into the group as well.
  struct alignas(32) Entrance {
    Arrangement pieces;                  ///< what the turns do to the pieces
    std::array<Move, kMostTurns> turns;  ///< in their order, as many as find() was asked for
    std::uint8_t half_turn;              ///< of the last turn's face, in kSecondPhaseMoves
  };

  /// There are none.
  Entrances() = default;
  /// @param tables  all but their entrances
  explicit Entrances(const Tables& tables);

  /// @param flip_slice_class, twist_seen  a state, twist as seen through the symmetry to the class's representative
  /// @return all ways of exactly so many turns, 0 to kMostTurns, as seen through this symmetry
  [[nodiscard]] std::span<const Entrance> find(int turns, std::uint32_t flip_slice_class,
                                               unsigned twist_seen) const {
    const std::uint32_t key = key_of(turns, flip_slice_class, twist_seen);
    std::size_t k = home(key);
    while (slots_[k].key != key && slots_[k].count != 0) k = next(k);
    return {entrances_.data() + slots_[k].first, slots_[k].count};
  }
  /// Fetches the memory that find() reads first.
  [[gnu::always_inline]] void prefetch(int turns, std::uint32_t flip_slice_class, unsigned twist_seen) const {
    __builtin_prefetch(slots_.data() + home(key_of(turns, flip_slice_class, twist_seen)));
  }

 private:
  /// Entrances of a key; count 0: free.
  struct Slot {
    std::uint32_t key, first, count;
  };
  class Collector;

  [[nodiscard]] std::uint32_t key_of(int turns, std::uint32_t flip_slice_class, unsigned twist_seen) const {
    return (static_cast<std::uint32_t>(turns) * classes_ + flip_slice_class) * kTwists + twist_seen;
  }
  [[nodiscard]] std::size_t home(std::uint32_t key) const { return key * kScatter >> shift_; }
  [[nodiscard]] std::size_t next(std::size_t slot) const { return slot + 1 < slots_.size() ? slot + 1 : 0; }

  static constexpr std::uint32_t kScatter = 2654435769;  ///< 2^32 by the golden ratio: Fibonacci hashing
  std::uint32_t classes_{};
  int shift_{};                      ///< leaves as many bits as number the slots
  std::vector<Entrance> entrances_;  ///< those of a key side by side
  std::vector<Slot> slots_;          ///< a hash table with linear probing
};

}  // namespace mrroc::rubik
