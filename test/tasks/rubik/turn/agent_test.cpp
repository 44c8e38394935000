// An arm of the cube's task by value: it obeys orders, takes a path point by point, goes along it, weighs at rest.
#include "tasks/rubik/turn/agent.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace mrroc::rubik {
namespace {

using X = Arm::X;

ArmMemory memory_of_six_axes() {
  ArmMemory c;
  c.limits = {AxisVector::Constant(6, 50), AxisVector::Constant(6, 100)};
  return c;
}

const Motion<Arm>& between(int m) { return *std::ranges::find(kBetween, m, &Motion<Arm>::m); }

X ordered(int m, int variant = 0) {
  X x;
  x.c = memory_of_six_axes();
  x.T.m = m;
  x.T.variant = variant;
  return x;
}

TEST(RubikAgent, ActsAsWorkerUntilTheGripAndAsHolderFromTheTurnOn) {
  for (int m = 1; m <= 6; ++m) {
    const auto k = static_cast<std::size_t>(m - 1);
    EXPECT_EQ(&select(ordered(m, kActs)), m <= 4 ? &kWorker[k] : &kHolder[k]) << m;
    EXPECT_EQ(&select(ordered(m, kStands)), m <= 4 ? &kHolder[k] : &kWorker[k]) << m;
  }
  for (const int m : {kWait, kTakePath, kGo, kWeigh}) EXPECT_EQ(&select(ordered(m)), &between(m));
  for (const int m : {0, 11, -5}) EXPECT_EQ(&select(ordered(m)), &between(kWait)) << m;
}

TEST(RubikAgent, WaitsInsteadOfABehaviourThatHasEnded) {
  X x = ordered(1, kActs);
  x.T.go_on = {true, false};
  EXPECT_EQ(&select(x), &between(kWait));
  EXPECT_FALSE(between(kWait).f_tau(x));
  x.c.joint_path.jaws = 0.07;
  const EffectorCommand y = between(kWait).f_ce(x);
  EXPECT_EQ(y.instruction, EffectorCommand{}.instruction) << "it commands nothing";
  EXPECT_EQ(y.set, 0);
  EXPECT_EQ(between(kWait).f_cT(x).m, kWait);
  EXPECT_EQ(between(kWait).f_cT(x).event, 0);
}

TEST(RubikAgent, EveryBehaviourOfACycleEndsWhenItIsBrokenOff) {
  for (const auto* rows : {&kWorker, &kHolder})
    for (const auto& row : *rows) EXPECT_TRUE(row.f_tau(ordered(kWait))) << row.m;
}

TEST(RubikAgent, TakesThePointsOfAPathInTheirOrderEachOnce) {
  const auto& take = between(kTakePath);
  X x = ordered(kTakePath);
  x.c.joint_path.count = 7;
  x.c = take.f_entry(x);
  EXPECT_EQ(x.c.joint_path.count, 0) << "a new path";
  for (const int number : {0, 0, 2, 1, 1, 0, 2, 5}) {
    x.T.variant = number;
    x.T.cube.point.motors[0] = 0.1 * number;
    x.T.cube.point.speed = 1;
    x.T.cube.jaws = 0.07;
    x.c = take.f_cc(x);
  }
  ASSERT_EQ(x.c.joint_path.count, 3);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_DOUBLE_EQ(x.c.joint_path.points[k].motors[0], 0.1 * static_cast<double>(k));
  EXPECT_EQ(x.c.joint_path.jaws, 0.07);
  EXPECT_EQ(take.f_cT(x).cube.points, 3);
  EXPECT_EQ(take.f_ce(x).arm.frame, kStill);
  EXPECT_EQ(take.f_ce(x).arm.gripper, 0.07) << "the jaws begin already";
  x.T.variant = 3;
  x.T.cube.point.motors[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(take.f_cc(x).joint_path.count, 3) << "never to a place that is none";
  x.T.cube.point.motors[2] = 0;
  for (const double speed : {0.0, -1.0, 1.1}) {
    x.T.cube.point.speed = speed;
    EXPECT_EQ(take.f_cc(x).joint_path.count, 3) << "never at a speed that is none";
  }
}

TEST(RubikAgent, GoesFromWhereItIsThroughAllPointsAndTellsWhenItIsThere) {
  const auto& go = between(kGo);
  X x = ordered(kGo, kActs);
  x.e.motors[0] = 50;
  x.e.gripper = 0.07;
  AxisVector motors = AxisVector::Zero(6);
  motors[0] = 70;
  x.c.joint_path.add(motors, 0.8);
  motors[1] = -20;
  x.c.joint_path.add(motors, 0.5);
  x.c.joint_path.jaws = 0.07;
  x.c = go.f_entry(x);
  ASSERT_GT(x.c.path.macrosteps(), 10);
  EffectorCommand last;
  PoseNumbers before{50}, most{};
  for (x.i = 0; x.i < x.c.path.macrosteps(); ++x.i) {
    EXPECT_EQ(go.f_cT(x).event, 0);
    last = go.f_ce(x);
    EXPECT_EQ(last.arm.mu, Interpolation::mim);
    EXPECT_EQ(last.arm.representation, Representation::motors);
    EXPECT_EQ(last.arm.gripper, 0.07);
    for (std::size_t k = 0; k < 6; ++k) most[k] = std::max(most[k], std::abs(last.arm.pose[k] - before[k]));
    before = last.arm.pose;
  }
  EXPECT_NEAR(last.arm.pose[0], 70, 1e-9);
  EXPECT_NEAR(last.arm.pose[1], -20, 1e-9);
  EXPECT_NEAR(most[0], 0.8 * 50 * kPacing.macrostep_s(), 0.05) << "the speed of the first line";
  EXPECT_NEAR(most[1], 0.5 * 50 * kPacing.macrostep_s(), 0.05);
  EXPECT_EQ(go.f_cT(x).event, kGo) << "all of the path has been commanded";
  x.e.gripper = 0.075;
  EXPECT_EQ(go.f_cT(x).event, 0) << "the jaws are not there yet";
  x.T.variant = kStands;
  EXPECT_EQ(go.f_cT(x).event, kGo) << "nobody waits for them";
  x.T.m = kWait;
  EXPECT_TRUE(go.f_tau(x));
}

TEST(RubikAgent, JawsThatAreBlockedAreWhereTheyCanBe) {
  const auto& go = between(kGo);
  X x = ordered(kGo, kActs);
  x.c.joint_path.jaws = 0.054;
  x.e.gripper = 0.057;
  x.c = go.f_entry(x);
  EXPECT_EQ(go.f_cT(x).event, 0) << "3 mm to go";
  x.e.blocked = true;
  EXPECT_EQ(go.f_cT(x).event, kGo) << "the cube is between them";
  x.e.blocked = false;
  for (const double off : {-0.0016, 0.0016}) {
    x.e.gripper = x.c.joint_path.jaws + off;
    EXPECT_EQ(go.f_cT(x).event, 0) << off;
  }
  for (const double off : {-0.0014, 0.0014}) {
    x.e.gripper = x.c.joint_path.jaws + off;
    EXPECT_EQ(go.f_cT(x).event, kGo) << off;
  }
  x.c.joint_path.jaws = 0;
  EXPECT_EQ(go.f_cT(x).event, kGo) << "nothing was ordered of the jaws";
}

TEST(RubikAgent, JawsAreOrderedNoFartherThanTheyGo) {
  const auto& take = between(kTakePath);
  X x = ordered(kTakePath);
  for (const auto& [ordered_jaws, sent] :
       {std::pair(0.01, kClosest), std::pair(0.06, 0.06), std::pair(0.2, kWidest), std::pair(0.0, 0.0)}) {
    x.c.joint_path.jaws = ordered_jaws;
    EXPECT_EQ(take.f_ce(x).arm.gripper, sent) << ordered_jaws;
  }
}

TEST(RubikAgent, APointIsTakenOnlyAsThePointThatIsAskedFor) {
  const auto& take = between(kTakePath);
  X x = ordered(kTakePath);
  x.T.cube.point.speed = 1;
  x.T.m = kGo;
  EXPECT_EQ(take.f_cc(x).joint_path.count, 0) << "an order of something else";
  x.T.m = kTakePath;
  x.T.variant = -1;
  EXPECT_EQ(take.f_cc(x).joint_path.count, 0);
  x.T.variant = 0;
  EXPECT_EQ(take.f_cc(x).joint_path.count, 1);
}

TEST(RubikAgent, APathWithoutPointsMovesTheJawsAlone) {
  const auto& go = between(kGo);
  X x = ordered(kGo);
  x.c.joint_path = {};
  x.c.joint_path.jaws = 0.08;
  x.c = go.f_entry(x);
  EXPECT_EQ(x.c.path.macrosteps(), 0);
  EXPECT_EQ(go.f_ce(x).arm.frame, kStill);
  EXPECT_EQ(go.f_ce(x).arm.gripper, 0.08);
}

TEST(RubikAgent, WeighsOnceAndOnlyAtRest) {
  const auto& weigh = between(kWeigh);
  X x = ordered(kWeigh);
  x.T.cube.weight = 10;
  x.T.cube.mass_centre = {0.1, 0.2, 0.3};
  x.c = weigh.f_entry(x);
  int sent = 0;
  for (x.i = 1; x.i < 100; ++x.i) {
    x.e.state = x.i < 60 ? DriverState::decelerating : DriverState::holding;
    const EffectorCommand y = weigh.f_ce(x);
    if (y.instruction == Instruction::set) {
      ++sent;
      EXPECT_GE(x.i, 60);
      EXPECT_EQ(y.robot_model.weight, 10);
      EXPECT_EQ(y.robot_model.mass_centre[2], 0.3);
    }
    EXPECT_EQ(weigh.f_cT(x).event, x.i >= 62 ? kWeigh : 0) << x.i;
    x.c = weigh.f_cc(x);
  }
  EXPECT_EQ(sent, 1);
}

// Hands swing for six macrosteps after they have come to rest.
TEST(RubikAgent, AHandThatHasJustComeToRestIsNotWeighedYet) {
  const auto& weigh = between(kWeigh);
  for (const DriverState still : {DriverState::holding, DriverState::ready}) {
    X x = ordered(kWeigh);
    x.e.state = still;
    x.i_0 = 30;
    x.c = weigh.f_entry(x);
    std::int64_t sent_in = 0;
    for (x.i = 31; x.i < 60; ++x.i) {
      if (weigh.f_ce(x).instruction == Instruction::set && sent_in == 0) sent_in = x.i;
      EXPECT_EQ(weigh.f_cT(x).event, sent_in > 0 && x.i >= sent_in + 2 ? kWeigh : 0) << x.i;
      x.c = weigh.f_cc(x);
    }
    EXPECT_EQ(sent_in, 30 + 12);
  }
}

TEST(RubikAgent, EverythingEndsWithTheTask) {
  for (const Motion<Arm>& row : kBetween) {
    X x = ordered(row.m);
    EXPECT_FALSE(row.f_tau(x)) << row.name;
    x.T.finished = true;
    EXPECT_TRUE(row.f_tau(x)) << row.name;
  }
}

TEST(RubikAgent, OfWhatItDoesBetweenCyclesItTellsArrivalAndWeighingAlone) {
  for (const int m : {kWait, kTakePath}) {
    X x = ordered(m);
    x.i = 1000;
    x.c.weighed = 1;
    EXPECT_EQ(between(m).f_cT(x).event, 0);
    EXPECT_EQ(between(m).f_cT(x).m, m);
  }
}

TEST(RubikAgent, IsWeighedWithTheWholeMassCentreOfTheOrder) {
  X x = ordered(kWeigh);
  x.e.state = DriverState::holding;
  x.i = 50;
  x.T.cube.mass_centre = {0.1, 0.2, 0.3};
  EXPECT_EQ(between(kWeigh).f_ce(x).robot_model.mass_centre, (std::array{0.1, 0.2, 0.3}));
  x.e.state = DriverState::executing;
  EXPECT_NE(between(kWeigh).f_ce(x).instruction, Instruction::set);
}

}  // namespace
}  // namespace mrroc::rubik
