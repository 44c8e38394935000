// The table of the manual agent by value: what it commands, and how its orders end.
#include "tasks/manual/arm.hpp"

#include <gtest/gtest.h>

#include "base/script_port.hpp"

namespace mrroc::manual {
namespace {

using X = Arm::X;
constexpr AxisVector::Scalar kNear = 1e-12;

X image(const ManualOrder& order) {
  X x;
  x.T.manual = order;
  x.T.manual.number = 1;
  x.e.state = DriverState::holding;
  x.e.joints = {0.1, -1.5, 0.1, 1.5, 1.5, -1.5};
  x.e.motors = {1, 2, 3, 4, 5, 6};
  x.e.T_0E = {0.9, 0, 1.2, 0, 3, 0};
  return x;
}

/// Plays the program: the driver executes everything, and moves while it is told to.
struct Play {
  explicit Play(const X& first, int macrosteps = 400, const Fault& refusal = {}) : x(first) {
    std::vector<X> images(static_cast<std::size_t>(macrosteps), first);
    for (X& i : images) {
      i.e.verdict = refusal ? Verdict::refused : Verdict::executed;
      i.e.fault = refusal;
    }
    images.back().T.finished = true;
    ScriptPort<Arm> port(images);
    outcome = run_program(x, port);
    for (const auto& d : port.decisions()) decisions.push_back(d);
  }
  [[nodiscard]] std::vector<EffectorCommand> commands(int m) const {
    std::vector<EffectorCommand> all;
    for (const auto& d : decisions)
      if (d.m == m) all.push_back(d.y.e);
    return all;
  }
  X x;
  Outcome outcome{};
  std::vector<ScriptPort<Arm>::Decision> decisions;
};

TEST(ManualArm, AMotionGoesToTheCoordinatesAndTheOrderIsDone) {
  ManualOrder o{.kind = Kind::move, .space = Representation::joints};
  o.value = {0.2, -1.5, 0.1, 1.5, 1.5, -1.5};
  const Play play(image(o));
  EXPECT_EQ(play.outcome, Outcome::terminated);
  EXPECT_EQ(play.x.c.done, 1);
  EXPECT_FALSE(play.x.c.fault);
  const auto moves = play.commands(5);
  ASSERT_GT(moves.size(), 5U);
  EXPECT_EQ(moves.front().arm.mu, Interpolation::mim);
  const auto path = play.x.c.path;
  EXPECT_NEAR(moves[static_cast<std::size_t>(path.macrosteps() - 1)].arm.pose[0], 0.2, kNear);
  EXPECT_EQ(moves.back().instruction, Instruction::keep) << "the arm comes to rest behind the path";
  EXPECT_EQ(play.decisions.back().y.T.event, 1);
  EXPECT_EQ(play.decisions.back().y.T.verdict, Verdict::none);
}

TEST(ManualArm, BeforeHomingEveryGoalIsRefusedAlsoWhereTheArmSeemsToBe) {
  ManualOrder o{.kind = Kind::move, .space = Representation::joints};
  X x = image(o);
  x.e.state = DriverState::not_synchronised;
  x.e.joints.fill(0);
  x.e.T_0E.fill(0);
  const Play zeros(x);
  EXPECT_EQ(zeros.x.c.fault.code, FaultCode::not_synchronised);
  for (const EffectorCommand& c : zeros.commands(5)) EXPECT_EQ(c.instruction, Instruction::keep);
  x.T.manual.space = Representation::motors;
  EXPECT_EQ(Play(x).x.c.fault.code, FaultCode::not_synchronised);
  x.T.manual.reference = Reference::relative;
  x.T.manual.value[5] = 1;
  EXPECT_FALSE(Play(x).x.c.fault) << "motors are jogged";
}

TEST(ManualArm, AJogIsAddedToWhereTheArmIsAndInMotorsGoesByIncrements) {
  ManualOrder o{.kind = Kind::move, .space = Representation::motors, .reference = Reference::relative};
  o.value = {10, 0, 0, 0, 0, 0};
  const Play play(image(o));
  double sum = 0;
  for (const auto& c : play.commands(5)) {
    if (c.instruction == Instruction::keep) continue;
    EXPECT_EQ(c.arm.reference, Reference::relative);
    sum += c.arm.pose[0];
  }
  EXPECT_NEAR(sum, 10, 1e-9);
  o.space = Representation::joints;
  o.value = {0.05, 0, 0, 0, 0, 0};
  const Play joints(image(o));
  const auto path = joints.x.c.path;
  EXPECT_NEAR(path.set_position(path.macrosteps())[0], 0.15, kNear);
}

TEST(ManualArm, AMotionBeginsWhereTheArmIsInItsOwnSpace) {
  X x = image({.kind = Kind::move});
  const auto begins_at = [&](Representation space, const std::vector<double>& there) {
    ManualOrder& o = x.T.manual;
    o.space = space;
    o.reference = Reference::absolute;
    o.value = {};
    std::ranges::copy(there, o.value.begin());
    o.value[1] += 0.02;
    const auto path = Play(x).x.c.path;
    ASSERT_GT(path.macrosteps(), 0);
    for (int k = 0; k < 6; ++k) {
      EXPECT_NEAR(path.set_position(0)[k], there[static_cast<std::size_t>(k)], 1e-9)
          << static_cast<int>(space);
      EXPECT_NEAR(path.set_position(path.macrosteps())[k], o.value[static_cast<std::size_t>(k)], 1e-9);
    }
  };
  begins_at(Representation::motors, {1, 2, 3, 4, 5, 6});
  begins_at(Representation::joints, {0.1, -1.5, 0.1, 1.5, 1.5, -1.5});
  begins_at(Representation::xyz_angle_axis, {0.9, 0, 1.2, 0, 3, 0});
}

TEST(ManualArm, AJogOfAPoseIsRelativeToTheTool) {
  // The tool points down, turned by 3 rad about y: along its z is away from its own z of the base.
  ManualOrder o{
      .kind = Kind::move, .space = Representation::xyz_angle_axis, .reference = Reference::relative};
  o.value = {0, 0, 0.01, 0, 0, 0};
  const Play play(image(o));
  const auto path = play.x.c.path;
  const auto end = path.set_position(path.macrosteps());
  EXPECT_NEAR(end[0], 0.9 + 0.01 * std::sin(3.0), 1e-9);
  EXPECT_NEAR(end[2], 1.2 + 0.01 * std::cos(3.0), 1e-9);
  for (int k = 3; k < 6; ++k) EXPECT_NEAR(end[k], k == 4 ? 3 : 0, 1e-9);
  EXPECT_EQ(play.commands(5).front().arm.mu, Interpolation::tcim_pose);
}

TEST(ManualArm, HomingSetsTheToolAndAsksForItOnce) {
  X first = image({.kind = Kind::home});
  first.e.state = DriverState::ready;
  first.c.model.set_tool = first.c.model.set_force_tool = true;
  first.c.model.weight = 7;
  const Play play(first);
  int synchros = 0;
  for (const auto& d : play.decisions) synchros += d.y.e.instruction == Instruction::synchro;
  EXPECT_EQ(synchros, 1);
  EXPECT_GE(play.commands(3).size(), 50U) << "the force is biased at rest";
  EXPECT_EQ(play.commands(4).front().robot_model.weight, 7);
  EXPECT_EQ(play.x.c.done, 1);
}

TEST(ManualArm, HomingIsNotOverBeforeTheDriverHasBegunIt) {
  const X first = image({.kind = Kind::home});
  std::vector<X> images(200, first);
  for (std::size_t k = 0; k < images.size(); ++k) {
    images[k].e.verdict = Verdict::executed;
    // Ready from before until it has got the order, and again when it knows its positions.
    images[k].e.state = k >= 3 && k < 30 ? DriverState::homing : DriverState::ready;
  }
  images.back().T.finished = true;
  ScriptPort<Arm> port(images);
  X x = first;
  EXPECT_EQ(run_program(x, port), Outcome::terminated);
  EXPECT_EQ(x.c.done, 1);
  EXPECT_FALSE(x.c.fault);
  int finding = 0;
  for (const auto& d : port.decisions()) finding += d.m == 2;
  EXPECT_EQ(finding, 31);
}

TEST(ManualArm, EveryKindOfOrderExecutesItsOwnRowsAndNoOthers) {
  const auto rows = [](Kind kind) {
    X first = image({.kind = kind});
    first.T.manual.space = Representation::joints;
    first.T.manual.value = {0.2, -1.5, 0.1, 1.5, 1.5, -1.5};
    first.e.state = DriverState::ready;
    first.e.gripper = 0.2;
    std::vector<int> all;
    for (const auto& d : Play(first).decisions)
      if (d.m != 1 && (all.empty() || all.back() != d.m)) all.push_back(d.m);
    return all;
  };
  EXPECT_EQ(rows(Kind::nothing), std::vector<int>{});
  EXPECT_EQ(rows(Kind::stop), std::vector<int>{});
  EXPECT_EQ(rows(Kind::home), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(rows(Kind::move), std::vector<int>{5});
  EXPECT_EQ(rows(Kind::gripper), std::vector<int>{7});
  for (const Kind kind : {Kind::tool, Kind::kinematic_model, Kind::servo_algorithm, Kind::bias, Kind::reset})
    EXPECT_EQ(rows(kind), std::vector<int>{6}) << static_cast<int>(kind);
}

TEST(ManualArm, SetsWhatItIsTold) {
  ManualOrder servo{.kind = Kind::servo_algorithm};
  servo.algorithm = 1;
  servo.parameter_set = 1;
  const auto set = Play(image(servo)).commands(6).front();
  EXPECT_EQ(set.robot_model.set_servo_algorithm, 0b111111);
  EXPECT_EQ(set.robot_model.servo_algorithm[5], 1);
  EXPECT_EQ(Play(image({.kind = Kind::reset})).commands(6).front().instruction, Instruction::reset);
  EXPECT_EQ(Play(image({.kind = Kind::bias})).commands(6).front().set,
            static_cast<std::uint8_t>(Part::force_bias));
  ManualOrder jaws{.kind = Kind::gripper};
  jaws.value[0] = 0.07;
  EXPECT_EQ(Play(image(jaws)).commands(7).front().arm.gripper, 0.07);
}

TEST(ManualArm, ARefusedOrderEndsWithItsReasonAndTheNextOneIsTaken) {
  ManualOrder o{.kind = Kind::kinematic_model};
  o.model = 9;
  const Play play(image(o), 50, Fault{.code = FaultCode::unknown_model});
  EXPECT_EQ(play.x.c.done, 1);
  EXPECT_EQ(play.x.c.fault.code, FaultCode::unknown_model);
  EXPECT_EQ(play.decisions.back().y.T.fault.code, FaultCode::unknown_model);
}

TEST(ManualArm, AMotionThatIsNotExecutedToItsEndFailsOnceTheArmRestsAndTheSessionGoesOn) {
  ManualOrder o{.kind = Kind::move, .space = Representation::joints};
  o.value = {1, -1.5, 0.1, 1.5, 1.5, -1.5};
  std::vector<X> images(60, image(o));
  for (std::size_t k = 0; k < images.size(); ++k) {
    EffectorReply& e = images[k].e;
    e.verdict = k < 20 ? Verdict::executed : k == 20 ? Verdict::failed : Verdict::none;
    e.state = k < 20 ? DriverState::executing : k < 25 ? DriverState::decelerating : DriverState::holding;
    if (k >= 20 && k < 25) e.fault.code = FaultCode::excessive_torque;
  }
  images.back().T.finished = true;
  ScriptPort<Arm> port(images);
  X x = image(o);
  EXPECT_EQ(run_program(x, port), Outcome::terminated);
  EXPECT_EQ(x.c.done, 1);
  EXPECT_EQ(x.c.fault.code, FaultCode::excessive_torque);
  int moves = 0, moving = 0;
  for (const auto& d : port.decisions()) {
    moves += d.y.e.instruction == Instruction::set_get;
    moving += d.m == 5;
    EXPECT_NE(d.y.T.verdict, Verdict::failed) << "no fault of the system";
  }
  EXPECT_EQ(moves, 21);
  EXPECT_EQ(moving, 26) << "the order ends when the arm holds";
}

TEST(ManualArm, AGoalOutOfReachFailsBeforeAnythingMoves) {
  struct UpToOne final : Reach {
    [[nodiscard]] std::optional<Fault> validation_error(Representation space, const ecp::Coordinates& goal,
                                                        const EffectorReply& now,
                                                        std::optional<int> model) const override {
      EXPECT_EQ(space, Representation::joints);
      EXPECT_EQ(now.joints[0], 0.1);
      EXPECT_EQ(model, std::nullopt);
      if (goal[0] <= 1) return {};
      return Fault{.code = FaultCode::joint_limit, .axis = 0, .value = goal[0], .limit = 1};
    }
  } const reach;
  ManualOrder o{.kind = Kind::move, .space = Representation::joints, .reference = Reference::relative};
  for (const double jog : {0.5, 0.95}) {
    o.value = {jog, 0, 0, 0, 0, 0};
    X first = image(o);
    first.c.reach = &reach;
    const Play play(first, 400);
    EXPECT_EQ(play.x.c.done, 1);
    EXPECT_EQ(play.commands(5).empty(), jog > 0.9) << "0.1 + " << jog;
    EXPECT_EQ(play.x.c.fault.code, jog > 0.9 ? FaultCode::joint_limit : FaultCode::none);
    EXPECT_EQ(play.decisions.back().y.T.fault.limit, jog > 0.9 ? 1 : 0);
  }
}

TEST(ManualArm, AMotionThatCannotBePlannedFails) {
  ManualOrder o{.kind = Kind::move, .space = Representation::joints};
  o.velocity = 7;
  const Play play(image(o), 50);
  EXPECT_EQ(play.x.c.fault.code, FaultCode::bad_trajectory);
  EXPECT_EQ(play.x.c.done, 1);
}

TEST(ManualArm, StopEndsAMotion) {
  ManualOrder o{.kind = Kind::move, .space = Representation::joints};
  o.value = {1, -1.5, 0.1, 1.5, 1.5, -1.5};
  std::vector<X> images(60, image(o));
  for (X& x : images) x.e.verdict = Verdict::executed;
  for (std::size_t k = 20; k < images.size(); ++k) {
    images[k].T.manual = ManualOrder{.kind = Kind::stop};
    images[k].T.manual.number = 2;
  }
  images.back().T.finished = true;
  ScriptPort<Arm> port(images);
  X x = image(o);
  EXPECT_EQ(run_program(x, port), Outcome::terminated);
  EXPECT_EQ(x.c.done, 2);
  int moves = 0;
  for (const auto& d : port.decisions()) moves += d.y.e.instruction == Instruction::set_get;
  EXPECT_EQ(moves, 21) << "the macrosteps before the stop";
}

/// Plays a motion during which the driver trips: first it refuses what is commanded, then it says why.
TEST(ManualArm, ADriverThatTripsEndsTheOrderWithItsFaultWhichIsToldUntilTheReset) {
  ManualOrder o{.kind = Kind::move, .space = Representation::joints};
  o.value = {1, -1.5, 0.1, 1.5, 1.5, -1.5};
  std::vector<X> images(60, image(o));
  for (std::size_t k = 0; k < images.size(); ++k) {
    images[k].e.verdict = k < 20 ? Verdict::executed : k < 22 ? Verdict::refused : Verdict::none;
    if (k < 20) continue;
    images[k].e.state = DriverState::faulted;
    images[k].e.fault.code = k < 22 ? FaultCode::reset_required : FaultCode::over_current;
  }
  images.back().T.finished = true;
  ScriptPort<Arm> port(images);
  X x = image(o);
  EXPECT_EQ(run_program(x, port), Outcome::terminated);
  EXPECT_EQ(x.c.done, 1);
  EXPECT_EQ(x.c.fault.code, FaultCode::over_current);
  EXPECT_EQ(port.decisions().back().y.T.fault.code, FaultCode::over_current);
  int moves = 0;
  for (const auto& d : port.decisions()) moves += d.y.e.instruction == Instruction::set_get;
  EXPECT_LE(moves, 21) << "nothing is commanded behind the fault";
}

TEST(ManualArm, AStopOfAnArmThatHasTrippedIsObeyed) {
  X first = image({.kind = Kind::stop});
  first.e.state = DriverState::faulted;
  first.e.fault.code = FaultCode::over_current;
  std::vector<X> images(20, first);
  images.back().T.finished = true;
  ScriptPort<Arm> port(images);
  EXPECT_EQ(run_program(first, port), Outcome::terminated);
  EXPECT_EQ(first.c.done, 1);
  EXPECT_FALSE(first.c.fault);
}

}  // namespace
}  // namespace mrroc::manual
