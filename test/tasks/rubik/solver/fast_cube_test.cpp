#include "tasks/rubik/solver/fast_cube.hpp"

#include <gtest/gtest.h>

namespace mrroc::rubik {
namespace {

TEST(FastCube, TurnsAsTheCubeDoes) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 200; ++k) {
    const Cube cube = random_cube(random);
    for (int m = 0; m < kMoves; ++m) {
      const CubePair pair = FastTurns::get().after(CubePair::of(cube), Move(m));
      ASSERT_EQ(pair.cube, cube * turn(Move(m)));
      ASSERT_EQ(pair.inverse, inverse(pair.cube));
    }
  }
}

}  // namespace
}  // namespace mrroc::rubik
