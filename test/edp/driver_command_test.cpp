// Commands that a driver accepts; a refusal changes nothing.
#include <gtest/gtest.h>

#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {
namespace {

EffectorCommand force_bias(Rig& rig) {
  EffectorCommand c = rig.command(Instruction::set);
  c.set = static_cast<std::uint8_t>(Part::force_bias);
  return c;
}

EffectorCommand force_tool(Rig& rig, double weight, const std::array<double, 3>& centre) {
  EffectorCommand c = rig.command(Instruction::set);
  c.set = static_cast<std::uint8_t>(Part::robot_model);
  c.robot_model.set_force_tool = true;
  c.robot_model.weight = weight;
  c.robot_model.mass_centre = centre;
  return c;
}

TEST(DriverCommand, BeforeSynchroTheDrivesBrakeAndAfterItTheyHoldTheKnownPose) {
  DriverParameters p = Rig::parameters();
  p.synchro_joints << 0.1, -0.2, 0.3, 0.4, -0.5, 0.6;
  Rig rig(p);
  rig.silence(3);
  EXPECT_FALSE(rig.last.enabled);
  EXPECT_EQ(rig.driver.state(), DriverState::not_synchronised);
  const EffectorReply reply = rig.synchronise();
  EXPECT_EQ(reply.verdict, Verdict::executed);
  EXPECT_EQ(reply.state, DriverState::ready);
  EXPECT_TRUE(rig.last.enabled);
  for (int k = 0; k < FakeArm::kAxes; ++k) {
    EXPECT_NEAR(reply.joints[static_cast<std::size_t>(k)], p.synchro_joints[k], 1e-12);
    EXPECT_EQ(rig.last.pwm[static_cast<std::size_t>(k)], 0);
  }
  rig.silence(20);
  EXPECT_LT((rig.driver.set_point().axes.joints - p.synchro_joints).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(DriverCommand, RelativeCommandRepeatedByItsNumberIsExecutedOnce) {
  Rig rig;
  rig.synchronise();
  ArmCommand a;
  a.mu = Interpolation::mim;
  a.reference = Reference::relative;
  a.representation = Representation::motors;
  a.pose = {4};
  const EffectorCommand c = rig.set_arm(a);
  const EffectorReply first = rig.macrostep(c);
  rig.silence(10);
  const double motor = rig.driver.set_point().axes.motors[0];
  for (int k = 0; k < 3; ++k) {
    EffectorReply again = rig.macrostep(c);
    EXPECT_EQ(again.number, first.number);
    EXPECT_EQ(again.step, first.step) << "the reply stored then";
    EXPECT_EQ(again.T_0E, first.T_0E);
  }
  EXPECT_EQ(rig.driver.set_point().axes.motors[0], motor);
}

TEST(DriverCommand, LostCommandNamesTheExpectedNumberAndTheSenderCanGoOn) {
  Rig rig;
  rig.synchronise();
  EffectorCommand c = rig.velocity({u(0.01), u(), u(), u(), u(), u()});
  c.number += 3;
  const EffectorReply reply = rig.macrostep(c);
  EXPECT_EQ(reply.verdict, Verdict::refused);
  EXPECT_EQ(reply.fault.code, FaultCode::lost_command);
  EXPECT_EQ(reply.expected, 2);
  c.number = reply.expected;
  EXPECT_EQ(rig.macrostep(c).verdict, Verdict::executed);
}

TEST(DriverCommand, QueryGivesTheReplyOfTheLastCommandAndMovesNothing) {
  Rig rig;
  rig.synchronise();
  const EffectorReply moved = rig.macrostep(rig.velocity({u(0.05), u(), u(), u(), u(), u()}));
  EffectorCommand q;
  q.session = 7;
  q.instruction = Instruction::query;
  q.queried = moved.number;
  const EffectorReply reply = rig.macrostep(q);
  EXPECT_EQ(reply.number, moved.number);
  EXPECT_EQ(reply.step, moved.step);
  EXPECT_EQ(rig.driver.state(), DriverState::decelerating) << "a query is silence for the motion";
  q.queried = 99;
  EXPECT_EQ(rig.macrostep(q).fault.code, FaultCode::unknown_number);
}

TEST(DriverCommand, StartGuardRefusesLeftOversForItsSteps) {
  DriverParameters p = Rig::parameters();
  p.start_guard_steps = 125;
  Rig rig(p);
  EffectorCommand c = rig.command(Instruction::synchro);
  for (int k = 0; k < 13; ++k) {
    const EffectorReply reply = rig.macrostep(c);
    EXPECT_EQ(reply.verdict, Verdict::refused) << k;
    EXPECT_EQ(reply.fault.code, FaultCode::start_guard);
  }
  EXPECT_EQ(rig.macrostep(c).verdict, Verdict::executed);
}

TEST(DriverCommand, KeepAndReleaseAreSilence) {
  Rig rig;
  rig.synchronise();
  rig.macrostep(rig.velocity({u(0.05), u(), u(), u(), u(), u()}));
  EffectorCommand keep;
  keep.session = 7;
  keep.number = rig.number;
  const EffectorReply reply = rig.macrostep(keep);
  EXPECT_EQ(reply.verdict, Verdict::none);
  EXPECT_EQ(reply.number, 0);
  EXPECT_EQ(reply.state, DriverState::decelerating);
  keep.instruction = Instruction::release;
  rig.macrostep(keep);
  EXPECT_FALSE(rig.driver.protocol().owner());
  EffectorCommand other;
  other.session = 8;
  other.number = 1;
  other.instruction = Instruction::get;
  other.get = static_cast<std::uint8_t>(Part::arm);
  EXPECT_EQ(rig.macrostep(other).verdict, Verdict::executed);
}

TEST(DriverCommand, ForceIsZeroAfterTheBiasWhateverTheToolAndTheOrientation) {
  Rig rig;
  rig.world.weight = 8;
  rig.world.mass_centre = Vector3(0.01, -0.02, 0.1);
  rig.world.sensor_offset = Wrench{{1, -2, 3, 0.1, 0.2, -0.3}};
  rig.synchronise();
  EXPECT_EQ(rig.macrostep(force_tool(rig, 8, {0.01, -0.02, 0.1})).verdict, Verdict::executed);
  const TaskFrameCommand turn{u(), u(), u(), u(0.4), u(-0.3), u(0.5)};
  for (int k = 0; k < 40; ++k) {
    const EffectorReply reply = rig.macrostep(rig.velocity(turn));
    ASSERT_LT(reply.F_a.vector().cwiseAbs().maxCoeff(), 1e-3) << "the encoders' resolution and no more";
  }
}

TEST(DriverCommand, TheModelThatIsGotIsTheOneThatWasSetLast) {
  Rig rig;
  rig.synchronise();
  for (const double weight : {3., 1.5, 2.}) {
    EffectorCommand c = force_tool(rig, weight, {0.01 * weight, 0.02, -0.03});
    c.instruction = Instruction::set_get;
    c.get = static_cast<std::uint8_t>(Part::robot_model);
    c.get_tool_representation = Representation::xyz_angle_axis;
    const EffectorReply reply = rig.macrostep(c);
    ASSERT_EQ(reply.verdict, Verdict::executed);
    EXPECT_EQ(reply.robot_model.weight, weight);
    EXPECT_EQ(reply.robot_model.mass_centre, (std::array<double, 3>{0.01 * weight, 0.02, -0.03}));
    EXPECT_EQ(reply.robot_model.tool_representation, Representation::xyz_angle_axis);
    EXPECT_NEAR(reply.robot_model.tool[2], Rig::parameters().T_WE.p.z(), 1e-12);
  }
}

TEST(DriverCommand, BiasZeroesTheForceAndIsRefusedInMotion) {
  Rig rig;
  rig.world.sensor_offset = Wrench{{1, -2, 3, 0.1, 0.2, -0.3}};
  rig.synchronise();
  EXPECT_NEAR(rig.silence(1).F_a[Axis::z], -3, 1e-9);
  EXPECT_LT(rig.macrostep(force_bias(rig)).F_a.vector().cwiseAbs().maxCoeff(), 1e-9);
  rig.macrostep(rig.velocity({u(0.05), u(), u(), u(), u(), u()}));
  const EffectorReply reply = rig.macrostep(force_bias(rig));
  EXPECT_EQ(reply.fault.code, FaultCode::not_at_rest);
}

TEST(DriverCommand, BiasGivenWithAMotionIsTheMeanOfTheStandstillBeforeIt) {
  Rig rig;
  rig.synchronise();
  int k = 0;
  rig.after_each_step = [&] { rig.world.sensor_offset[Axis::z] = ++k % 2 ? 1 : 3; };
  rig.silence(6);
  EffectorCommand c = rig.velocity({u(0.01), u(), u(), u(), u(), u()});
  c.set = Part::arm | Part::force_bias;
  EXPECT_NEAR(std::abs(rig.macrostep(c).F_a[Axis::z]), 1, 0.05);
}

TEST(DriverCommand, SecondCommandAtOneBoundaryIsIgnored) {
  Rig rig;
  rig.synchronise();
  const EffectorCommand first = rig.velocity({u(0.01), u(), u(), u(), u(), u()});
  rig.driver.take(first);
  rig.driver.take(rig.velocity({u(), u(0.01), u(), u(), u(), u()}));
  EXPECT_EQ(rig.macrostep().number, first.number);
  EXPECT_EQ(rig.driver.set_point().T_0E.p.y(), 0);
}

TEST(DriverCommand, ReplyOfEveryMacrostepCarriesTheMeasurements) {
  Rig rig;
  rig.synchronise();
  rig.world.stiffness[0] = 1000;
  rig.world.T_0E_free.p.x() += 0.001;
  const EffectorReply reply = rig.silence(2);
  EXPECT_EQ(reply.verdict, Verdict::none);
  EXPECT_NEAR(reply.F_a[Axis::x], -1, 1e-2);
  EXPECT_NEAR(reply.T_0E[2], 0.1, 1e-9);
  EXPECT_EQ(reply.expected, 2);
}

TEST(DriverCommand, OneThatComesInTheMiddleOfAMacrostepIsIgnored) {
  Rig rig;
  rig.synchronise();
  rig.step();
  rig.driver.take(rig.velocity({u(0.01), u(), u(), u(), u(), u()}));
  const EffectorReply reply = rig.macrostep();
  EXPECT_EQ(reply.verdict, Verdict::none);
  EXPECT_EQ(reply.number, 0);
  EXPECT_EQ(reply.expected, rig.number) << "it may be sent again";
  EXPECT_EQ(rig.driver.state(), DriverState::ready);
}

TEST(DriverCommand, RepliesAndSetValuesOfTheDrivesNameTheStepOfTheirReading) {
  Rig rig;
  rig.synchronise();
  std::int64_t step = rig.world.reading().step;
  rig.after_each_step = [&] {
    EXPECT_EQ(rig.last.step, step);
    if (rig.driver.reply_due()) {
      EXPECT_EQ(rig.driver.reply().step, step);
    }
    step = rig.world.reading().step;
  };
  rig.macrostep(rig.velocity({u(0.01), u(), u(), u(), u(), u()}));
  rig.silence(2);
}

TEST(DriverCommand, ReplyCarriesTheCurrentsOfAllStepsSinceTheReplyBefore) {
  Rig rig;
  rig.synchronise();
  rig.silence(1);
  // The reply comes in the last step but one: the last one before belongs to the next reply.
  for (int macrostep = 0; macrostep < 2; ++macrostep)
    for (int k = 0; k < 10; ++k) {
      HardwareReading reading = rig.world.reading();
      reading.current[2] = macrostep == 0 && k == 9 ? -3 : macrostep == 1 && k < 9 ? 1 : 0;
      rig.world.apply(rig.driver.step(reading));
    }
  const CurrentStatistics& current = rig.driver.reply().current;
  EXPECT_DOUBLE_EQ(current.mean[2], (9 - 3) / 10.);
  EXPECT_EQ(current.least[2], -3);
  EXPECT_EQ(current.greatest[2], 1);
  EXPECT_EQ(current.greatest[1], 0);
}

TEST(DriverCommand, ReplySaysWhetherTheRobotIsAtRest) {
  Rig rig;
  rig.synchronise();
  EXPECT_FALSE(rig.macrostep(rig.velocity({u(0.05), u(), u(), u(), u(), u()})).at_rest);
  EXPECT_FALSE(rig.silence(1).at_rest);
  EXPECT_TRUE(rig.silence(100).at_rest);
}

TEST(DriverCommand, ReplyOfSilenceNamesTheOwnerAsLongAsThereIsOne) {
  Rig rig;
  rig.synchronise();
  EXPECT_EQ(rig.silence(1).session, 7);
  EXPECT_TRUE(rig.driver.owned_by_another(8));
  EXPECT_FALSE(rig.driver.owned_by_another(7));
  rig.driver.drop_owner();
  EXPECT_EQ(rig.silence(1).session, 0);
  EXPECT_FALSE(rig.driver.owned_by_another(8));
}

}  // namespace
}  // namespace mrroc::edp::test
