// Jaws and lines through the driver and the simulator: g_gd, g_gm, g_b, INPUTS, OUTPUTS.
#include <gtest/gtest.h>

#include <memory>

#include "edp/driver.hpp"
#include "robots/gripper/jaws.hpp"
#include "robots/irb6/arm.hpp"
#include "sim/world.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::sim {
namespace {

class JawsOfAnArm : public testing::Test {
 protected:
  JawsOfAnArm() : robot(irb6::make_arm("irb6_postument")) {
    WorldParameters w = rig::irb6_cell();
    w.arms.resize(1);
    w.arms[0].jaws = JawParameters{};
    world = std::make_unique<World>(w);
    edp::DriverParameters p;
    p.synchro_joints = world->start_joints(0);
    p.T_WE = robot->tool_in_wrist();
    p.force.T_WS = robot->sensor_in_wrist();
    p.gripper = gripper::two_jaw();
    driver = std::make_unique<edp::Driver>(*robot, p);
    send({.instruction = Instruction::synchro});
  }

  EffectorReply send(EffectorCommand c) {
    c.session = 1;
    c.number = driver->protocol().expected();
    driver->take(c);
    return macrostep();
  }
  EffectorReply macrostep() {
    EffectorReply reply;
    do {
      world->step(std::array{driver->step(world->reading(0))});
      if (driver->reply_due()) reply = driver->reply();
    } while (!driver->at_boundary());
    return reply;
  }
  /// Commands a distance of the jaws and lets macrosteps pass in silence.
  EffectorReply grip(double distance, int macrosteps = 300) {
    EffectorCommand c{.instruction = Instruction::set};
    c.set = static_cast<std::uint8_t>(Part::arm);
    c.arm.gripper = distance;
    EffectorReply reply = send(c);
    if (reply.verdict != Verdict::executed) return reply;
    for (int k = 0; k < macrosteps; ++k) reply = macrostep();
    return reply;
  }

  std::unique_ptr<irb6::Arm> robot;
  std::unique_ptr<World> world;
  std::unique_ptr<edp::Driver> driver;
};

TEST_F(JawsOfAnArm, GoToTheDistanceOfTheCommandAndTellIt) {
  const EffectorReply reply = grip(0.06);
  EXPECT_NEAR(reply.gripper, 0.06, 1e-4);
  EXPECT_NEAR(world->truth(0).jaws, reply.gripper, 2e-6);
  EXPECT_FALSE(reply.blocked);
}

TEST_F(JawsOfAnArm, AreBlockedByAnObjectAndHoldItWhileTheArmRests) {
  world->set_object(0, 0.065);
  const EffectorReply reply = grip(0.055, 500);
  EXPECT_TRUE(reply.blocked);
  EXPECT_EQ(reply.state, DriverState::holding);
  EXPECT_GT(world->truth(0).jaw_force, 50);
  EXPECT_FALSE(grip(0.08).blocked);
  EXPECT_EQ(world->truth(0).jaw_force, 0);
}

TEST_F(JawsOfAnArm, KeepTheirGripThroughAFaultAndAReset) {
  world->set_object(0, 0.065);
  grip(0.055, 500);
  driver->trip({.code = FaultCode::emergency_stop});
  for (int k = 0; k < 50; ++k) macrostep();
  EXPECT_GT(world->truth(0).jaw_force, 50) << "the brake holds";
  send({.instruction = Instruction::reset});
  for (int k = 0; k < 200; ++k) macrostep();
  EXPECT_GT(world->truth(0).jaw_force, 50);
}

TEST_F(JawsOfAnArm, RefuseDistancesBeyondTheirStops) {
  for (const double wrong : {0.05, 0.092, -1.0})
    EXPECT_EQ(grip(wrong).fault.code, FaultCode::out_of_limits) << wrong;
}

TEST_F(JawsOfAnArm, OutputsReachTheControllerAndComeBackAsInputs) {
  EffectorCommand c{.instruction = Instruction::set_get};
  c.set = c.get = static_cast<std::uint8_t>(Part::io);
  c.outputs = 0xa5;
  send(c);
  c.instruction = Instruction::get;
  const EffectorReply reply = send(c);
  EXPECT_EQ(reply.inputs, 0xa5);
  EXPECT_TRUE(has(reply.parts, Part::io));
  EXPECT_EQ(macrostep().inputs, 0) << "lines are told when they are asked for";
}

}  // namespace
}  // namespace mrroc::sim
