// A cube in a hand: held without slip, its layers chosen anew while it is held, dropped when let go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/cube/move.hpp"
#include "ecp/generators/rows.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/turn/tables.hpp"
#include "test/rig/cube_cell.hpp"
#include "test/rig/cube_limits.hpp"
#include "test/rig/driven_cell.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::rubik {
namespace {

using namespace rig;

class HeldCube : public testing::Test {
 protected:
  explicit HeldCube(double breakaway = sim::FaceFriction{}.breakaway)
      : cell(parameters(breakaway), 1, cube_limits()) {}
  static sim::WorldParameters parameters(double breakaway) {
    CubeCellParameters p;
    p.faces.mean.breakaway = breakaway;
    p.state = after({}, parse_moves("R U' F2"));
    p.distance = 0.08;  // out of the way
    return cube_cell(p);
  }
  /// The track arm moves with a velocity of E, its jaws press.
  void run(int macrosteps, const TaskFrameCommand& frame = {}, double jaws = kClosest) {
    for (int k = 0; k < macrosteps; ++k) {
      EffectorCommand command = ecp::move_arm(frame, kPacing);
      command.arm.gripper = jaws;
      cell.send(kTrack, command);
      ASSERT_EQ(cell.wait(), Outcome::terminated) << FaultError(cell.reply(kTrack).fault).what();
      squeeze = std::max(squeeze, cube().squeeze);
    }
  }
  /// The hand turns about its z, as fast as its last joint can. @param angle [rad]
  void turn_hand(double angle) {
    constexpr double kSpeed = 0.8;  // [rad/s]
    constexpr int kRamp = 10;
    const int all = kRamp + static_cast<int>(angle / (kSpeed * kPacing.macrostep_s()));
    for (int k = 0; k < all; ++k) {
      const double share = std::min({1.0, k / double{kRamp}, (all - k) / double{kRamp}});
      run(1, {.az = u(kSpeed * share)});
    }
    run(15);
  }
  [[nodiscard]] const sim::CubeTruth& cube() const { return *cell.world().cube(); }
  [[nodiscard]] Pose in_hand() const { return cell.world().effector(kTrack).inverse() * cube().T_UC; }

  DrivenCell cell;
  double squeeze{};
};

TEST_F(HeldCube, StaysInTheHandThatMoves) {
  run(25);
  const Pose before = in_hand();
  for (int k = 0; k < 40; ++k) {
    const double v = std::sin(2 * std::numbers::pi * k / 40);
    run(1, {.x = u(0.08 * v), .y = u(-0.08 * v), .z = u(-0.05 * v), .az = u(0.5 * v)});
  }
  run(10);
  const Pose change = before.inverse() * in_hand();
  EXPECT_LT(change.p.norm(), 1e-4);
  EXPECT_LT(angle_axis_from_rotation(change.R).norm(), 2e-3);
  EXPECT_TRUE(cell.reply(kTrack).blocked);
  EXPECT_NEAR(cell.world().truth(kTrack).jaw_force, 122, 6) << "the whole current of a grip";
  EXPECT_LT(squeeze, 200) << "not crushed";
  EXPECT_EQ(cube().state, after({}, parse_moves("R U' F2")));
}

TEST_F(HeldCube, IsWhereItWasInAHandThatGoesToAndFroOnArcs) {
  run(50);
  const Pose before = in_hand();
  for (int k = 0; k < 400; ++k) {
    const double v = std::sin(2 * std::numbers::pi * k / 100);
    run(1, {.x = u(0.2 * v), .ay = u(0.5 * v)});
  }
  run(25);
  EXPECT_LT((before.inverse() * in_hand()).p.norm(), 1e-5) << "what is lost on every arc adds up";
}

TEST_F(HeldCube, IsFeltByTheSensorAsItsWeight) {
  run(30);
  const double with_cube = cell.world().truth(kTrack).S_F.linear().norm();
  const auto robot = irb6::make_arm("irb6_track");
  EXPECT_NEAR(with_cube, robot->parameters().tool_weight + 0.1 * 9.81, 0.15);
  EXPECT_NEAR(cell.world().truth(kPostument).S_F.linear().norm(), 10.8, 0.05) << "nothing is in that hand";
}

TEST_F(HeldCube, DoesNotNoticeThatItsLayersAreChosenAnew) {
  run(40);
  const Pose before = in_hand();
  for (const int axis : {0, 1, 2, 0, 2, 1}) {
    ASSERT_TRUE(cell.world().lay_cube(axis));
    EXPECT_EQ(cube().axis, axis);
    run(1);
    EXPECT_GT(cell.world().truth(kTrack).jaw_force, 50) << axis;
    run(5);
    const Pose change = before.inverse() * in_hand();
    EXPECT_LT(change.p.norm(), 5e-5) << axis;
    EXPECT_LT(angle_axis_from_rotation(change.R).norm(), 2e-3) << axis;
  }
  EXPECT_LT(squeeze, 200);
  EXPECT_EQ(cube().state, after({}, parse_moves("R U' F2")));
}

TEST_F(HeldCube, LiesLooseInTheHandWhenTheJawsOpen) {
  run(15);
  const Pose before = in_hand();
  run(60, {}, 0.075);
  EXPECT_FALSE(cell.reply(kTrack).blocked);
  EXPECT_GT((before.inverse() * in_hand()).p.norm(), 0.005) << "it lies on the lower finger";
  EXPECT_FALSE(cube().on_floor);
}

TEST_F(HeldCube, GoesAsAWholeWithAHandThatTurnsAsFastAsItCan) {
  run(25);
  const Pose before = in_hand();
  const Matrix3 R = cell.world().effector(kTrack).R;
  turn_hand(1);
  EXPECT_GT(angle_axis_from_rotation(R.transpose() * cell.world().effector(kTrack).R).norm(), 0.8);
  const Pose change = before.inverse() * in_hand();
  EXPECT_LT(change.p.norm(), 1e-4);
  EXPECT_LT(angle_axis_from_rotation(change.R).norm(), 1e-3);
  for (const double angle : cube().angle) EXPECT_LT(std::abs(angle), 1e-3) << "no layer stays behind";
  EXPECT_EQ(cube().layings, 0);
  EXPECT_LT(squeeze, 200);
}

TEST_F(HeldCube, IsLetGoByJawsThatHaveTurnedWithIt) {
  run(25);
  turn_hand(1.7);
  double most = 0;
  for (int k = 0; k < 60; ++k) {
    run(1, {}, 0.075);
    if (cell.world().truth(kTrack).jaws > sim::kCubeEdge + 0.0005)
      most = std::max(most, std::abs(cell.world().truth(kTrack).jaw_force));
  }
  EXPECT_GT(cell.world().truth(kTrack).jaws, 0.07);
  EXPECT_LT(most, 1) << "nothing sticks to a jaw that opens";
}

/// Every moment would turn a layer.
class LooseCube : public HeldCube {
 protected:
  LooseCube() : HeldCube(0.02) {}
};

TEST_F(LooseCube, ChoosesNoLayersByWhatThePadsOfOneHandDoToEachOther) {
  run(25);
  for (int k = 0; k < 40; ++k) {
    const double v = std::sin(2 * std::numbers::pi * k / 20);
    run(1, {.x = u(0.1 * v), .y = u(0.1 * v), .z = u(-0.1 * v), .az = u(0.6 * v)});
  }
  EXPECT_EQ(cube().layings, 0);
}

TEST(CubeCell, ACubeThatNothingHoldsFallsOnTheFloor) {
  CubeCellParameters c;
  c.distance = 0.08;
  sim::WorldParameters p = cube_cell(c);
  p.cube->T_EC.p.x() = 0.2;  // beside the hand
  sim::World world(p, 1);
  const double height = world.cube()->T_UC.p.z();
  for (int k = 0; k < 500 && !world.cube()->on_floor; ++k) world.step({});
  EXPECT_TRUE(world.cube()->on_floor);
  const double seconds = static_cast<double>(world.steps()) * sim::kStep;
  EXPECT_NEAR(seconds, std::sqrt(2 * (height - 0.035) / 9.81), 0.02);
  EXPECT_LT(world.cube()->T_UC.p.z(), 0.06);
  EXPECT_EQ(world.cube()->state, Cube{});
}

TEST(CubeCell, IsTheSameFromRunToRun) {
  const auto hash = [] {
    CubeCellParameters p;
    sim::World world(cube_cell(p), 7);
    for (int k = 0; k < 200; ++k) world.step({});
    world.lay_cube(0);
    for (int k = 0; k < 50; ++k) world.step({});
    return world.state_hash();
  };
  EXPECT_EQ(hash(), hash());
}

TEST(CubeCell, OnTheFloorIsTheSameFromRunToRun) {
  const auto hash = [] {
    CubeCellParameters c;
    c.distance = 0.08;
    sim::WorldParameters p = cube_cell(c);
    p.cube->T_EC.p.x() = 0.2;  // beside the hand
    sim::World world(p, 1);
    for (int k = 0; k < 700; ++k) world.step({});
    EXPECT_TRUE(world.cube()->on_floor);
    return world.state_hash();
  };
  EXPECT_EQ(hash(), hash());
}

TEST(CubeCell, IsSolvedWithTheIterationsOfTheTask) {
  const Config task = Config::parse(std::string(config()), "rubik.toml");
  EXPECT_EQ(cube_cell({}).solver_iterations,
            task.integer("sim.solver_iterations", Config::kRequired, {1, 1000}));
}

TEST(CubeCell, BringsEveryFaceBeforeTheWorker) {
  const std::array<Vector3, 6> outwards{Vector3{0, 0, 1},  Vector3{1, 0, 0},  Vector3{0, -1, 0},
                                        Vector3{0, 0, -1}, Vector3{-1, 0, 0}, Vector3{0, 1, 0}};
  for (int k = 0; k < kFaces; ++k)
    EXPECT_NEAR((cube_with(static_cast<Face>(k)).R * outwards[static_cast<std::size_t>(k)]).z(), 1, 1e-12)
        << k;
}

TEST(CubeCell, ItsDriversHaveTheLimitsOfTheTask) {
  const std::vector<edp::Limits> limits = cube_limits();
  ASSERT_EQ(limits.size(), 2U);
  const Config task = Config::parse(std::string(config()), "rubik.toml");
  for (const int arm : {kPostument, kTrack}) {
    const Config its = task.section("robots." + kArmKeys[static_cast<std::size_t>(arm)]).section("limits");
    const edp::Limits& l = limits[static_cast<std::size_t>(arm)];
    EXPECT_EQ(l.motor_acceleration, its.number("motor_acceleration", Config::kRequired, {0, 1e6}));
    EXPECT_EQ(l.linear_velocity, its.number("linear_velocity", Config::kRequired, {0, 10}));
    EXPECT_EQ(l.angular_velocity, its.number("angular_velocity", Config::kRequired, {0, 10}));
  }
  const auto force = task.numbers<6>("robots.arm2.limits.contact_force", std::nullopt, {0, 1000});
  EXPECT_EQ(limits[kTrack].contact_force.v, force) << "of the arm that turns";
}

TEST(CubeCell, RefusesACubeThatNoGripperHolds) {
  sim::WorldParameters p = irb6_cell();
  p.cube.emplace();
  EXPECT_THROW(sim::World world(p), std::invalid_argument);
}

}  // namespace
}  // namespace mrroc::rubik
