// Preparation of the effector before the task begins.
#include "ecp/preparation.hpp"

#include <gtest/gtest.h>

#include "test/ecp/effector_links_fixture.hpp"

namespace mrroc::ecp {
namespace {

using test::ArmLinksTest;

/// A driver that answers two macrosteps after a command was sent, as the real one does.
class PreparationTest : public ArmLinksTest {
 protected:
  /// Keeps the links supplied; answers command number n as it is told.
  void answer_all(const std::vector<EffectorReply>& answers) {
    begin(ClockKind::step, {.robot = "arm1", .sensor = ""});
    std::int64_t i = 1;
    for (const EffectorReply& r : answers) {
      reply(i, r);
      order(i++);
    }
    ASSERT_EQ(links->begin(), Outcome::terminated);
  }
  /// Replies to nothing, then to the command of macrostep 2 (stamp 3), and so on.
  static std::vector<EffectorReply> silence(int count, DriverState state) {
    EffectorReply r;
    r.state = state;
    return std::vector<EffectorReply>(static_cast<std::size_t>(count), r);
  }
  std::vector<effector_command_t> all_sent() {
    std::vector<effector_command_t> all;
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    while (const auto c = commands->take()) all.push_back(*c);
    return all;
  }
  static EffectorReply answered(std::int64_t number, DriverState state, Verdict verdict = Verdict::executed,
                                FaultCode code = FaultCode::none) {
    EffectorReply r;
    r.number = number;
    r.verdict = verdict;
    r.state = state;
    r.fault.code = code;
    r.expected = number + 1;
    return r;
  }
};

TEST_F(PreparationTest, SynchronisesWaitsUntilItIsAtRestAndSetsTheModel) {
  std::vector<EffectorReply> answers = silence(2, DriverState::not_synchronised);
  answers.push_back(answered(1, DriverState::homing));  // of macrostep 3
  for (const EffectorReply& r : silence(3, DriverState::homing)) answers.push_back(r);
  for (const EffectorReply& r : silence(1 + 4 + 1, DriverState::ready)) answers.push_back(r);
  answers.push_back(answered(2, DriverState::ready));
  for (std::size_t k = 0; k < answers.size(); ++k) {
    answers[k].T_0E[0] = 0.1 * static_cast<double>(k + 1);
    answers[k].F_a[Axis::z] = static_cast<double>(k + 1);
  }
  answer_all(answers);
  Preparation prepare{.settling_macrosteps = 4};
  prepare.model.weight = 7;
  EXPECT_EQ(prepare_effector(*links, prepare), Outcome::terminated);
  EXPECT_EQ(links->i(), static_cast<std::int64_t>(answers.size()));
  std::vector<std::pair<std::int64_t, int>> loud;
  const auto all = all_sent();
  ASSERT_EQ(all.size(), answers.size()) << "one in every macrostep";
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].header.stamp, static_cast<std::int64_t>(k) + 1);
    const auto report = reports->take();
    ASSERT_TRUE(report);
    EXPECT_EQ(report->ready, 0);
    if (k == 0) continue;
    EXPECT_EQ(report->driver_state, static_cast<int>(answers[k - 1].state)) << "as the driver said it";
    EXPECT_EQ(report->verdict, static_cast<int>(answers[k - 1].verdict));
    EXPECT_EQ(report->T_0E[0], answers[k - 1].T_0E[0]);
    EXPECT_EQ(report->F_a[2], answers[k - 1].F_a[Axis::z]);
    EXPECT_EQ(report->fault.code, static_cast<int>(answers[k - 1].fault.code));
  }
  for (const effector_command_t& c : all)
    if (c.instruction != static_cast<int>(Instruction::keep)) {
      loud.emplace_back(c.header.stamp, c.instruction);
      if (c.instruction == static_cast<int>(Instruction::set)) {
        EXPECT_EQ(c.set, static_cast<int>(Part::robot_model));
        EXPECT_EQ(c.robot_model.weight, 7);
      }
    }
  ASSERT_EQ(loud.size(), 2U);
  EXPECT_EQ(loud[0], (std::pair<std::int64_t, int>(2, static_cast<int>(Instruction::synchro))));
  // Homing is over in macrostep 7, four macrosteps at rest follow.
  EXPECT_EQ(loud[1], (std::pair<std::int64_t, int>(7 + 4 + 1, static_cast<int>(Instruction::set))));
}

TEST_F(PreparationTest, UnlessItIsToldOtherwiseTheArmRestsFor50MacrostepsBeforeItsForceIsBiased) {
  constexpr int kRests = 50;
  std::vector<EffectorReply> answers = silence(2, DriverState::not_synchronised);
  answers.push_back(answered(1, DriverState::ready));  // of macrostep 3
  for (const EffectorReply& r : silence(kRests + 1, DriverState::ready)) answers.push_back(r);
  answers.push_back(answered(2, DriverState::ready));
  answer_all(answers);
  EXPECT_EQ(prepare_effector(*links, {}), Outcome::terminated);
  EXPECT_EQ(links->i(), static_cast<std::int64_t>(answers.size()));
  std::vector<std::int64_t> set_in;
  for (const effector_command_t& c : all_sent())
    if (c.instruction == static_cast<int>(Instruction::set)) set_in.push_back(c.header.stamp);
  EXPECT_EQ(set_in, std::vector<std::int64_t>{3 + kRests + 1});
}

TEST_F(PreparationTest, WhatTheDriverRefusesIsTheReason) {
  std::vector<EffectorReply> answers = silence(2, DriverState::not_synchronised);
  answers.push_back(answered(1, DriverState::not_synchronised, Verdict::refused, FaultCode::start_guard));
  answer_all(answers);
  EXPECT_EQ(prepare_effector(*links, {}), Outcome::faulted);
  EXPECT_EQ(fault_of(*links).code, FaultCode::start_guard);
}

TEST_F(PreparationTest, AToolThatTheDriverRefusesIsAFailureAndALostCommandIsNone) {
  for (const bool lost : {false, true}) {
    std::vector<EffectorReply> answers = silence(2, DriverState::not_synchronised);
    answers.push_back(answered(1, DriverState::ready));
    for (const EffectorReply& r : silence(1 + 3, DriverState::ready))
      answers.push_back(r);  // 3 macrosteps at rest
    answers.push_back(answered(2, DriverState::ready, Verdict::refused,
                               lost ? FaultCode::lost_command : FaultCode::out_of_limits));
    if (lost) {  // it is sent again, and is executed then
      answers.push_back(silence(1, DriverState::ready).front());
      answers.push_back(answered(2, DriverState::ready));
    }
    answer_all(answers);
    EXPECT_EQ(prepare_effector(*links, {.settling_macrosteps = 3}),
              lost ? Outcome::terminated : Outcome::faulted);
    EXPECT_EQ(links->i(), static_cast<std::int64_t>(answers.size()));
    if (!lost) {
      EXPECT_EQ(fault_of(*links).code, FaultCode::out_of_limits);
    }
  }
}

TEST_F(PreparationTest, HomingThatEndsWithoutPositionsIsAFailure) {
  for (const DriverState end : {DriverState::faulted, DriverState::not_synchronised, DriverState::jogging}) {
    std::vector<EffectorReply> answers = silence(2, DriverState::not_synchronised);
    answers.push_back(answered(1, DriverState::homing));
    EffectorReply last;
    last.state = end;
    last.fault.code = FaultCode::synchro_switch_missing;
    answers.push_back(last);
    answer_all(answers);
    EXPECT_EQ(prepare_effector(*links, {}), Outcome::faulted) << static_cast<int>(end);
    EXPECT_EQ(fault_of(*links).code, FaultCode::synchro_switch_missing);
  }
}

TEST_F(PreparationTest, AProgramThatPreparesItselfIsLeftAlone) {
  answer_all(silence(1, DriverState::not_synchronised));
  EXPECT_EQ(prepare_effector(*links, {.by_program = true}), Outcome::terminated);
  EXPECT_EQ(links->i(), 1);
}

TEST(ToolModel, IsReadFromTheArmsSection) {
  const Config config = Config::parse(
      "[robots.arm2.tool]\npose = [0.1, 0, 0.2, 0, 0, 1.5]\nweight = 6.5\nmass_centre = [0, 0.01, 0.05]\n",
      "test");
  const RobotModel m = read_tool_model(config, "arm2");
  EXPECT_TRUE(m.set_tool);
  EXPECT_TRUE(m.set_force_tool);
  EXPECT_EQ(m.tool_representation, Representation::xyz_angle_axis);
  EXPECT_EQ(m.tool[2], 0.2);
  EXPECT_EQ(m.tool[5], 1.5);
  EXPECT_EQ(m.weight, 6.5);
  EXPECT_EQ(m.mass_centre[1], 0.01);
  EXPECT_THROW((void)read_tool_model(config, "arm1"), FaultError);
}

TEST(ToolModel, IsTakenUpToItsLimitsAndNotBeyond) {
  const auto taken = [](const std::string& pose, const std::string& weight, const std::string& centre) {
    const Config config =
        Config::parse("[robots.a.tool]\npose = [0, 0, 0, 0, 0, " + pose + "]\nweight = " + weight +
                          "\nmass_centre = [0, 0, " + centre + "]\n",
                      "test");
    try {
      const RobotModel m = read_tool_model(config, "a");
      EXPECT_EQ(m.tool[5], std::stod(pose));
      EXPECT_EQ(m.weight, std::stod(weight));
      EXPECT_EQ(m.mass_centre[2], std::stod(centre));
    } catch (const FaultError&) {
      return false;
    }
    return true;
  };
  EXPECT_TRUE(taken("10", "50", "1"));
  EXPECT_TRUE(taken("-10", "0", "-1"));
  for (const char* pose : {"10.1", "-10.1"}) EXPECT_FALSE(taken(pose, "1", "0")) << pose;
  for (const char* weight : {"50.1", "-0.1"}) EXPECT_FALSE(taken("0", weight, "0")) << weight;
  for (const char* centre : {"1.1", "-1.1"}) EXPECT_FALSE(taken("0", "1", centre)) << centre;
}

}  // namespace
}  // namespace mrroc::ecp
