#include "tasks/rubik/solver/coordinates.hpp"

#include <gtest/gtest.h>

#include <bit>

namespace mrroc::rubik {
namespace {

struct Named {
  const char* name;
  const Coordinate* coordinate;
  std::span<const Move> moves;
};

std::vector<Named> all_coordinates() {
  return {{"twist", &kTwist, all_moves()},
          {"flip_slice", &kFlipSlice, all_moves()},
          {"tetrad", &kTetrad, all_moves()},
          {"corner_permutation", &kCornerPermutation, all_moves()},
          {"edge_permutation", &kEdgePermutation, kSecondPhaseMoves},
          {"slice_permutation", &kSlicePermutation, kSecondPhaseMoves}};
}

/// @return a random cube that turns of these lead to
Cube reached_by(std::span<const Move> moves, std::mt19937_64& random) {
  Cube cube;
  for (int k = 0; k < 40; ++k) cube = cube * turn(moves[random() % moves.size()]);
  return cube;
}

TEST(Coordinate, NumbersEveryValueOnce) {
  for (const auto& [name, c, moves] : all_coordinates())
    for (int value = 0; value < c->size; value += 1 + c->size / 50000)
      ASSERT_EQ(c->of(c->cube(value)), value) << name;
  EXPECT_EQ(kTwist.of({}), 0);
  EXPECT_EQ(kCornerPermutation.of({}), 0);
  EXPECT_EQ(kEdgePermutation.of({}), 0);
  EXPECT_EQ(kSlicePermutation.of({}), 0);
}

TEST(Coordinate, ChangesByTurnsAndSymmetriesOnItsOwn) {
  std::mt19937_64 random(1);
  for (const auto& [name, c, moves] : all_coordinates())
    for (int k = 0; k < 300; ++k) {
      const Cube cube = reached_by(moves, random);
      const Cube other = c->cube(c->of(cube));  // equal in this coordinate only
      for (const Move m : moves) ASSERT_EQ(c->of(other * turn(m)), c->of(cube * turn(m))) << name;
      for (int s = 0; s < kAxisSymmetries; ++s)
        ASSERT_EQ(c->of(conjugate(other, symmetry(s))), c->of(conjugate(cube, symmetry(s)))) << name;
    }
}

TEST(Coordinate, HasTablesOfWhatTurnsAndSymmetriesDo) {
  std::mt19937_64 random(2);
  const std::vector<std::uint16_t> moved = move_table(kTwist, all_moves());
  const std::vector<std::uint16_t> seen = symmetry_table(kTwist);
  for (int k = 0; k < 300; ++k) {
    const Cube cube = random_cube(random);
    for (int m = 0; m < kMoves; ++m)
      ASSERT_EQ(moved[kTwist.of(cube) * kMoves + m], kTwist.of(cube * turn(Move(m))));
    for (int s = 0; s < kAxisSymmetries; ++s)
      ASSERT_EQ(seen[kTwist.of(cube) * kAxisSymmetries + s], kTwist.of(conjugate(cube, symmetry(s))));
  }
}

TEST(SymmetryClasses, LeadEveryValueToItsRepresentative) {
  std::mt19937_64 random(3);
  const SymmetryClasses classes(kFlipSlice);
  EXPECT_EQ(classes.size(), 64430);
  EXPECT_EQ(SymmetryClasses(kCornerPermutation).size(), 2768);
  for (int k = 0; k < 2000; ++k) {
    const Cube cube = random_cube(random);
    const std::uint32_t member = classes.member_of[kFlipSlice.of(cube)];
    const Cube seen = conjugate(cube, symmetry(static_cast<int>(member % kAxisSymmetries)));
    ASSERT_EQ(kFlipSlice.of(seen), classes.representative[member / kAxisSymmetries]);
  }
  std::uint64_t values = 0;
  for (const std::uint16_t keeps : classes.stabiliser) values += kAxisSymmetries / std::popcount(keeps);
  EXPECT_EQ(values, kFlipSlices);
}

}  // namespace
}  // namespace mrroc::rubik
