// One turn of a face between two grippers, and a face that does not turn.
#include <gtest/gtest.h>

#include <numbers>

#include "sim/cube_turn.hpp"

namespace mrroc::sim {
namespace {

TurnPlan quick(std::uint64_t seed) {
  TurnPlan plan = random_turn(seed);
  plan.cell.distance = 0.006;
  plan.cell.jaws = 0.0615;
  return plan;
}

TEST(CubeTurn, TurnsTheFaceByContactAndHandsTheCubeOver) {
  TurnPlan plan = quick(1);
  bool laid = false, behind = false;
  double held_fast = 0;  // force on the holder's jaws as they open [N]
  const TurnFigures f = turn_face(plan, 1, [&](DrivenCell& cell, int m) {
    const auto& angle = cell.world().cube()->angle;
    const bool on_its_way = m == 5 && std::max(std::abs(angle[0]), std::abs(angle[1])) > 0.3;
    behind |= on_its_way;
    laid |= on_its_way && cell.world().lay_cube(0);
    const ArmTruth& holder = cell.world().truth(kTrack);
    if (m == 6 && holder.jaws > kCubeEdge + 5e-4) held_fast = std::max(held_fast, std::abs(holder.jaw_force));
  });
  EXPECT_TRUE(f.done) << to_string(f.trouble) << ", " << FaultError(f.fault).what();
  EXPECT_TRUE(f.turned);
  EXPECT_TRUE(behind);
  EXPECT_FALSE(laid) << "a face on its way keeps its layers";
  EXPECT_LT(held_fast, 1) << "nothing sticks to jaws that have turned with the cube";
  EXPECT_FALSE(f.dropped);
  EXPECT_NEAR(f.approach_settled, 4, 0.2);
  EXPECT_LT(f.approach_peak, 8);
  EXPECT_LT(f.steady_std, 0.5);
  EXPECT_LT(f.lateral_peak, 12);
  EXPECT_GT(f.torque_peak, 2);
  EXPECT_LT(f.angle_error, 2 * std::numbers::pi / 180);
  EXPECT_LT(f.slip, 2e-3);
  EXPECT_LT(f.squeeze, 450);
}

TEST(CubeTurn, AFaceThatJamsIsTriedAgainAndThenNamedWithTheCubeHeld) {
  TurnPlan plan = quick(6);
  plan.cell.faces.mean.breakaway = 30;
  const TurnFigures f = turn_face(plan, 6);
  EXPECT_EQ(f.trouble, rubik::Trouble::jammed);
  EXPECT_FALSE(f.fault) << FaultError(f.fault).what();
  EXPECT_EQ(f.attempts, 3);
  EXPECT_FALSE(f.done);
  EXPECT_FALSE(f.turned);
  EXPECT_FALSE(f.dropped);
  EXPECT_LT(f.torque_peak, 4.95) << "what the sensor's limit allows";
  EXPECT_LT(f.squeeze, 450);
}

}  // namespace
}  // namespace mrroc::sim
