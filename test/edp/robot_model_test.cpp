// ROBOT_MODEL, INPUTS and OUTPUTS: what is set is what the driver works with and tells.
#include <gtest/gtest.h>

#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr auto kModel = static_cast<std::uint8_t>(Part::robot_model);

EffectorCommand set_model(Rig& rig, const RobotModel& model) {
  EffectorCommand c = rig.command(Instruction::set);
  c.set = kModel;
  c.robot_model = model;
  return c;
}
EffectorReply get_model(Rig& rig, Representation tool = Representation::frame) {
  EffectorCommand c = rig.command(Instruction::get);
  c.get = kModel;
  c.get_tool_representation = tool;
  return rig.macrostep(c);
}

TEST(RobotModel, ARobotHasOneKinematicModelUnlessItSaysOtherwise) {
  const FakeArm arm;
  EXPECT_EQ(arm.model(), 0);
  EXPECT_EQ(arm.models(), 1);
  EXPECT_EQ(arm.with_model(0), &arm);
  EXPECT_EQ(arm.with_model(1), nullptr);
  EXPECT_EQ(arm.with_model(-1), nullptr);
}

TEST(RobotModel, ToolIsToldInEachOfItsRepresentations) {
  const Pose T_WE{rotation_from_angle_axis({0.1, -0.7, 0.4}), {0.01, -0.02, 0.2}};
  for (const Representation set :
       {Representation::frame, Representation::xyz_euler_zyz, Representation::xyz_angle_axis})
    for (const Representation got :
         {Representation::frame, Representation::xyz_euler_zyz, Representation::xyz_angle_axis}) {
      Rig rig;
      rig.synchronise();
      RobotModel m;
      m.set_tool = true;
      m.tool_representation = set;
      m.tool = numbers_from_pose(set, T_WE);
      EXPECT_EQ(rig.macrostep(set_model(rig, m)).verdict, Verdict::executed);
      const EffectorReply reply = get_model(rig, got);
      EXPECT_EQ(reply.parts, kModel);
      EXPECT_EQ(reply.robot_model.tool_representation, got);
      const std::optional<Pose> told = pose_from_numbers(got, reply.robot_model.tool);
      ASSERT_TRUE(told);
      EXPECT_LT((told->p - T_WE.p).norm() + (told->R - T_WE.R).norm(), 1e-12);
    }
}

TEST(RobotModel, ForceToolIsToldAsItWasSet) {
  Rig rig;
  rig.synchronise();
  RobotModel m;
  m.set_force_tool = true;
  m.weight = 7;
  m.mass_centre = {0.01, 0.02, 0.03};
  rig.macrostep(set_model(rig, m));
  const RobotModel told = get_model(rig).robot_model;
  EXPECT_EQ(told.weight, 7);
  EXPECT_EQ(told.mass_centre, m.mass_centre);
  rig.silence(20);
  EXPECT_EQ(rig.driver.reply().robot_model.weight, 7) << "also where nobody asks";
}

TEST(RobotModel, ServoAlgorithmOfEveryMotorIsChosenByItself) {
  Rig rig;
  rig.synchronise();
  RobotModel m;
  m.set_servo_algorithm = 0b010110;
  m.servo_algorithm = {200, 1, 1, 200, 1, 200};  // of motors that are not chosen it means nothing
  m.servo_parameter_set = {0, 1, 0, 0, 1, 0};
  const RobotModel before = get_model(rig).robot_model;
  EXPECT_EQ(rig.macrostep(set_model(rig, m)).verdict, Verdict::executed);
  const RobotModel told = get_model(rig).robot_model;
  EXPECT_EQ(told.set_servo_algorithm, 0b111111);
  for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
    const bool chosen = (m.set_servo_algorithm >> k & 1) != 0;
    EXPECT_EQ(told.servo_algorithm[k], chosen ? m.servo_algorithm[k] : before.servo_algorithm[k]) << k;
    EXPECT_EQ(told.servo_parameter_set[k], chosen ? m.servo_parameter_set[k] : before.servo_parameter_set[k])
        << k;
  }
}

TEST(RobotModel, UnknownNumbersAreRefusedAndNothingOfTheCommandIsDone) {
  const auto refused = [](RobotModel m) {
    Rig rig;
    rig.synchronise();
    m.set_force_tool = true;
    m.weight = 5;
    const EffectorReply reply = rig.macrostep(set_model(rig, m));
    EXPECT_EQ(reply.verdict, Verdict::refused);
    EXPECT_EQ(reply.fault.code, FaultCode::unknown_model);
    rig.number = rig.driver.protocol().expected() - 1;  // a refused command begins no session
    EXPECT_EQ(get_model(rig).robot_model.weight, 0);
    return reply.fault;
  };
  RobotModel kinematic;
  kinematic.set_kinematic_model = true;
  kinematic.kinematic_model = 9;
  const Fault model = refused(kinematic);
  EXPECT_EQ(model.value, 9);
  EXPECT_EQ(model.limit, 0) << "the last of one";
  for (int motor = 0; motor < FakeArm::kAxes; ++motor)
    for (const bool algorithm : {true, false}) {
      RobotModel servo;
      servo.set_servo_algorithm = static_cast<std::uint8_t>(1U << motor);
      (algorithm ? servo.servo_algorithm : servo.servo_parameter_set)[static_cast<std::size_t>(motor)] = 200;
      EXPECT_EQ(refused(servo).axis, motor) << algorithm;
    }
}

TEST(RobotModel, GetOfSeveralPartsTellsThemAll) {
  Rig rig;
  rig.synchronise();
  EffectorCommand c = rig.command(Instruction::set_get);
  c.set = static_cast<std::uint8_t>(Part::io);
  c.outputs = 0x8001;
  c.get = static_cast<std::uint8_t>((Part::arm | Part::io) | kModel);
  c.get_representation = Representation::motors;
  const EffectorReply reply = rig.macrostep(c);
  EXPECT_EQ(reply.parts, c.get);
  EXPECT_EQ(reply.representation, Representation::motors);
  EXPECT_EQ(rig.last.outputs, 0x8001);
  rig.silence(20);
  EXPECT_EQ(rig.last.outputs, 0x8001) << "lines stay until they are set again";
}

TEST(RobotModel, InputsAreToldWhenTheyAreAskedForAndNotOtherwise) {
  Rig rig;
  rig.synchronise();
  rig.world.inputs = 0x4002;
  rig.world.analog[0] = 1.5;
  rig.world.analog.back() = -2.5;
  EffectorCommand c = rig.command(Instruction::set_get);
  c.set = static_cast<std::uint8_t>(Part::io);
  c.get = static_cast<std::uint8_t>(Part::io);
  const EffectorReply asked = rig.macrostep(c);
  EXPECT_EQ(asked.inputs, 0x4002);
  EXPECT_EQ(asked.analog, rig.world.analog);
  rig.world.inputs = 0x0001;
  EffectorCommand silent = rig.command(Instruction::set);
  silent.set = static_cast<std::uint8_t>(Part::io);
  silent.get = static_cast<std::uint8_t>(Part::arm);
  EXPECT_EQ(rig.macrostep(silent).parts, 0) << "SET asks for nothing, whatever it names";
  c = rig.command(Instruction::get);
  c.get = static_cast<std::uint8_t>(Part::arm);
  const EffectorReply pose = rig.macrostep(c);
  EXPECT_EQ(pose.parts, c.get);
  EXPECT_EQ(pose.analog, decltype(pose.analog){}) << "nobody asked";
}

}  // namespace
}  // namespace mrroc::edp::test
