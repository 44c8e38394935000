#include "tasks/rubik/solver/table_builder.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace mrroc::rubik {
namespace {

using Counts = std::vector<std::uint64_t>;

template <int Bits>
struct Built {
  std::vector<std::uint8_t> bytes;
  PackedLayout<Bits> layout;
  Counts counts;

  Built(const CosetSpace& space, int deepest, int threads)
      : bytes(PackedLayout<Bits>{space.rows(), space.columns()}.bytes(space.pages())),
        layout{space.rows(), space.columns()},
        counts(build_table<Bits>(space, bytes, deepest, threads, {})) {}
  [[nodiscard]] unsigned at(const CosetSpace::Place& p) const {
    return get_packed<Bits>(bytes.data() + p.page * layout.page_bytes() + p.row * layout.row_bytes(),
                            p.column);
  }
};

struct CornerSpaces {
  SymmetryClasses permutations{kCornerPermutation};
  CosetSpace twists{kCornerPermutation, permutations, nullptr, kTwist, all_moves()};
  CosetSpace slices{kCornerPermutation, permutations, nullptr, kSlicePermutation, kSecondPhaseMoves};
};

TEST(TableBuilder, FindsTheKnownNumbersOfCornerStates) {
  const CornerSpaces spaces;
  const Built<4> table(spaces.twists, 14, 2);
  EXPECT_EQ(table.counts,
            (Counts{1, 18, 243, 2874, 28000, 205416, 1168516, 5402628, 20776176, 45391616, 15139616, 64736}));

  const Built<2> coarse(spaces.twists, 14, 1);
  std::mt19937_64 random(1);
  for (int k = 0; k < 20000; ++k) {
    const CosetSpace::Place p = spaces.twists.place_of(random_cube(random));
    ASSERT_EQ(static_cast<int>(coarse.at(p)), std::max(0, static_cast<int>(table.at(p)) - kTwoBitBase));
  }
}

TEST(TableBuilder, AgreesWithASearchWithoutSymmetries) {
  const CornerSpaces spaces;
  const Built<4> table(spaces.slices, 14, 1);
  const std::vector<std::uint16_t> corners = move_table(kCornerPermutation, kSecondPhaseMoves);
  const std::vector<std::uint16_t> slices = move_table(kSlicePermutation, kSecondPhaseMoves);
  constexpr std::size_t kCount = kSecondPhaseMoves.size();
  std::vector<int> distance(kPermutations * kSlicePermutations, -1);
  std::vector<int> states{0};
  distance[0] = 0;
  for (std::size_t k = 0; k < states.size(); ++k)
    for (std::size_t m = 0; m < kCount; ++m) {
      const int next = corners[states[k] / kSlicePermutations * kCount + m] * kSlicePermutations +
                       slices[states[k] % kSlicePermutations * kCount + m];
      if (distance[next] >= 0) continue;
      distance[next] = distance[states[k]] + 1;
      states.push_back(next);
    }
  ASSERT_EQ(states.size(), distance.size());
  EXPECT_EQ(std::accumulate(table.counts.begin(), table.counts.end(), std::uint64_t{0}), distance.size());
  for (std::size_t state = 0; state < distance.size(); state += 7) {
    Cube cube = kCornerPermutation.cube(static_cast<int>(state) / kSlicePermutations);
    cube.edges = kSlicePermutation.cube(static_cast<int>(state) % kSlicePermutations).edges;
    ASSERT_EQ(static_cast<int>(table.at(spaces.slices.place_of(cube))), distance[state]);
  }
}

TEST(TableBuilder, TellsNoMoreThanTheDistancesAskedFor) {
  const CornerSpaces spaces;
  const Built<4> all(spaces.slices, 14, 1);
  const Built<4> some(spaces.slices, 5, 3);
  EXPECT_EQ(some.counts, Counts(all.counts.begin(), all.counts.begin() + 6));
  std::mt19937_64 random(2);
  for (int k = 0; k < 5000; ++k) {
    Cube cube = kCornerPermutation.cube(static_cast<int>(random() % kPermutations));
    cube.edges = kSlicePermutation.cube(static_cast<int>(random() % kSlicePermutations)).edges;
    const CosetSpace::Place p = spaces.slices.place_of(cube);
    ASSERT_EQ(some.at(p), std::min(all.at(p), 6U));
  }
}

}  // namespace
}  // namespace mrroc::rubik
