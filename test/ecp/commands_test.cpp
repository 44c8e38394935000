// Commands for the rows of a Move table: what they say, and that they say nothing else.
#include "ecp/generators/commands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "base/agent_images.hpp"
#include "base/msg/convert.hpp"
#include "base/representation.hpp"
#include "ecp/transparent.hpp"
#include "test/base/random_pose.hpp"

namespace mrroc::ecp {
namespace {

using test::random_pose;
using test::random_vector;
using test::uniform;

constexpr auto kModel = static_cast<std::uint8_t>(Part::robot_model);
constexpr auto kArm = static_cast<std::uint8_t>(Part::arm);

/// @return all that a command says, as it is sent
std::vector<std::uint8_t> said(const EffectorCommand& command) {
  const effector_command_t m = to_message(command);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(m.getEncodedSize()));
  m.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

TaskFrameCommand random_frame(std::mt19937_64& random) {
  TaskFrameCommand frame;
  for (const Axis a : kAxes)
    frame[a] = random() % 2 == 0
                   ? g(uniform(random, -1, 1), uniform(random, 1, 9), uniform(random, 0.001, 1))
                   : c(uniform(random, -9, 9), uniform(random, 1, 9), uniform(random, 0.001, 1));
  return frame;
}

/// @return a command that says something of everything
EffectorCommand random_command(std::mt19937_64& random) {
  EffectorCommand command;
  command.session = static_cast<std::int64_t>(random() >> 1);
  command.number = static_cast<std::int64_t>(random() % 1000);
  command.macrostep = static_cast<std::int64_t>(random() % 1000);
  command.instruction = static_cast<Instruction>(random() % 5);
  command.set = static_cast<std::uint8_t>(random() % 32);
  command.get = static_cast<std::uint8_t>(random() % 32);
  command.arm.frame = random_frame(random);
  for (double& x : command.arm.pose) x = uniform(random, -1, 1);
  RobotModel& model = command.robot_model;
  model.set_tool = random() % 2 == 0;
  model.tool_representation =
      random() % 2 == 0 ? Representation::xyz_angle_axis : Representation::xyz_euler_zyz;
  for (double& x : model.tool) x = uniform(random, -1, 1);
  model.set_kinematic_model = random() % 2 == 0;
  model.kinematic_model = static_cast<std::uint16_t>(random() % 9);
  model.set_force_tool = random() % 2 == 0;
  model.weight = uniform(random, 0, 50);
  command.outputs = static_cast<std::uint16_t>(random());
  return command;
}

TEST(Commands, AToolIsAddedToACommandAndTheRestOfItStaysAsItIs) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 200; ++k) {
    EffectorCommand command = random_command(random);
    const Pose T_WE = random_pose(random);
    const EffectorCommand with = with_tool(command, T_WE);
    EXPECT_TRUE(has(with.set, Part::robot_model));
    EXPECT_TRUE(with.robot_model.set_tool);
    const auto tool = pose_from_numbers(with.robot_model.tool_representation, with.robot_model.tool);
    ASSERT_TRUE(tool);
    EXPECT_LT(test::distance(*tool, T_WE), 1e-12);
    EXPECT_EQ(with.instruction,
              command.instruction == Instruction::keep ? Instruction::set : command.instruction);
    command.instruction = with.instruction;
    command.set |= kModel;
    command.robot_model.set_tool = true;
    command.robot_model.tool_representation = with.robot_model.tool_representation;
    command.robot_model.tool = with.robot_model.tool;
    EXPECT_EQ(said(with), said(command)) << k;
  }
}

TEST(Commands, AForceToolIsSetAndNothingElse) {
  std::mt19937_64 random(2);
  for (int k = 0; k < 20; ++k) {
    const double w = uniform(random, 0, 50);
    const Vector3 P = random_vector(random, 1);
    EffectorCommand expected{.instruction = Instruction::set, .set = kModel};
    expected.robot_model.set_force_tool = true;
    expected.robot_model.weight = w;
    std::ranges::copy(P, expected.robot_model.mass_centre.begin());
    EXPECT_EQ(said(change_force_tool(w, P)), said(expected));
  }
}

TEST(Commands, ABiasIsSetAndRestIsNothingAtAll) {
  EXPECT_EQ(said(bias_force()),
            said({.instruction = Instruction::set, .set = static_cast<std::uint8_t>(Part::force_bias)}));
  EXPECT_EQ(said(rest()), said(EffectorCommand{}));
}

TEST(Commands, AMotionIsSetAndItsReplyAskedFor) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 20; ++k) {
    EffectorCommand expected{.instruction = Instruction::set_get, .set = kArm, .get = kArm};
    expected.arm.frame = random_frame(random);
    expected.arm.n_s = static_cast<std::uint16_t>(2 + random() % 50);
    expected.arm.n_Q = static_cast<std::uint16_t>(1 + random() % expected.arm.n_s);
    const Pacing pacing{.n_s = expected.arm.n_s, .n_Q = expected.arm.n_Q};
    EXPECT_EQ(said(move_arm(expected.arm.frame, pacing)), said(expected));
    std::ranges::generate(expected.arm.pose, [&] { return uniform(random, -1, 1); });
    expected.arm.mu = Interpolation::mim;
    EXPECT_EQ(said(move_arm(expected.arm)), said(expected));
  }
}

struct Arm : ArmAgent<None> {};

TEST(Transparent, CopiesTheOrderUnderTheCoordinatorsNumberUntilTheTaskIsOver) {
  constexpr Motion<Arm> kRow = transparent<Arm>();
  EXPECT_EQ(kRow.m, 0) << "the agent's only behaviour has no number of its own";
  std::mt19937_64 random(4);
  for (int k = 0; k < 20; ++k) {
    const int m = static_cast<int>(random() % 9);
    const TaskFrameCommand frame = random_frame(random);
    const Pacing pacing{.n_s = static_cast<std::uint16_t>(2 + random() % 50), .n_Q = 2};
    Arm::X x;
    x.T = order(m, frame, pacing);
    EXPECT_EQ(x.T.m, m);
    EXPECT_EQ(kRow.f_cT(x).m, m);
    EXPECT_EQ(said(kRow.f_ce(x)), said(move_arm(frame, pacing)));
    EXPECT_FALSE(kRow.f_tau(x));
    x.T.late = true;
    EXPECT_EQ(said(kRow.f_ce(x)), said(EffectorCommand{})) << "it comes to rest and holds";
    x.T.finished = true;
    EXPECT_TRUE(kRow.f_tau(x));
  }
}

}  // namespace
}  // namespace mrroc::ecp
