#include "base/cube/symmetry.hpp"

#include <gtest/gtest.h>

#include <set>

#include "base/cube/move.hpp"

namespace mrroc::cube {
namespace {

TEST(Symmetry, FormsAGroupOf48HalfOfThemMirrored) {
  std::set<std::array<Face, kFaces>> different;
  int mirrored = 0;
  for (int s = 0; s < kSymmetries; ++s) {
    different.insert(symmetry(s).faces);
    mirrored += symmetry(s).mirrored;
    EXPECT_EQ(compose(s, inverse_symmetry(s)), 0);
    for (int t = 0; t < kSymmetries; ++t)
      EXPECT_EQ(symmetry(compose(s, t)).mirrored, symmetry(s).mirrored != symmetry(t).mirrored);
  }
  EXPECT_EQ(different.size(), 48U);
  EXPECT_EQ(mirrored, 24);
}

TEST(Symmetry, KeepsTheAxisOfUAndDInTheFirst16) {
  for (int s = 0; s < kSymmetries; ++s) {
    const Face up = symmetry(s).faces[0];
    EXPECT_EQ(s < kAxisSymmetries, up == Face::U || up == Face::D);
  }
  for (int s = 0; s < kAxisSymmetries; ++s)
    for (int t = 0; t < kAxisSymmetries; ++t) EXPECT_LT(compose(s, t), kAxisSymmetries);
}

TEST(Symmetry, ConjugatesAsAHomomorphism) {
  std::mt19937_64 random(1);
  for (int s = 0; s < kSymmetries; ++s) {
    const Symmetry& map = symmetry(s);
    const Cube a = random_cube(random), b = random_cube(random);
    EXPECT_EQ(conjugate(a * b, map), conjugate(a, map) * conjugate(b, map));
    EXPECT_EQ(conjugate(inverse(a), map), inverse(conjugate(a, map)));
    EXPECT_TRUE(is_reachable(conjugate(a, map)));
    for (int t = 0; t < kSymmetries; ++t)
      EXPECT_EQ(conjugate(conjugate(a, symmetry(t)), map), conjugate(a, symmetry(compose(s, t))));
    for (int m = 0; m < kMoves; ++m)
      EXPECT_EQ(conjugate(turn(Move(m)), map), turn(conjugate(Move(m), map)))
          << s << ' ' << to_string(Move(m));
  }
}

TEST(Symmetry, RotatesTheAxesAboutACorner) {
  EXPECT_EQ(axis_rotation(0), 0);
  EXPECT_EQ(axis_rotation(3), 0);
  EXPECT_FALSE(symmetry(axis_rotation(1)).mirrored);
  EXPECT_EQ(symmetry(axis_rotation(1)).faces[number(Face::U)], Face::R);
  EXPECT_EQ(symmetry(axis_rotation(2)).faces[number(Face::U)], Face::F);
}

}  // namespace
}  // namespace mrroc::cube
