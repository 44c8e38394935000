// The turns that lead nearer to the second phase's group: one word for each state of the first phase.
#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "tasks/rubik/solver/coset_space.hpp"
#include "tasks/rubik/solver/table_builder.hpp"

namespace mrroc::rubik {

/// A state's distance and what each turn does to it. The three turns of a face lead to states that are one turn
/// from each other, so either none of them leads away or none leads nearer: four bits for a face.
class MoveWord {
 public:
  /// @param word  bits 4 f to 4 f + 3 for face f: a mask of turns that lead nearer (1 to 7), or 8 + a mask of turns
  ///        that keep the distance while the others lead away; from bit 24 the distance
  constexpr explicit MoveWord(std::uint32_t word) : word_(word) {}
  /// @param distances  after each turn; they differ by at most 1 from distance
  [[nodiscard]] static MoveWord of(unsigned distance, std::span<const std::uint8_t, kMoves> distances);

  /// @return as the constructor takes it
  [[nodiscard]] constexpr std::uint32_t word() const { return word_; }
  /// @return turns to the second phase's group
  [[nodiscard]] constexpr int distance() const { return static_cast<int>(word_ >> kDistanceShift); }
  /// @return mask of the turns, by number, after which the distance is smaller
  [[nodiscard]] std::uint32_t nearer() const { return decode(kNearer); }
  /// @return mask of the turns after which the distance is not larger
  [[nodiscard]] std::uint32_t not_farther() const { return decode(kNotFarther); }

 private:
  static constexpr int kDistanceShift = 24;
  using Decoder = std::array<std::uint8_t, 256>;  ///< two faces at once
  static const Decoder kNearer;
  static const Decoder kNotFarther;
  static constexpr Decoder make_decoder(bool nearer);
  [[nodiscard]] std::uint32_t decode(const Decoder& decoder) const {
    return decoder[word_ & 0xff] | decoder[(word_ >> 8) & 0xff] << 6U | decoder[(word_ >> 16) & 0xff] << 12U;
  }

  std::uint32_t word_;
};

/// Makes the words of all states from the table of their distances.
/// @param space  of the first phase, one row
/// @param distances  of the space, four bits
/// @param words  [page * columns + column]
void build_move_words(const CosetSpace& space, const std::uint8_t* distances, std::span<std::uint32_t> words,
                      int threads, const Progress& progress);

}  // namespace mrroc::rubik
