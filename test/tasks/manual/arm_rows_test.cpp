// Each row of the manual agent alone: what it commands, when it ends, and what it remembers, macrostep by macrostep.
#include <gtest/gtest.h>

#include "base/script_port.hpp"
#include "ecp/generators/rows.hpp"
#include "ecp/generators/space.hpp"
#include "tasks/manual/arm.hpp"

namespace mrroc::manual {
namespace {

using X = Arm::X;

/// An image in which a behaviour does its order since so many macrosteps, and nothing is wrong.
X at(std::int64_t age, Kind kind = Kind::bias) {
  X x;
  x.i_0 = 100;
  x.i = 100 + age;
  x.T.manual.kind = kind;
  x.T.manual.number = x.c.doing = 4;
  x.c.done = 3;
  x.e.state = DriverState::executing;
  x.e.verdict = Verdict::none;
  return x;
}

X with(X x, DriverState state, Verdict verdict = Verdict::none, FaultCode code = FaultCode::none) {
  x.e.state = state;
  x.e.verdict = verdict;
  x.e.fault.code = code;
  return x;
}

/// @return whether the behaviour is over, by itself or by what its row says of a mishap
bool ends(Row r, const X& x) { return row(r).f_tau(x) || leaves_behaviour(response(row(r), x)); }

TEST(ManualRows, AreNumberedInTheirOrderAndSayWhatEndsThem) {
  for (std::size_t k = 0; k < kManual.size(); ++k) {
    EXPECT_EQ(kManual[k].m, static_cast<int>(k) + 1);
    EXPECT_FALSE(kManual[k].name.empty());
    EXPECT_FALSE(kManual[k].until.empty());
  }
}

TEST(ManualRows, IdleEndsWithANewOrderAndWithTheTask) {
  X x = at(5);
  x.c.done = 4;
  EXPECT_FALSE(ends(Row::idle, x));
  x.T.finished = true;
  EXPECT_TRUE(ends(Row::idle, x));
  x.T.finished = false;
  x.T.manual.number = 5;
  EXPECT_TRUE(ends(Row::idle, x));
}

TEST(ManualRows, WhatIsCalledOffEndsAtOnceAndSoDoesEverythingWithTheTask) {
  for (const Row r : {Row::find_position, Row::settle, Row::set_tool, Row::move, Row::set, Row::grip}) {
    X x = at(0);
    x.c.path = {};
    x.T.manual.value[0] = 1;
    if (r != Row::move) {
      EXPECT_FALSE(ends(r, x)) << row(r).name;
    }
    X other = x;
    other.T.manual.number = 5;
    EXPECT_TRUE(ends(r, other)) << row(r).name;
    x.T.finished = true;
    EXPECT_TRUE(ends(r, x)) << row(r).name;
  }
}

TEST(ManualRows, AFaultEndsWhatItIsOfAndIsBelievedWhenTheAnswerCanBeThere) {
  for (const Row r : {Row::find_position, Row::set_tool, Row::move, Row::set, Row::grip}) {
    const auto fails = [&](std::int64_t age, DriverState state, Verdict verdict, FaultCode code,
                           Kind kind = Kind::move) {
      X x = with(at(age, kind), state, verdict, code);
      x.T.manual.value[0] = 1;  // the jaws are not there
      X quiet = with(at(age, kind), DriverState::executing);
      quiet.T.manual.value[0] = 1;
      return ends(r, x) && !ends(r, quiet);
    };
    constexpr DriverState kHolds = DriverState::executing;
    EXPECT_FALSE(fails(1, kHolds, Verdict::refused, FaultCode::joint_limit)) << row(r).name;
    EXPECT_TRUE(fails(2, kHolds, Verdict::refused, FaultCode::joint_limit)) << row(r).name;
    EXPECT_TRUE(fails(2, kHolds, Verdict::failed, FaultCode::joint_limit)) << row(r).name;
    EXPECT_FALSE(fails(2, kHolds, Verdict::none, FaultCode::joint_limit)) << row(r).name;
    EXPECT_FALSE(fails(2, kHolds, Verdict::refused, FaultCode::lost_command)) << "it is sent again";
    EXPECT_TRUE(fails(2, DriverState::faulted, Verdict::none, FaultCode::over_current)) << row(r).name;
    EXPECT_FALSE(fails(2, DriverState::faulted, Verdict::refused, FaultCode::reset_required))
        << "which one it is comes later";
    EXPECT_FALSE(fails(2, DriverState::faulted, Verdict::none, FaultCode::none)) << row(r).name;
    EXPECT_TRUE(fails(2, DriverState::faulted, Verdict::refused, FaultCode::reset_required, Kind::reset))
        << "a reset that is refused has failed";
    EXPECT_FALSE(fails(2, DriverState::faulted, Verdict::none, FaultCode::over_current, Kind::reset))
        << "what it is to acknowledge";
    X own = at(0);
    own.T.manual.value[0] = 1;
    own.c.fault.code = FaultCode::not_ready;
    EXPECT_TRUE(ends(r, own)) << row(r).name;
  }
}

TEST(ManualRows, HomingEndsWhenTheDriverIsReadyAfterItHasBegun) {
  for (std::int64_t age = 0; age <= 3; ++age)
    EXPECT_FALSE(ends(Row::find_position, with(at(age), DriverState::ready))) << "it was so before";
  EXPECT_TRUE(ends(Row::find_position, with(at(4), DriverState::ready)));
  for (const DriverState state : {DriverState::homing, DriverState::holding, DriverState::executing})
    EXPECT_FALSE(ends(Row::find_position, with(at(4), state)));
}

TEST(ManualRows, AWaitInVainIsAFaultOfItsOwn) {
  const auto remembered = [](Row r, std::int64_t age) { return row(r).f_cc(at(age)).fault.code; };
  EXPECT_EQ(remembered(Row::find_position, 8999), FaultCode::none);
  EXPECT_EQ(remembered(Row::find_position, 9000), FaultCode::not_ready) << "three minutes";
  for (const Row r : {Row::set_tool, Row::set}) {
    EXPECT_EQ(remembered(r, 49), FaultCode::none);
    EXPECT_EQ(remembered(r, 50), FaultCode::peer_silent) << "a second";
  }
  for (const Row r : {Row::idle, Row::settle, Row::move, Row::grip})
    EXPECT_EQ(remembered(r, 100'000), FaultCode::none);
}

TEST(ManualRows, BeforeTheForceIsBiasedTheArmRestsForASecond) {
  EXPECT_FALSE(ends(Row::settle, at(49)));
  EXPECT_TRUE(ends(Row::settle, at(50)));
}

TEST(ManualRows, ASettingEndsWithItsAnswer) {
  for (const Row r : {Row::set_tool, Row::set}) {
    EXPECT_FALSE(ends(r, with(at(1), DriverState::executing, Verdict::executed))) << "of the command before";
    EXPECT_TRUE(ends(r, with(at(2), DriverState::executing, Verdict::executed)));
    EXPECT_FALSE(ends(r, with(at(2), DriverState::executing, Verdict::none)));
  }
}

TEST(ManualRows, TheJawsAreThereOrHoldSomethingOrHaveHadTheirTime) {
  const auto ends_at = [](std::int64_t age, double gripper, bool blocked) {
    X x = at(age, Kind::gripper);
    x.T.manual.value[0] = 0.07;
    x.e.gripper = gripper;
    x.e.blocked = blocked;
    return ends(Row::grip, x);
  };
  EXPECT_FALSE(ends_at(12, 0.07, true)) << "they may not have begun";
  EXPECT_TRUE(ends_at(13, 0.07, false));
  EXPECT_TRUE(ends_at(13, 0.0704, false));
  EXPECT_TRUE(ends_at(13, 0.0696, false));
  EXPECT_FALSE(ends_at(13, 0.0706, false));
  EXPECT_FALSE(ends_at(13, 0.0694, false));
  EXPECT_TRUE(ends_at(13, 0.09, true));
  EXPECT_FALSE(ends_at(249, 0.09, false));
  EXPECT_TRUE(ends_at(250, 0.09, false));
}

TEST(ManualRows, AMotionEndsWhenItsPathIsExecutedAndTheArmRests) {
  X x = at(0, Kind::move);
  x.e.joints = {0.1, -1.5, 0.1, 1.5, 1.5, -1.5};
  x.e.state = DriverState::holding;
  x.T.manual.value = {0.2, -1.5, 0.1, 1.5, 1.5, -1.5};
  x.c = row(Row::move).f_entry(x);
  ASSERT_FALSE(x.c.fault);
  const std::int64_t n = x.c.path.macrosteps();
  ASSERT_GT(n, 10);
  const auto ends_at = [&](std::int64_t age, DriverState state) {
    X later = with(x, state);
    later.i = later.i_0 + age;
    return ends(Row::move, later);
  };
  EXPECT_FALSE(ends_at(n + 2, DriverState::holding));
  EXPECT_TRUE(ends_at(n + 3, DriverState::holding));
  for (const DriverState state : {DriverState::executing, DriverState::decelerating, DriverState::jogging})
    EXPECT_FALSE(ends_at(n + 3, state));
  const auto commands = [&](std::int64_t age, DriverState state) {
    X later = with(x, state);
    later.i = later.i_0 + age;
    return row(Row::move).f_ce(later).instruction;
  };
  EXPECT_EQ(commands(n - 1, DriverState::executing), Instruction::set_get);
  EXPECT_EQ(commands(n, DriverState::executing), Instruction::keep);
  EXPECT_EQ(commands(0, DriverState::faulted), Instruction::keep);
}

TEST(ManualRows, APoseGoesAlongAStraightLineAndAxesEachOnItsOwn) {
  X x = at(0, Kind::move);
  x.e.state = DriverState::holding;
  x.e.joints = {0.1, -1.5, 0.1, 1.5, 1.5, -1.5};
  x.e.motors = {1, 2, 3, 4, 5, 6};
  x.e.T_0E = {0.9, 0, 1.2, 0, 3, 0};
  for (const Representation space : {Representation::joints, Representation::motors,
                                     Representation::xyz_angle_axis, Representation::xyz_euler_zyz})
    for (const Reference reference : {Reference::absolute, Reference::relative}) {
      const bool per_axis = space == Representation::joints || space == Representation::motors;
      x.T.manual.space = space;
      x.T.manual.reference = reference;
      x.T.manual.value = {};
      x.T.manual.value[2] = 0.02;
      if (reference == Reference::absolute) {
        if (per_axis)
          std::copy_n((space == Representation::joints ? x.e.joints : x.e.motors).begin(), 6,
                      x.T.manual.value.begin());
        else
          x.T.manual.value = {0.9, 0, 1.2, 0, 3, 0};
        x.T.manual.value[0] += 0.02;
      }
      const Memory c = row(Row::move).f_entry(x);
      ASSERT_FALSE(c.fault) << static_cast<int>(space);
      const ArmCommand command = c.path.command(0);
      EXPECT_EQ(command.representation, space);
      EXPECT_EQ(command.mu, per_axis ? Interpolation::mim : Interpolation::tcim_pose);
      EXPECT_EQ(command.reference, space == Representation::motors ? reference : Reference::absolute);
    }
}

TEST(ManualRows, SpeedAndAccelerationOfAnOrderAreThoseOfItsMotion) {
  const auto lasts = [](double velocity, double acceleration) {
    X x = at(0, Kind::move);
    x.e.state = DriverState::holding;
    x.T.manual.value[0] = 1;
    x.T.manual.velocity = velocity;
    x.T.manual.acceleration = acceleration;
    return row(Row::move).f_entry(x).path.macrosteps();
  };
  EXPECT_GT(lasts(0.1, 0.5), lasts(0.2, 0.5));
  EXPECT_GT(lasts(0.5, 0.01), lasts(0.5, 0.02));
}

TEST(ManualRows, ACommandThatIsRefusedOrFailsIsWhyTheOrderFails) {
  for (const Row r : {Row::find_position, Row::set_tool, Row::move, Row::set, Row::grip})
    for (const Verdict bad : {Verdict::refused, Verdict::failed}) {
      const auto noted = [&](std::int64_t age, FaultCode code) {
        return row(r).f_cc(with(at(age), DriverState::holding, bad, code)).fault.code;
      };
      EXPECT_EQ(noted(1, FaultCode::joint_limit), FaultCode::none) << "that is the order's before";
      EXPECT_EQ(noted(2, FaultCode::joint_limit), FaultCode::joint_limit) << row(r).name;
      EXPECT_EQ(noted(2, FaultCode::lost_command), FaultCode::none) << "it is sent again";
      X own = with(at(2), DriverState::holding, bad, FaultCode::joint_limit);
      own.c.fault.code = FaultCode::peer_silent;
      EXPECT_EQ(row(r).f_cc(own).fault.code, FaultCode::peer_silent) << "what is known already";
    }
}

TEST(ManualRows, AnOrderThatHasEndedIsDoneWithTheFaultThatEndedIt) {
  const auto over = [](const X& x) { return row(Row::idle).f_entry(x); };
  X x = at(9, Kind::move);
  EXPECT_EQ(over(x).done, 4);
  EXPECT_FALSE(over(x).fault);
  x.c.fault.code = FaultCode::peer_silent;
  EXPECT_EQ(over(x).fault.code, FaultCode::peer_silent);
  x.c.fault = {};
  const X tripped = with(x, DriverState::faulted, Verdict::none, FaultCode::over_current);
  EXPECT_EQ(over(tripped).fault.code, FaultCode::over_current);
  X stop = tripped;
  stop.T.manual.kind = Kind::stop;
  EXPECT_FALSE(over(stop).fault) << "a stop is obeyed in any case";
  X called_off = tripped;
  called_off.T.manual.kind = Kind::stop;
  called_off.T.manual.number = 5;
  EXPECT_EQ(over(called_off).fault.code, FaultCode::over_current) << "the stop is another order";
  X old = tripped;
  old.c.done = 4;
  EXPECT_FALSE(over(old).fault) << "it ended before";
  EXPECT_FALSE(over(with(x, DriverState::holding, Verdict::executed, FaultCode::joint_limit)).fault);
  EXPECT_FALSE(over(with(x, DriverState::faulted, Verdict::none, FaultCode::reset_required)).fault);
}

TEST(ManualRows, AKinematicModelIsInForceWhenItsOrderHasEndedWell) {
  X x = at(9, Kind::kinematic_model);
  x.T.manual.model = 7;
  EXPECT_EQ(row(Row::idle).f_entry(x).kinematic_model, 7);
  X other = x;
  other.c.fault.code = FaultCode::unknown_model;
  EXPECT_EQ(row(Row::idle).f_entry(other).kinematic_model, std::nullopt);
  other = x;
  other.T.manual.number = 5;
  EXPECT_EQ(row(Row::idle).f_entry(other).kinematic_model, std::nullopt) << "it was called off";
  other = x;
  other.c.done = 4;
  EXPECT_EQ(row(Row::idle).f_entry(other).kinematic_model, std::nullopt) << "nothing new";
  x.T.manual.kind = Kind::tool;
  EXPECT_EQ(row(Row::idle).f_entry(x).kinematic_model, std::nullopt);
}

TEST(ManualRows, WhatIsSetIsToldOnceAndIsWhatWasOrdered) {
  X x = at(0, Kind::force_tool);
  x.T.manual.value = {7.5, 0.1, 0.2, 0.3, 0.4, 0.5};
  const auto set = [&](Kind kind) {
    x.T.manual.kind = kind;
    return row(Row::set).f_ce(x);
  };
  const EffectorCommand force = set(Kind::force_tool);
  EXPECT_TRUE(force.robot_model.set_force_tool);
  EXPECT_EQ(force.robot_model.weight, 7.5);
  EXPECT_EQ(force.robot_model.mass_centre, (std::array{0.1, 0.2, 0.3}));
  const EffectorCommand tool = set(Kind::tool);
  EXPECT_EQ(tool.instruction, Instruction::set);
  EXPECT_EQ(tool.set, static_cast<std::uint8_t>(Part::robot_model));
  EXPECT_TRUE(tool.robot_model.set_tool);
  EXPECT_FALSE(tool.robot_model.set_kinematic_model);
  EXPECT_EQ(tool.robot_model.tool_representation, Representation::xyz_angle_axis);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(tool.robot_model.tool[k], x.T.manual.value[k]);
  x.T.manual.model = 3;
  const EffectorCommand model = set(Kind::kinematic_model);
  EXPECT_TRUE(model.robot_model.set_kinematic_model);
  EXPECT_EQ(model.robot_model.kinematic_model, 3);
  x.T.manual.algorithm = 2;
  x.T.manual.parameter_set = 5;
  x.c.axes = 7;
  const EffectorCommand servo = set(Kind::servo_algorithm);
  EXPECT_EQ(servo.robot_model.set_servo_algorithm, 0b1111111);
  for (const auto a : servo.robot_model.servo_algorithm) EXPECT_EQ(a, 2);
  for (const auto p : servo.robot_model.servo_parameter_set) EXPECT_EQ(p, 5);
  EXPECT_EQ(set(Kind::reset).instruction, Instruction::reset);
  EXPECT_EQ(set(Kind::stop).instruction, Instruction::keep);
  x.i = x.i_0 + 1;
  for (const Kind kind :
       {Kind::force_tool, Kind::tool, Kind::kinematic_model, Kind::servo_algorithm, Kind::reset, Kind::bias})
    EXPECT_EQ(set(kind).instruction, Instruction::keep) << "once";
}

TEST(ManualRows, HomingIsAskedForOnceAndThenTheToolOfTheTaskIsSetOnce) {
  X x = at(0, Kind::home);
  x.c.model.weight = 7;
  EXPECT_EQ(row(Row::find_position).f_ce(x).instruction, Instruction::synchro);
  EXPECT_EQ(row(Row::settle).f_ce(x).instruction, Instruction::keep);
  const EffectorCommand tool = row(Row::set_tool).f_ce(x);
  EXPECT_EQ(tool.instruction, Instruction::set);
  EXPECT_EQ(tool.set, static_cast<std::uint8_t>(Part::robot_model));
  EXPECT_EQ(tool.robot_model.weight, 7);
  x.i = x.i_0 + 1;
  for (const Row r : {Row::find_position, Row::set_tool})
    EXPECT_EQ(row(r).f_ce(x).instruction, Instruction::keep);
  EXPECT_EQ(row(Row::idle).f_ce(x).instruction, Instruction::keep);
}

TEST(ManualRows, TheJawsAreCommandedAsLongAsTheyMove) {
  X x = at(7, Kind::gripper);
  x.T.manual.value[0] = 0.05;
  EXPECT_EQ(row(Row::grip).f_ce(x).arm.gripper, 0.05);
  EXPECT_EQ(row(Row::grip).f_ce(x).instruction, Instruction::set_get);
  EXPECT_EQ(row(Row::grip).f_ce(with(x, DriverState::faulted)).instruction, Instruction::keep);
}

TEST(ManualRows, ARefusalIsTheAgentsBusinessAndAFaultOfTheDriverIsToldUntilItsReset) {
  X x = with(at(3), DriverState::holding, Verdict::refused, FaultCode::joint_limit);
  x.c.done = 3;
  x.c.fault.code = FaultCode::unknown_model;
  for (const Motion<Arm>& r : kManual) {
    const Report told = r.f_cT(x);
    EXPECT_EQ(told.verdict, Verdict::none);
    EXPECT_EQ(told.event, 3);
    EXPECT_EQ(told.m, 0) << "the number is the port's";
    EXPECT_EQ(told.fault.code, FaultCode::unknown_model);
    EXPECT_EQ(told.driver_state, DriverState::holding);
    EXPECT_EQ(r.f_cT(with(x, DriverState::faulted, Verdict::none, FaultCode::over_current)).fault.code,
              FaultCode::over_current);
    EXPECT_FALSE(r.f_cT(with(x, DriverState::faulted, Verdict::none, FaultCode::reset_required)).fault);
  }
}

/// @return numbers of the rows in which the arm does one order of that kind, every answer at once
std::vector<int> rows_of(Kind kind, FaultCode refused = FaultCode::none) {
  X first = with(at(0, kind), DriverState::ready,
                 refused == FaultCode::none ? Verdict::executed : Verdict::refused, refused);
  first.c.doing = first.c.done = 0;
  first.T.manual.number = 1;
  first.T.manual.velocity = 1;
  first.T.manual.acceleration = 1;
  std::vector<X> images(120, first);
  images.back().T.finished = true;
  ScriptPort<Arm> port(images);
  X x = first;
  EXPECT_EQ(run_program(x, port), Outcome::terminated);
  EXPECT_EQ(x.c.done, 1);
  EXPECT_EQ(x.c.fault.code, refused);
  std::vector<int> rows;
  for (const auto& d : port.decisions())
    if (rows.empty() || rows.back() != d.m) rows.push_back(d.m);
  return rows;
}

TEST(ManualRows, AnOrderIsDoneByItsOwnRowsAndByNoOther) {
  using Rows = std::vector<int>;
  EXPECT_EQ(rows_of(Kind::home), (Rows{2, 3, 4, 1}));
  EXPECT_EQ(rows_of(Kind::bias, FaultCode::joint_limit), (Rows{6, 1}));
  EXPECT_EQ(rows_of(Kind::move), (Rows{5, 1}));
  EXPECT_EQ(rows_of(Kind::gripper), (Rows{7, 1}));
  for (const Kind kind :
       {Kind::tool, Kind::force_tool, Kind::kinematic_model, Kind::servo_algorithm, Kind::bias, Kind::reset})
    EXPECT_EQ(rows_of(kind), (Rows{6, 1}));
  EXPECT_EQ(rows_of(Kind::stop), Rows{1});
  EXPECT_EQ(rows_of(Kind::nothing), Rows{1});
}

}  // namespace
}  // namespace mrroc::manual
