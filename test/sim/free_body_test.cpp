// A ball or a box on its pedestal, and what becomes of it without one.
#include <gtest/gtest.h>

#include "sim/config.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {
namespace {

WorldParameters cell_with(FreeBodyShape shape) {
  WorldParameters p;
  p.arms.push_back(arm_parameters(*robots::catalogue().front()));
  p.arms.back().palm = PalmParameters{};
  p.free_body = FreeBodyParameters{};
  p.free_body->shape = shape;
  return p;
}

class FreeBodies : public testing::TestWithParam<FreeBodyShape> {};

TEST_P(FreeBodies, RestOnTheirPedestal) {
  World world(cell_with(GetParam()));
  const Vector3 at = world.free_body()->T_UO.p;
  for (int step = 0; step < 1000; ++step) world.step({});
  EXPECT_LT((world.free_body()->T_UO.p - at).norm(), 1e-3);
  EXPECT_LT(world.free_body()->velocity.norm(), 1e-3);
  EXPECT_TRUE(world.free_body()->on_pedestal);
  EXPECT_FALSE(world.free_body()->on_floor);
}

TEST(FreeBody, FallsToTheFloorThroughAnOpeningThatIsWiderThanItself) {
  WorldParameters p = cell_with(FreeBodyShape::box);
  p.free_body->size = 0.1;
  p.free_body->pedestal_edge = 0.4;
  p.free_body->pedestal_opening = 0.3;  // wider than the body
  World world(p);
  for (int step = 0; step < 1000; ++step) world.step({});
  EXPECT_TRUE(world.free_body()->on_floor);
  EXPECT_FALSE(world.free_body()->on_pedestal);
}

TEST_P(FreeBodies, AreTheSameInEveryRun) {
  World first(cell_with(GetParam())), second(cell_with(GetParam()));
  for (int step = 0; step < 100; ++step) {
    first.step({});
    second.step({});
  }
  EXPECT_EQ(first.state_hash(), second.state_hash());
}

INSTANTIATE_TEST_SUITE_P(All, FreeBodies, testing::Values(FreeBodyShape::ball, FreeBodyShape::box));

TEST(FreeBody, IsAsItIsToldUnlessTheTruthIsOther) {
  Config told = Config::parse("[robots]\norder=['arm1']\n[free_body]\nshape='box'\nmass=0.7\n", "test");
  EXPECT_EQ(read_world(told).free_body->mass, 0.7);
  Config other = Config::parse(
      "[robots]\norder=['arm1']\n[free_body]\nshape='box'\nmass=0.7\n[sim.free_body]\nmass=0.9\n", "test");
  EXPECT_EQ(read_world(other).free_body->mass, 0.9);
  EXPECT_FALSE(read_world(Config::parse("[robots]\norder=['arm1']\n", "test")).free_body);
}

TEST(FreeBody, IsTouchedByPalmsOrFingersOfAnArmNotByBoth) {
  WorldParameters p = cell_with(FreeBodyShape::ball);
  p.arms.back().jaws = JawParameters{};
  p.arms.back().gripper = GripperBodyParameters{};
  EXPECT_THROW(World{p}, std::invalid_argument);
}

}  // namespace
}  // namespace mrroc::sim
