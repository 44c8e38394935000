#include "tasks/rubik/solver/first_phase_moves.hpp"

#include <atomic>
#include <thread>
#include <vector>

namespace mrroc::rubik {

constexpr MoveWord::Decoder MoveWord::make_decoder(bool nearer) {
  Decoder decoder{};
  const auto turns = [nearer](unsigned nibble) {
    if (nearer) return nibble < 8 ? nibble : 0;
    return nibble < 8 ? 7 : nibble & 7;
  };
  for (unsigned k = 0; k < decoder.size(); ++k)
    decoder[k] = static_cast<std::uint8_t>(turns(k & 15) | turns(k >> 4) << 3);
  return decoder;
}

constexpr MoveWord::Decoder MoveWord::kNearer = make_decoder(true);
constexpr MoveWord::Decoder MoveWord::kNotFarther = make_decoder(false);

MoveWord MoveWord::of(unsigned distance, std::span<const std::uint8_t, kMoves> distances) {
  std::uint32_t word = distance << kDistanceShift;
  for (int face = 0; face < kFaces; ++face) {
    unsigned nearer = 0, same = 0;
    for (int k = 0; k < 3; ++k) {
      nearer |= static_cast<unsigned>(distances[3 * face + k] < distance) << k;
      same |= static_cast<unsigned>(distances[3 * face + k] == distance) << k;
    }
    word |= (nearer != 0 ? nearer : 8 + same) << (4 * face);
  }
  return MoveWord(word);
}

void build_move_words(const CosetSpace& space, const std::uint8_t* distances, std::span<std::uint32_t> words,
                      int threads, const Progress& progress) {
  const PackedLayout<4> layout{space.rows(), space.columns()};
  const auto row_of = [&](std::uint32_t page) { return distances + page * layout.page_bytes(); };
  std::atomic<int> next{0};
  const auto run = [&] {
    std::vector<std::array<std::uint8_t, kMoves>> after(space.columns());
    for (int page = next++; page < space.pages(); page = next++) {
      for (int m = 0; m < kMoves; ++m) {
        const CosetSpace::Step step = space.step(page, m);
        const std::uint8_t* const row = row_of(step.page);
        const std::uint16_t* const map = space.column_map(m, step.symmetry);
        for (int c = 0; c < space.columns(); ++c)
          after[c][m] = static_cast<std::uint8_t>(get_packed<4>(row, map[c]));
      }
      const std::uint8_t* const row = row_of(static_cast<std::uint32_t>(page));
      for (int c = 0; c < space.columns(); ++c)
        words[static_cast<std::size_t>(page) * space.columns() + c] =
            MoveWord::of(get_packed<4>(row, c), after[c]).word();
      if (progress && page % 1024 == 0) progress(static_cast<double>(page) / space.pages());
    }
  };
  std::vector<std::jthread> others;
  for (int k = 1; k < threads; ++k) others.emplace_back(run);
  run();
}

}  // namespace mrroc::rubik
