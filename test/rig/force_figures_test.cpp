#include "test/rig/force_figures.hpp"

#include <gtest/gtest.h>

namespace mrroc::rig {
namespace {

// The benchmark asks for 20 tools and 100 orientations.
TEST(ForceFigures, AToolIsIdentifiedAndThenWeighsNothingInAnyOrientation) {
  const ForceFigures f = measure_forces(2, 4, 5);
  EXPECT_LE(f.weight_pct, 1);
  EXPECT_LE(f.centre_mm, 2);
  EXPECT_LE(f.free_force_N, 0.1);
  EXPECT_LE(f.free_torque_Nm, 0.01);
  EXPECT_GT(f.free_force_N, 0) << "noise is on";
}

}  // namespace
}  // namespace mrroc::rig
