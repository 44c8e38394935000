// The planner's belief is separate from the truth of the simulated cell, which can differ from it.
#include "tasks/rubik/cell/belief.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "base/cube/facelets.hpp"
#include "base/cube/move.hpp"
#include "base/fault.hpp"
#include "sim/config.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/config.hpp"

namespace mrroc::rubik {
namespace {

constexpr std::size_t kT = index(Hand::track);

Config config_with(std::initializer_list<const char*> settings) {
  Config config = Config::parse(std::string(rubik::config()), "rubik.toml");
  for (const char* setting : settings) config.set(setting);
  return config;
}

TEST(Belief, IsByDefaultWhatTheSimulatorIsGiven) {
  const Config config = config_with({});
  const CellBelief cell = read_belief(config), usual = usual_cell();
  const sim::WorldParameters world = sim::read_world(config);
  for (std::size_t k = 0; k < cell.arms.size(); ++k) {
    EXPECT_EQ(cell.arms[k].type, world.arms[k].type);
    EXPECT_EQ(cell.arms[k].T_UB.p, world.arms[k].T_UB.p);
    EXPECT_EQ(cell.arms[k].T_UB.R, world.arms[k].T_UB.R);
    EXPECT_EQ(cell.arms[k].T_UB.p, usual.arms[k].T_UB.p);
    EXPECT_EQ(cell.arms[k].gripper.palm, world.arms[k].gripper->palm);
    EXPECT_EQ(cell.arms[k].gripper.pad_depth, world.arms[k].gripper->pad_depth);
    EXPECT_EQ(cell.T_0P.p, world.arms[k].paper.T_0P.p);
    EXPECT_EQ(cell.T_0P.R, world.arms[k].paper.T_0P.R);
  }
  EXPECT_EQ(cell.grasp, grasp_from(Hand::track, world.cube->T_EC.R));
  EXPECT_EQ(cell.known, world.cube->state);
}

TEST(Belief, StaysWhenTheTruthMoves) {
  const Config config = config_with({"sim.robots.arm2.place=[0.05, 0, 0, 0, 0, 0]"});
  EXPECT_EQ(read_belief(config).arms[kT].T_UB.p, usual_cell().arms[kT].T_UB.p);
  EXPECT_EQ(sim::read_world(config).arms[kT].T_UB.p, Vector3(0.05, 0, 0));
  const Config fingers = config_with({"sim.robots.arm2.fingers=one_layer"});
  EXPECT_EQ(read_belief(fingers).arms[kT].gripper.palm, usual_cell().arms[kT].gripper.palm);
  EXPECT_NE(sim::read_world(fingers).arms[kT].gripper->palm, usual_cell().arms[kT].gripper.palm);
}

TEST(Belief, IsMovedByTheTableCellAlone) {
  const Config config = config_with({"cell.robots.arm2.place=[0, 0.1, 0, 0, 0, 0]", "cell.table.height=0.8",
                                     "cell.cube.facing=F", "cell.cube.scramble=\"R U'\""});
  const CellBelief cell = read_belief(config);
  const sim::WorldParameters world = sim::read_world(config);
  EXPECT_EQ(cell.arms[kT].T_UB.p, Vector3(0, 0.1, 0));
  EXPECT_EQ(world.arms[kT].T_UB.p, Vector3::Zero());
  EXPECT_EQ(cell.T_0P.p.z(), 0.8);
  EXPECT_NE(world.arms[kT].paper.T_0P.p.z(), 0.8);
  EXPECT_NE(cell.grasp, grasp_from(Hand::track, world.cube->T_EC.R));
  EXPECT_EQ(cell.known, after({}, parse_moves("R U'")));
  EXPECT_EQ(world.cube->state, Cube());
}

TEST(Belief, AndTruthBothFollowWhatIsSaidOfTheRobotAndOfTheCube) {
  const Config config =
      config_with({"robots.arm2.place=[0, 0.1, 0, 0, 0, 0]", "cube.facing=R", "cube.scramble=F"});
  const CellBelief cell = read_belief(config);
  const sim::WorldParameters world = sim::read_world(config);
  EXPECT_EQ(cell.arms[kT].T_UB.p, Vector3(0, 0.1, 0));
  EXPECT_EQ(world.arms[kT].T_UB.p, Vector3(0, 0.1, 0));
  EXPECT_EQ(cell.grasp, grasp_from(Hand::track, world.cube->T_EC.R));
  EXPECT_EQ(cell.known, world.cube->state);
}

TEST(Belief, ThatCannotBeIsRefused) {
  for (const char* wrong : {"cell.robots.arm2.place=[1, 2]", "cell.robots.arm1.fingers=three",
                            "cell.cube.held_by=arm1", "cell.cube.facing=X", "robots.arm1.fingers=none",
                            "robots.arm1.model=irb6_track", "cell.table.height=3"})
    EXPECT_THROW(std::ignore = read_belief(config_with({wrong})), std::exception) << wrong;
  EXPECT_THROW(std::ignore = read_belief(config_with({"cell.cube.state=UUU"})), FaultError);
}

TEST(Belief, AboutABaseMovesTheHandThatThePlannerExpects) {
  const CellBelief usual = usual_cell();
  CellBelief moved = usual;
  moved.arms[kT].T_UB.p.x() += 0.05;
  const AxisVector q = meeting_joints(static_cast<int>(kT));
  const Vector3 by =
      CubePlanCell(moved).forward(Hand::track, q).p - CubePlanCell(usual).forward(Hand::track, q).p;
  EXPECT_LT((by - Vector3(0.05, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace mrroc::rubik
