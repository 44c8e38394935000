// The coordinator's program over two arms that obey: the order of behaviours, and what becomes of every trouble.
#include "tasks/rubik/program.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rubik/two_arms.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

WayPoint at(double q, int axes) {
  return {AxisVector::Constant(axes, q), AxisVector::Constant(axes, 100 * q), 0.5};
}

Step quarter_turn(double angle = kQuarter) {
  Step step;
  step.before = {{.hand = Hand::postument, .points = {at(0, 6), at(0.1, 6), at(0.2, 6)}}};
  step.comes = Hand::postument;
  step.turn = Move(Face::U, angle > 0 ? 1 : 3);
  step.angle = angle;
  step.leaves = Hand::track;
  step.retreat = {.hand = Hand::track, .points = {at(0, 7), at(-0.1, 7)}};
  step.withdrawal = {.hand = Hand::postument, .points = {at(0.25, 6), at(0.2, 6), at(0.1, 6)}};
  step.before_grasp.hand = Hand::track;
  step.after_grasp.hand = Hand::postument;
  return step;
}

Step regrasp() {
  Step step = quarter_turn(0);
  step.turn = {};
  return step;
}

class RubikProgram : public testing::Test {
 protected:
  Outcome execute(const Step& step) {
    Program<TwoArms> program(x, arms, journal);
    EXPECT_EQ(program.wait_for_start(), Outcome::terminated);
    arms.behaviours.clear();
    return program.execute(step);
  }
  [[nodiscard]] int count(int m) const { return static_cast<int>(std::ranges::count(arms.behaviours, m)); }

  TwoArms arms;
  Coordinator::X x;
  Journal journal;
};

TEST_F(RubikProgram, LeadsBothArmsThroughOneCycle) {
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{kTakeWay, kGo, kWeigh, 1, 2, 3, 4, 5, 6, kTakeWay, kGo}));
  ASSERT_EQ(arms.turns.size(), 1u);
  EXPECT_EQ(arms.turns[0].torque, x.c.k.torque);
  EXPECT_NEAR(arms.turns[0].angle, kQuarter, 1e-12);
  ASSERT_EQ(arms.points[0].size(), 2u) << "without the one where the arm is";
  EXPECT_EQ(arms.points[0][1][3], 20) << "in motors";
  EXPECT_EQ(arms.points[0][1][kSpeedOfLine], 0.5);
  ASSERT_EQ(arms.points[1].size(), 1u);
  EXPECT_EQ(journal.at(0).attempts, 1);
  EXPECT_NEAR(journal.at(0).tool, kQuarter, 0.02);
}

TEST_F(RubikProgram, BothArmsAreToldAtOnceAndGoOneAfterTheOtherOrAtTheSameTime) {
  Step step = quarter_turn();
  step.before.insert(step.before.begin(),
                     {.hand = Hand::track, .points = {at(0, 7), at(0.3, 7)}, .carries = true});
  ASSERT_EQ(execute(step), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{kTakeWay, kGo, kWeigh, 1, 2, 3, 4, 5, 6, kTakeWay, kGo}));
  EXPECT_EQ(arms.points[0].size(), 2u);
  EXPECT_EQ(arms.points[1].size(), 2u) << "its way with the cube and its retreat";
  EXPECT_GT(arms.begun[0] - arms.begun[1], TwoArms::kGoing) << "one after the other";

  step.before[1].delay = 0.1;
  TwoArms others;
  arms = others;
  ASSERT_EQ(execute(step), Outcome::terminated);
  EXPECT_EQ(arms.begun[0] - arms.begun[1], 5) << "0.1 s later";
}

TEST_F(RubikProgram, ATurnTheOtherWayHasTheOtherTorque) {
  ASSERT_EQ(execute(quarter_turn(-kQuarter)), Outcome::terminated);
  EXPECT_EQ(arms.turns.at(0).torque, -x.c.k.torque);
  EXPECT_NEAR(journal.at(0).tool, -kQuarter, 0.02);
}

TEST_F(RubikProgram, ARegraspTurnsNothing) {
  ASSERT_EQ(execute(regrasp()), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{kTakeWay, kGo, kWeigh, 1, 2, 3, 4, 5, 6, kTakeWay, kGo}));
  EXPECT_EQ(arms.turns.at(0).torque, 0);
  EXPECT_FALSE(journal.at(0).turn);
}

TEST_F(RubikProgram, AFaceThatJamsIsTurnedBackSlowlyAndTriedAgain) {
  arms.jams = [](int turn) { return turn == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  ASSERT_EQ(arms.turns.size(), 3u) << "forth, back, forth";
  EXPECT_LT(arms.turns[1].torque, 0);
  EXPECT_NEAR(arms.turns[1].angle, 0.4, 0.02);
  EXPECT_LT(arms.turns[1].mobility, arms.turns[0].mobility);
  EXPECT_EQ(arms.turns[2].torque, x.c.k.torque);
  EXPECT_EQ(journal.at(0).attempts, 2);
  EXPECT_NEAR(journal.at(0).tool, kQuarter, 0.03);
}

TEST_F(RubikProgram, AFaceThatNeverTurnsEndsWithBothArmsAtRest) {
  arms.jams = [](int) { return true; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.trouble, Trouble::jammed);
  EXPECT_EQ(journal.at(0).attempts, x.c.k.attempts);
  EXPECT_EQ(arms.behaviours.back(), kStopBoth.m);
  EXPECT_EQ(count(6), 0) << "the cube is not let go";
}

TEST_F(RubikProgram, AFaceThatJamsIsBackInItsSeatWhenAttemptsAreOver) {
  arms.jams = [](int turn) { return turn % 2 == 1; };  // forth, never back
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(arms.turns.size(), 2u * static_cast<std::size_t>(x.c.k.attempts));
  EXPECT_NEAR(journal.at(0).tool, 0, 0.03);
}

TEST_F(RubikProgram, AStepWhoseFaceJamsIsTakenBack) {
  arms.jams = [](int turn) { return turn % 2 == 1; };
  const Step step = quarter_turn();
  Program<TwoArms> program(x, arms, journal);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  ASSERT_EQ(program.execute(step), Outcome::faulted);
  ASSERT_TRUE(program.may_withdraw(step));
  arms.behaviours.clear();
  for (auto& points : arms.points) points.clear();
  ASSERT_EQ(program.withdraw(step), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{6, kTakeWay, kGo}));
  EXPECT_EQ(x.c.cycle.leaves, step.comes) << "the hand that held the cube keeps it";
  ASSERT_EQ(arms.points[0].size(), 2u);
  EXPECT_EQ(arms.points[0][1][0], 10) << "drawn back";
  EXPECT_TRUE(arms.points[1].empty());
  EXPECT_TRUE(journal.at(0).given_up);
}

TEST_F(RubikProgram, AStepIsNotTakenBackWithAFaceBetweenItsSeats) {
  arms.jams = [](int turn) { return turn == 1; };
  Step step = quarter_turn();
  x.c.k.attempts = 1;
  arms.stays = true;
  Program<TwoArms> program(x, arms, journal);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  ASSERT_EQ(program.execute(step), Outcome::faulted);
  EXPECT_EQ(program.trouble(), Trouble::jammed);
  EXPECT_FALSE(program.may_withdraw(step));
  EXPECT_EQ(arms.behaviours.back(), kStopBoth.m);
}

TEST_F(RubikProgram, AStepIsTakenBackForAJamAlone) {
  arms.finds_nothing = [](int) { return true; };
  const Step step = quarter_turn();
  Program<TwoArms> program(x, arms, journal);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  ASSERT_EQ(program.execute(step), Outcome::faulted);
  EXPECT_FALSE(program.may_withdraw(step));
}

TEST_F(RubikProgram, AGripThatMissesIsTriedAgainFromWhereTheApproachBegan) {
  arms.misses = [](int grip) { return grip == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated) << to_string(x.c.trouble);
  EXPECT_EQ(journal.at(0).grips, 2);
  EXPECT_EQ(count(1), 2);
  EXPECT_EQ(arms.points[0].back()[0], 20);
}

TEST_F(RubikProgram, AWorkerThatFindsNothingGivesUpAfterItsAttempts) {
  arms.finds_nothing = [](int) { return true; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.trouble, Trouble::no_contact);
  EXPECT_EQ(journal.at(0).grips, x.c.k.attempts);
  EXPECT_EQ(count(5), 0);
}

TEST_F(RubikProgram, AWorkerThatFindsNothingMakesTheHolderFeelWhetherItHasTheCube) {
  arms.finds_nothing = [](int grip) { return grip == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  EXPECT_EQ(journal.at(0).grips, 2);
}

TEST_F(RubikProgram, ACubeThatHasSlippedOutOfJawsThatStandIsFeltToBeGone) {
  arms.finds_nothing = [](int) { return true; };
  arms.gone = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.trouble, Trouble::dropped);
  EXPECT_EQ(journal.at(0).grips, 1) << "no second attempt at nothing";
  EXPECT_EQ(arms.behaviours.back(), kStopBoth.m);
}

TEST_F(RubikProgram, AWorkerThatPassesByACubeStopsSoonAndTheCubeHasSlipped) {
  arms.finds_nothing = [](int) { return true; };
  arms.passes_by = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.trouble, Trouble::elsewhere);
  EXPECT_EQ(journal.at(0).grips, 1);
  EXPECT_LT(x.c.travelled, 0.016);
  EXPECT_GT(x.c.travelled, 0.015);
}

TEST_F(RubikProgram, ACubeThatIsNotWhereItShouldBeIsNotGripped) {
  arms.meets_at = 0.02;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.trouble, Trouble::elsewhere);
  EXPECT_EQ(count(3), 0);
}

TEST_F(RubikProgram, ACubeThatIsGoneEndsTheCycleAtOnce) {
  arms.drops = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.trouble, Trouble::dropped);
  EXPECT_EQ(count(6), 0);
}

TEST_F(RubikProgram, ACubeThatIsGoneWhenTheOtherHandHasLetGoIsFeltToo) {
  arms.drops_late = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.trouble, Trouble::dropped);
  EXPECT_EQ(count(5), 1);
}

TEST_F(RubikProgram, AWayOfManyPointsGoesInParts) {
  Step step = quarter_turn();
  step.before[0].points.assign(40, at(0.1, 6));
  ASSERT_EQ(execute(step), Outcome::terminated);
  EXPECT_EQ(arms.points[0].size(), 39u);
  EXPECT_EQ(count(kTakeWay), 4);
}

}  // namespace
}  // namespace mrroc::rubik
