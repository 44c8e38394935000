#include "tasks/rubik/solver/first_phase_moves.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mrroc::rubik {
namespace {

TEST(MoveWord, TellsWhichTurnsLeadNearer) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 5000; ++k) {
    const auto distance = static_cast<unsigned>(1 + random() % 9);
    std::array<std::uint8_t, kMoves> after;
    std::uint32_t nearer = 0, not_farther = 0;
    for (int face = 0; face < kFaces; ++face) {
      const unsigned smallest = distance - 1 + random() % 2;
      for (int q = 0; q < 3; ++q) {
        const int m = 3 * face + q;
        after[m] = static_cast<std::uint8_t>(smallest + random() % 2);
        nearer |= static_cast<std::uint32_t>(after[m] < distance) << m;
        not_farther |= static_cast<std::uint32_t>(after[m] <= distance) << m;
      }
    }
    const MoveWord word = MoveWord::of(distance, after);
    ASSERT_EQ(word.distance(), static_cast<int>(distance));
    ASSERT_EQ(word.nearer(), nearer);
    ASSERT_EQ(word.not_farther(), not_farther);
  }
}

TEST(MoveWord, IsMadeForEveryStateFromTheDistancesAround) {
  const SymmetryClasses permutations(kCornerPermutation);
  const CosetSpace space(kCornerPermutation, permutations, nullptr, kTetrad, all_moves());
  const PackedLayout<4> layout{1, space.columns()};
  std::vector<std::uint8_t> table(layout.bytes(space.pages()));
  static_cast<void>(build_table<4>(space, table, 14, 1, {}));
  std::vector<std::uint32_t> words(static_cast<std::size_t>(space.pages()) * space.columns());
  build_move_words(space, table.data(), words, 2, {});
  std::mt19937_64 random(2);
  for (int k = 0; k < 2000; ++k) {
    // As seen through the symmetry that leads to the page's representative, turns have the numbers of the word.
    Cube cube = random_cube(random);
    const std::uint32_t member = permutations.member_of[kCornerPermutation.of(cube)];
    cube = conjugate(cube, symmetry(static_cast<int>(member % kAxisSymmetries)));
    const auto distance = [&](const Cube& c) {
      const CosetSpace::Place p = space.place_of(c);
      return get_packed<4>(table.data() + p.page * layout.page_bytes(), p.column);
    };
    const CosetSpace::Place p = space.place_of(cube);
    const MoveWord word(words[static_cast<std::size_t>(p.page) * space.columns() + p.column]);
    ASSERT_EQ(word.distance(), static_cast<int>(distance(cube)));
    for (int m = 0; m < kMoves; ++m)
      ASSERT_EQ((word.nearer() >> m) & 1U, distance(cube * turn(Move(m))) < distance(cube) ? 1U : 0U);
  }
}

}  // namespace
}  // namespace mrroc::rubik
