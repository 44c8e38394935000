#include "tasks/rubik/solver/bounds.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rubik/solver/small_tables.hpp"

namespace mrroc::rubik {
namespace {

TEST(Bounds, AreNeverTooLarge) {
  std::mt19937_64 random(1);
  const Bounds& bounds = test::small_bounds();
  for (int k = 0; k < 3000; ++k) {
    const int turns = static_cast<int>(random() % 10);
    const CubePair pair = CubePair::of(after({}, random_moves(turns, random)));
    const int bound = bounds.lower_bound(pair);
    ASSERT_LE(bound, turns);
    ASSERT_EQ(bound == 0, pair.cube == Cube{});
  }
}

TEST(Bounds, LookAlongAllAxesOfCubeAndInverse) {
  std::mt19937_64 random(2);
  const Bounds& bounds = test::small_bounds();
  const Tables& tables = test::small_tables();
  for (int k = 0; k < 500; ++k) {
    const Cube cube = after({}, random_moves(7, random));
    const AxisCoordinates c = bounds.coordinates(cube);
    for (int axis = 0; axis < kAxes; ++axis) {
      const Cube seen = conjugate(cube, symmetry(axis_rotation(axis)));
      const std::uint32_t member = tables.flip_slices.member_of[kFlipSlice.of(seen)];
      const Probe p = bounds.probe(c, axis);
      ASSERT_EQ(p.flip_slice_class, member / kAxisSymmetries);
      ASSERT_EQ(p.twist, tables.twist_seen[kTwist.of(seen) * kAxisSymmetries + member % kAxisSymmetries]);
    }
    // Neither a symmetry nor the inverse changes how far a cube is from solved.
    const int bound = bounds.lower_bound(CubePair::of(cube));
    ASSERT_EQ(bounds.lower_bound(CubePair::of(inverse(cube))), bound);
    ASSERT_EQ(bounds.lower_bound(CubePair::of(conjugate(cube, symmetry(k % kSymmetries)))), bound);
  }
}

}  // namespace
}  // namespace mrroc::rubik
