// The coordinator's program over two arms that obey: the order of behaviours, and what becomes of every failure.
#include "tasks/rubik/program.hpp"

#include <gtest/gtest.h>

#include "test/tasks/rubik/two_arms.hpp"

namespace mrroc::rubik {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;

Waypoint at(double q, int axes) {
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
    Program<TwoArms> program(x, arms, execution_log);
    EXPECT_EQ(program.wait_for_start(), Outcome::terminated);
    arms.behaviours.clear();
    return program.execute(step);
  }
  [[nodiscard]] int count(int m) const { return static_cast<int>(std::ranges::count(arms.behaviours, m)); }

  TwoArms arms;
  Coordinator::X x;
  ExecutionLog execution_log;
};

TEST_F(RubikProgram, LeadsBothArmsThroughOneCycle) {
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{kTakePath, kGo, kWeigh, 1, 2, 3, 4, 5, 6, kTakePath, kGo}));
  ASSERT_EQ(arms.turns.size(), 1u);
  EXPECT_EQ(arms.turns[0].torque, x.c.k.torque);
  EXPECT_NEAR(arms.turns[0].angle, kQuarter, 1e-12);
  ASSERT_EQ(arms.points[0].size(), 2u) << "without the one where the arm is";
  EXPECT_EQ(arms.points[0][1].motors[3], 20) << "in motors";
  EXPECT_EQ(arms.points[0][1].speed, 0.5);
  ASSERT_EQ(arms.points[1].size(), 1u);
  EXPECT_EQ(execution_log.at(0).attempts, 1);
  EXPECT_NEAR(execution_log.at(0).tool, kQuarter, 0.02);
}

TEST_F(RubikProgram, BothArmsAreToldAtOnceAndGoOneAfterTheOtherOrAtTheSameTime) {
  Step step = quarter_turn();
  step.before.insert(step.before.begin(),
                     {.hand = Hand::track, .points = {at(0, 7), at(0.3, 7)}, .carries = true});
  ASSERT_EQ(execute(step), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{kTakePath, kGo, kWeigh, 1, 2, 3, 4, 5, 6, kTakePath, kGo}));
  EXPECT_EQ(arms.points[0].size(), 2u);
  EXPECT_EQ(arms.points[1].size(), 2u) << "its path with the cube and its retreat";
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
  EXPECT_NEAR(execution_log.at(0).tool, -kQuarter, 0.02);
}

TEST_F(RubikProgram, ARegraspTurnsNothing) {
  ASSERT_EQ(execute(regrasp()), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{kTakePath, kGo, kWeigh, 1, 2, 3, 4, 5, 6, kTakePath, kGo}));
  EXPECT_EQ(arms.turns.at(0).torque, 0);
  EXPECT_FALSE(execution_log.at(0).turn);
}

TEST_F(RubikProgram, AFaceThatJamsIsTurnedBackSlowlyAndTriedAgain) {
  arms.jams = [](int turn) { return turn == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  ASSERT_EQ(arms.turns.size(), 3u) << "forth, back, forth";
  EXPECT_LT(arms.turns[1].torque, 0);
  EXPECT_NEAR(arms.turns[1].angle, 0.4, 0.02);
  EXPECT_LT(arms.turns[1].mobility, arms.turns[0].mobility);
  EXPECT_EQ(arms.turns[2].torque, x.c.k.torque);
  EXPECT_EQ(execution_log.at(0).attempts, 2);
  EXPECT_NEAR(execution_log.at(0).tool, kQuarter, 0.03);
}

TEST_F(RubikProgram, AFaceThatNeverTurnsEndsWithBothArmsAtRest) {
  arms.jams = [](int) { return true; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.failure, FailureReason::jammed);
  EXPECT_EQ(execution_log.at(0).attempts, x.c.k.attempts);
  EXPECT_EQ(arms.behaviours.back(), kStopBoth.m);
  EXPECT_EQ(count(6), 0) << "the cube is not let go";
}

TEST_F(RubikProgram, AFaceThatJamsIsBackInItsSeatWhenAttemptsAreOver) {
  arms.jams = [](int turn) { return turn % 2 == 1; };  // forth, never back
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(arms.turns.size(), 2u * static_cast<std::size_t>(x.c.k.attempts));
  EXPECT_NEAR(execution_log.at(0).tool, 0, 0.03);
}

TEST_F(RubikProgram, AStepWhoseFaceJamsIsTakenBack) {
  arms.jams = [](int turn) { return turn % 2 == 1; };
  const Step step = quarter_turn();
  Program<TwoArms> program(x, arms, execution_log);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  ASSERT_EQ(program.execute(step), Outcome::faulted);
  ASSERT_TRUE(program.may_withdraw(step));
  arms.behaviours.clear();
  for (auto& points : arms.points) points.clear();
  ASSERT_EQ(program.withdraw(step), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, (std::vector{6, kTakePath, kGo}));
  EXPECT_EQ(x.c.cycle.leaves, step.comes) << "the hand that held the cube keeps it";
  ASSERT_EQ(arms.points[0].size(), 2u);
  EXPECT_EQ(arms.points[0][1].motors[0], 10) << "drawn back";
  EXPECT_TRUE(arms.points[1].empty());
  EXPECT_TRUE(execution_log.at(0).given_up);
}

TEST_F(RubikProgram, AStepIsNotTakenBackWithAFaceBetweenItsSeats) {
  arms.jams = [](int turn) { return turn == 1; };
  Step step = quarter_turn();
  x.c.k.attempts = 1;
  arms.stays = true;
  Program<TwoArms> program(x, arms, execution_log);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  ASSERT_EQ(program.execute(step), Outcome::faulted);
  EXPECT_EQ(program.failure(), FailureReason::jammed);
  EXPECT_FALSE(program.may_withdraw(step));
  EXPECT_EQ(arms.behaviours.back(), kStopBoth.m);
}

TEST_F(RubikProgram, AStepIsTakenBackForAJamAlone) {
  arms.finds_nothing = [](int) { return true; };
  const Step step = quarter_turn();
  Program<TwoArms> program(x, arms, execution_log);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  ASSERT_EQ(program.execute(step), Outcome::faulted);
  EXPECT_FALSE(program.may_withdraw(step));
}

TEST_F(RubikProgram, AGripThatMissesIsTriedAgainFromWhereTheApproachBegan) {
  arms.misses = [](int grip) { return grip == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated) << to_string(x.c.failure);
  EXPECT_EQ(execution_log.at(0).grips, 2);
  EXPECT_EQ(count(1), 2);
  EXPECT_EQ(arms.points[0].back().motors[0], 20);
}

TEST_F(RubikProgram, AWorkerThatFindsNothingGivesUpAfterItsAttempts) {
  arms.finds_nothing = [](int) { return true; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.failure, FailureReason::no_contact);
  EXPECT_EQ(execution_log.at(0).grips, x.c.k.attempts);
  EXPECT_EQ(count(5), 0);
}

TEST_F(RubikProgram, AWorkerThatFindsNothingMakesTheHolderFeelWhetherItHasTheCube) {
  arms.finds_nothing = [](int grip) { return grip == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  EXPECT_EQ(execution_log.at(0).grips, 2);
}

TEST_F(RubikProgram, ACubeThatHasSlippedOutOfJawsThatStandIsFeltToBeGone) {
  arms.finds_nothing = [](int) { return true; };
  arms.gone = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.failure, FailureReason::dropped);
  EXPECT_EQ(execution_log.at(0).grips, 1) << "no second attempt at nothing";
  EXPECT_EQ(arms.behaviours.back(), kStopBoth.m);
}

TEST_F(RubikProgram, AWorkerThatPassesByACubeStopsSoonAndTheCubeHasSlipped) {
  arms.finds_nothing = [](int) { return true; };
  arms.passes_by = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.failure, FailureReason::elsewhere);
  EXPECT_EQ(execution_log.at(0).grips, 1);
  EXPECT_LT(x.c.travelled, 0.016);
  EXPECT_GT(x.c.travelled, 0.015);
}

TEST_F(RubikProgram, ACubeThatIsNotWhereItShouldBeIsNotGripped) {
  arms.meets_at = 0.02;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.failure, FailureReason::elsewhere);
  EXPECT_EQ(count(3), 0);
}

TEST_F(RubikProgram, ACubeThatIsGoneEndsTheCycleAtOnce) {
  arms.drops = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.failure, FailureReason::dropped);
  EXPECT_EQ(count(6), 0);
}

TEST_F(RubikProgram, ACubeThatIsGoneWhenTheOtherHandHasLetGoIsFeltToo) {
  arms.drops_late = true;
  ASSERT_EQ(execute(quarter_turn()), Outcome::faulted);
  EXPECT_EQ(x.c.failure, FailureReason::dropped);
  EXPECT_EQ(count(5), 1);
}

TEST_F(RubikProgram, APathOfManyPointsGoesInParts) {
  Step step = quarter_turn();
  step.before[0].points.assign(40, at(0.1, 6));
  ASSERT_EQ(execute(step), Outcome::terminated);
  EXPECT_EQ(arms.points[0].size(), 39u);
  EXPECT_EQ(count(kTakePath), 4);
}

/// Arms of an operator who makes one pause, during a behaviour, and ends it when the program has stood for a while. A
/// camera sees every face well.
class InterruptedArms : public TwoArms {
 public:
  int pause_in{-1};  ///< m of the behaviour; 0: before the first one

  void dispatch(const Motion<Coordinator>& motion, const Coordinator::Y& y) {
    TwoArms::dispatch(motion, y);
    if (motion.m == kResume.m) ++stood_;
    begun_ = begun_ || motion.m == pause_in;
    shown = y.V;
  }
  void read(X& x) {
    TwoArms::read(x);
    x.t.paused = begun_ && stood_ < 10;
    x.V.there = x.V.reading.valid = true;
    x.V.reading.step = x.i * kPacing.n_s;
  }
  CubeFaceSetting shown;  ///< that was asked for last

 private:
  int stood_{};
  bool begun_{};
};

std::vector<int> with_pause(const Step& step, int pause_in) {
  InterruptedArms arms;
  Coordinator::X x;
  ExecutionLog execution_log;
  arms.pause_in = pause_in;
  Program<InterruptedArms> program(x, arms, execution_log);
  EXPECT_EQ(program.wait_for_start(), Outcome::terminated);
  arms.behaviours.clear();
  EXPECT_EQ(program.execute(step), Outcome::terminated);
  return arms.behaviours;
}

TEST(RubikPause, ComesBeforeTheNextFreeMotionOrCycleAndNeverWithinOne) {
  const int p = kResume.m;
  const Step step = quarter_turn();
  EXPECT_EQ(with_pause(step, 0), (std::vector{p, kTakePath, kGo, kWeigh, 1, 2, 3, 4, 5, 6, kTakePath, kGo}));
  EXPECT_EQ(with_pause(step, kGo),
            (std::vector{kTakePath, kGo, p, kWeigh, 1, 2, 3, 4, 5, 6, kTakePath, kGo}));
  for (const int m : {kWeigh, 1, 2, 3, 4, 5, 6})
    EXPECT_EQ(with_pause(step, m), (std::vector{kTakePath, kGo, kWeigh, 1, 2, 3, 4, 5, 6, p, kTakePath, kGo}))
        << m;
}

TEST(RubikPause, OfTwoArmsComesBeforeEachOfThemGoes) {
  const int p = kResume.m;
  Step step = quarter_turn();
  step.before.insert(step.before.begin(),
                     {.hand = Hand::track, .points = {at(0, 7), at(0.3, 7)}, .carries = true});
  const std::vector cycle{kWeigh, 1, 2, 3, 4, 5, 6, kTakePath, kGo};
  const auto begins = [&](int pause_in, std::vector<int> first) {
    first.insert(first.end(), cycle.begin(), cycle.end());
    EXPECT_EQ(with_pause(step, pause_in), first) << pause_in;
  };
  begins(0, {p, kTakePath, kGo});
  begins(kTakePath, {kTakePath, p, kGo});
  begins(kGo, {kTakePath, kGo, p, kGo});
  step.before[1].delay = 0.1;
  begins(kGo, {kTakePath, kGo, p});
}

TEST_F(RubikProgram, AStepThatShowsAFaceEndsWithItsPicture) {
  Step step = regrasp();
  step.before[0].hand = Hand::track;
  step.shows = Face::L;
  InterruptedArms camera;
  Program<InterruptedArms> program(x, camera, execution_log);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  camera.behaviours.clear();
  ASSERT_EQ(program.execute(step), Outcome::terminated);
  EXPECT_EQ(camera.behaviours, (std::vector{kTakePath, kGo, kLook.m}));
  EXPECT_EQ(camera.shown.face, static_cast<int>(Face::L));
  EXPECT_EQ(execution_log.at(0).grips, 0);
  EXPECT_EQ(x.c.joint_paths[index(Hand::track)].jaws, 0) << "the hand that has the cube keeps its jaws";
}

TEST_F(RubikProgram, AfterACycleTheHandThatLeavesGoesWithItsJawsOpenAndNobodyWaitsForThem) {
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  const std::size_t leaves = index(Hand::track), keeps = index(Hand::postument);
  EXPECT_EQ(x.c.joint_paths[leaves].jaws, x.c.k.open);
  EXPECT_EQ(x.c.joint_paths[leaves].count, 1);
  EXPECT_TRUE(x.c.joint_paths[keeps].empty());
  EXPECT_EQ(x.c.goes_at[leaves], 0);
  EXPECT_LT(x.c.goes_at[keeps], 0);
  EXPECT_FALSE(x.c.jaws_too);
  EXPECT_TRUE(x.c.loaded[keeps]);
  EXPECT_FALSE(x.c.loaded[leaves]);
}

TEST_F(RubikProgram, TheExecutionLogRecordsWhoDidWhatAndWhen) {
  const Step step = quarter_turn();
  ASSERT_EQ(execute(step), Outcome::terminated);
  const CycleRecord entry = execution_log.at(0);
  EXPECT_EQ(entry.comes, step.comes);
  EXPECT_EQ(entry.leaves, step.leaves);
  EXPECT_EQ(entry.turn, step.turn);
  EXPECT_TRUE(entry.done);
  EXPECT_FALSE(entry.given_up);
  EXPECT_EQ(entry.grips, 1);
  EXPECT_NEAR(entry.travelled, kApproachDistance, 1e-9);
  EXPECT_LT(entry.begun, entry.turn_begun);
  EXPECT_LT(entry.turn_begun, entry.turn_ended);
  EXPECT_LT(entry.turn_ended, entry.ended);
  EXPECT_EQ(entry.ended, x.i);
  Program<TwoArms> program(x, arms, execution_log);
  ASSERT_EQ(program.execute(regrasp()), Outcome::terminated);
  EXPECT_EQ(execution_log.at(1).attempts, 0);
  EXPECT_FALSE(execution_log.at(1).done);
  EXPECT_EQ(execution_log.at(1).begun, entry.ended);
}

TEST_F(RubikProgram, ARegraspIsATurnByNothingThatIsOverAtOnce) {
  ASSERT_EQ(execute(regrasp()), Outcome::terminated);
  EXPECT_LT(arms.turns.at(0).angle, 0);
  EXPECT_EQ(arms.turns.at(0).mobility, x.c.k.mobility);
}

TEST_F(RubikProgram, APortThatGivesUpEndsTheStepWithoutAFailure) {
  Program<TwoArms> program(x, arms, execution_log);
  ASSERT_EQ(program.wait_for_start(), Outcome::terminated);
  for (const int macrosteps : {5, 40, 60, 90, 110, 300, 320}) {
    TwoArms others;
    arms = others;
    arms.limit = macrosteps;
    EXPECT_EQ(program.execute(quarter_turn()), Outcome::aborted) << macrosteps;
    EXPECT_EQ(program.failure(), FailureReason::none);
  }
}

TEST_F(RubikProgram, EveryFailureIsBrokenOffBeforeAnythingElseMoves) {
  const std::vector approach{kTakePath, kGo, kWeigh, 1}, back{kWait, kTakePath, kGo, kTakePath, kGo};
  const std::vector again{kWeigh, 1, 2, 3, 4, 5, 6, kTakePath, kGo};
  const auto joined = [](std::initializer_list<std::vector<int>> parts) {
    std::vector<int> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  };
  arms.misses = [](int grip) { return grip == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, joined({approach, {2, 3, 4}, back, again}));
  arms = {};
  arms.finds_nothing = [](int grip) { return grip == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, joined({approach, {kWait, kTakePath, kGo}, back, again})) << "the holder feels";
  arms = {};
  arms.jams = [](int turn) { return turn == 1; };
  ASSERT_EQ(execute(quarter_turn()), Outcome::terminated);
  EXPECT_EQ(arms.behaviours, joined({approach, {2, 3, 4, 5, kWait, 5, kWait, 5, 6, kTakePath, kGo}}));
}

}  // namespace
}  // namespace mrroc::rubik
