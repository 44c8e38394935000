// Detection of rest from the encoders, the set point and the brakes alone.
#include "edp/standstill_detector.hpp"

#include <gtest/gtest.h>

#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr std::int64_t kSettled = StandstillDetector::kSettled;
constexpr std::int64_t kLongestStop = StandstillDetector::kLongestStop;

AxisVector increment(double of_one_motor) { return AxisVector::Unit(6, 3) * of_one_motor; }

/// A motor turns from one step to another by 10 increments a step, and stands before and after.
StandstillDetector moved(std::int64_t first, std::int64_t until, std::int64_t last,
                         std::int64_t commanded_until) {
  StandstillDetector d;
  for (std::int64_t step = 0; step < last; ++step)
    d.step(step, increment(step >= first && step < until ? -10 : 0), commanded_until, true);
  return d;
}

TEST(StandstillDetector, CountsFromTheLastCommandToTheLastStepOfMotion) {
  EXPECT_EQ(moved(0, 530, 700, 500).stop_steps(400), 30) << "the robot obeys commands, not the stop";
  EXPECT_EQ(moved(0, 400, 700, 500).stop_steps(400), 0);
  EXPECT_EQ(moved(0, 0, 700, 0).stop_steps(0), 0) << "one that never moved";
}

TEST(StandstillDetector, ARobotThatMovesByItselfIsCountedFromTheStop) {
  EXPECT_EQ(moved(0, 2 * kLongestStop + 40, 3 * kLongestStop, 0).stop_steps(2 * kLongestStop), 40);
}

TEST(StandstillDetector, ARobotThatIsRegulatedToTheEndOfItsWayIsCountedFromThenOnAndMayRestMeanwhile) {
  StandstillDetector d = moved(0, 530, 700, 200);
  EXPECT_TRUE(d.at_rest());
  EXPECT_EQ(d.stop_steps(500), 330);
  d.regulated(500);
  EXPECT_EQ(d.stop_steps(500), 30);
  d.regulated(710);
  EXPECT_EQ(d.stop_steps(500), 0) << "it stood already when that ended";
  EXPECT_TRUE(d.at_rest());
}

TEST(StandstillDetector, RestsOnceTheMotorsHaveStoodForLongEnough) {
  EXPECT_FALSE(moved(0, 50, 50 + kSettled, 10).at_rest());
  EXPECT_TRUE(moved(0, 50, 51 + kSettled, 10).at_rest());
  EXPECT_FALSE(moved(0, 50, 51 + kSettled, 60 + kSettled).at_rest()) << "a command may yet come";
}

TEST(StandstillDetector, ARobotWhoseSetPointMovesOrWhoseBrakesAreOpenDoesNotRest) {
  StandstillDetector d;
  for (std::int64_t step = 0; step < 3 * kSettled; ++step) d.step(step, increment(0), 0, false);
  EXPECT_FALSE(d.at_rest());
  d.step(3 * kSettled, increment(0), 0, true);
  EXPECT_TRUE(d.at_rest());
}

TEST(StandstillDetector, AShaftThatTremblesByAnIncrementRestsAndOneThatCreepsDoesNot) {
  StandstillDetector trembles, creeps;
  for (std::int64_t step = 0; step < 10 * kSettled; ++step) {
    trembles.step(step, increment(step % 2 == 0 ? 1 : -1), 0, true);
    creeps.step(step, increment(step % 20 == 0 ? 1 : 0), 0, true);  // three increments in 60 steps
  }
  EXPECT_TRUE(trembles.at_rest());
  EXPECT_FALSE(creeps.at_rest());
}

TEST(StandstillDetector, ADriversReplyTellsWhetherTheRobotRestsAndWhetherItsPositionIsKnown) {
  Rig rig;
  EXPECT_FALSE(rig.macrostep().position_known);
  rig.synchronise();
  EffectorReply reply = rig.silence(12);
  EXPECT_TRUE(reply.position_known);
  EXPECT_TRUE(reply.at_rest);
  reply = rig.repeat(rig.velocity({u(0.02), u(), u(), u(), u(), u()}), 5);
  EXPECT_FALSE(reply.at_rest);
  const std::int64_t end = rig.driver.commanded_until();
  while (!rig.silence(1).at_rest) ASSERT_LT(rig.last.step, end + 40 + 2 * kSettled);
  EXPECT_GT(rig.driver.standstill().stop_steps(end), 10);
  EXPECT_LE(rig.driver.standstill().stop_steps(end), 45);
  rig.driver.trip(Fault{.code = FaultCode::over_current});
  reply = rig.silence(12);
  EXPECT_TRUE(reply.position_known) << "a fault does not turn the motors";
  EXPECT_TRUE(reply.at_rest) << "the brakes hold it";
}

}  // namespace
}  // namespace mrroc::edp::test
