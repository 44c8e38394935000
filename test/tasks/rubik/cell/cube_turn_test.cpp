// One turn of a face between two grippers, and a face that does not turn.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "tasks/rubik/turn/tables.hpp"
#include "test/rig/cube_turn.hpp"

namespace mrroc::rubik {
namespace {

using namespace rig;

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
    const sim::ArmTruth& holder = cell.world().truth(kTrack);
    // The ends of the pads touch a cube that is half a degree askew until then.
    if (m == 6 && holder.jaws > sim::kCubeEdge + 1e-3)
      held_fast = std::max(held_fast, std::abs(holder.jaw_force));
  });
  EXPECT_TRUE(f.done) << to_string(f.failure) << ", " << FaultError(f.fault).what();
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

TEST(CubeTurn, LayersThatAreLaidAnewUnderLoadAreNotFelt) {
  TurnPlan plan = quick(2);
  bool laid = false;
  int since = 0;
  Vector3 before = Vector3::Zero(), place = Vector3::Zero();
  double torque = 0, across = 0, moved = 0;
  const TurnFigures f = turn_face(plan, 2, [&](DrivenCell& cell, int m) {
    const Wrench& F = cell.reply(kTrack).F_a;
    const sim::CubeTruth& cube = *cell.world().cube();
    const Vector3 in_hand = (cell.world().effector(kTrack).inverse() * cube.T_UC).p;
    if (laid && ++since <= 3) {  // what it was is told one macrostep late
      across = std::max(across, (F.linear() - before).norm());
      moved = std::max(moved, (in_hand - place).norm());
    }
    if (laid || m != 5 || std::abs(F[Axis::az]) < 1.5) return;
    laid = cell.world().lay_cube(cube.axis);
    torque = std::abs(F[Axis::az]);
    before = F.linear();
    place = in_hand;
  });
  ASSERT_TRUE(laid);
  EXPECT_TRUE(f.turned) << to_string(f.failure) << ", " << FaultError(f.fault).what();
  EXPECT_GT(torque, 1.5);
  EXPECT_LT(across, 3) << "N";
  EXPECT_LT(moved, 1e-4);
  EXPECT_LT(f.slip, 2e-4);
}

TEST(CubeTurn, AWorkerThatClosesAskewLosesNothingInItsPads) {
  TurnPlan plan = random_turn(35);
  plan.cell.face = Face::L;
  plan.quarters = -1;
  const TurnFigures f = turn_face(plan, 35);
  EXPECT_TRUE(f.done && f.turned) << to_string(f.failure) << ", " << FaultError(f.fault).what();
  EXPECT_EQ(f.attempts, 1);
  EXPECT_LT(f.lateral_peak, 6);
  EXPECT_LT(f.steady_std, 0.2);
  EXPECT_LT(f.slip, 2e-4);
  EXPECT_LT(f.angle_error, std::numbers::pi / 180);
  EXPECT_LT(f.squeeze, 290) << "no finger gives way";
}

TEST(CubeTurn, AFaceThatJamsIsTriedAgainAndThenNamedWithTheCubeHeld) {
  TurnPlan plan = quick(6);
  plan.cell.faces.mean.breakaway = 30;
  const TurnFigures f = turn_face(plan, 6);
  EXPECT_EQ(f.failure, FailureReason::jammed);
  EXPECT_FALSE(f.fault) << FaultError(f.fault).what();
  EXPECT_EQ(f.attempts, 3);
  EXPECT_FALSE(f.done);
  EXPECT_FALSE(f.turned);
  EXPECT_FALSE(f.dropped);
  EXPECT_LT(f.torque_peak, 4.95) << "what the sensor's limit allows";
  EXPECT_LT(f.squeeze, 450);
}

/// The worker comes beside the cube: one of its pads meets the face with its end, where its palm should.
TurnPlan beside_the_cube() {
  TurnPlan plan = quick(1);
  const GripperShape worker = gripper_with(Fingers::one_layer);
  plan.cell.grasp_error = {0, 0.045, 0};  // along the way of the jaws
  plan.cell.turn_error = 0;
  plan.cell.distance = kApproachDistance + worker.palm + worker.pad_depth / 2;
  plan.task.attempts = 2;
  return plan;
}

TEST(CubeTurn, JawsThatCloseBesideTheCubeComeAgainFromWhereTheyBeganAndThenTheGraspIsMissed) {
  std::vector<Pose> begun;  // E of the worker, when it sets out
  double closed = 1, opened = 0;
  Pose in_hand;
  int before = 0;
  const TurnFigures f = turn_face(beside_the_cube(), 1, [&](DrivenCell& cell, int m) {
    if (m == 1 && before != 1) begun.push_back(cell.world().effector(kPostument));
    if (begun.size() == 1 && m == 4) closed = std::min(closed, cell.reply(kPostument).gripper);
    if (begun.size() == 1 && m == kGo) opened = cell.reply(kPostument).gripper;
    in_hand = cell.world().effector(kTrack).inverse() * cell.world().cube()->T_UC;
    before = m;
  });
  EXPECT_EQ(f.failure, FailureReason::missed) << to_string(f.failure) << ", " << FaultError(f.fault).what();
  EXPECT_FALSE(f.fault) << FaultError(f.fault).what();
  EXPECT_FALSE(f.done);
  EXPECT_EQ(f.grips, 2);
  EXPECT_EQ(f.attempts, 0) << "nothing is turned";
  EXPECT_NEAR(f.approach_settled, 4, 0.5) << "it has met something";
  EXPECT_LT(closed, Parameters{}.held);
  EXPECT_NEAR(opened, Parameters{}.open, 1e-3);
  ASSERT_EQ(begun.size(), 2U);
  EXPECT_LT((begun[1].p - begun[0].p).norm(), 1e-3) << "it has drawn back";
  EXPECT_FALSE(f.turned);
  EXPECT_FALSE(f.dropped);
  EXPECT_LT((in_hand.p - cube_in_hand(Fingers::two_layers, Face::U).p).norm(), 2e-3) << "the cube is held";
  EXPECT_LT(f.squeeze, 350);
}

}  // namespace
}  // namespace mrroc::rubik
