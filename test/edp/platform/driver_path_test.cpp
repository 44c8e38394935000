// A platform on its way: the times of a macrostep, joints between fragments, ends, pauses and stops.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/planar.hpp"
#include "test/edp/platform/platform_rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr double kClose = 0.01;  // [m]

struct Driving : testing::Test {
  PlatformRig rig;
  void SetUp() override { ASSERT_TRUE(rig.synchronise()); }
  /// Hands fragments over, one in a macrostep.
  void hand(std::initializer_list<Fragment> fragments) {
    for (const Fragment& f : fragments) {
      const PlatformReply reply = rig.macrostep(rig.set(f));
      ASSERT_EQ(reply.verdict, Verdict::executed) << reply.fault.text.view();
    }
  }
};

TEST_F(Driving, TorquesChangeInTheThirdStepOfAMacrostepOnly) {
  Way way = rig.way();
  hand({way.next(0.5, 0.5, 50)});
  PerWheel before = rig.last.torque;
  int changes = 0;
  for (int macrostep = 0; macrostep < 30; ++macrostep) {
    rig.driver.take(rig.keep());
    for (int k = 1; k <= kPlatformSteps; ++k) {
      rig.step();
      if (k != 3) {
        EXPECT_EQ(rig.last.torque, before) << "step " << k;
      }
      changes += rig.last.torque != before;
      before = rig.last.torque;
      EXPECT_EQ(rig.driver.reply_due(), k == 9);
      EXPECT_TRUE(rig.last.enabled);
      EXPECT_EQ(rig.last.step, rig.ground.step - 1);
    }
  }
  EXPECT_EQ(changes, 30);
}

TEST_F(Driving, TheDrivesBrakeUntilTheFirstTorquesAreThere) {
  rig.driver.take(rig.set(rig.way().next(0.5, 0, 50)));
  for (int k = 1; k <= kPlatformSteps; ++k) {
    rig.step();
    EXPECT_EQ(rig.last.enabled, k >= 3) << k;
  }
}

TEST_F(Driving, RepliesHaveTheEstimateOfTheMacrostepsBeginning) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 50)});
  for (int k = 0; k < 20; ++k) {
    const PlatformReply reply = rig.wait(1);
    EXPECT_EQ(reply.estimate.step, rig.ground.step - kPlatformSteps);
    EXPECT_EQ(reply.step, rig.ground.step - 2);
    EXPECT_EQ(reply.executing, 1);
    EXPECT_EQ(reply.iteration, k + 1);
    EXPECT_EQ(reply.remaining, 49 - k);
  }
}

TEST_F(Driving, TelemetryHasTheReferenceFromNowToTheHorizon) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 50), way.next(0.5, 0, 100)});
  rig.wait(60);
  const auto apart = [](const PlanarPose& a, const PlanarPose& b) {
    return std::hypot(a.x - b.x, a.y - b.y);
  };
  const auto& reference = rig.driver.telemetry().reference;
  EXPECT_LT(apart(reference.front(), rig.driver.wanted().p), 0.5 * kPlatformPeriod + 1e-6);
  for (std::size_t k = 1; k < reference.size(); ++k)
    EXPECT_NEAR(apart(reference[k], reference[k - 1]), 0.5 * 0.05, 1e-3) << k;
}

TEST_F(Driving, FollowsFragmentsWithoutADipAtTheirJoints) {
  Way way = rig.way();
  hand({way.next(0.6, 0, 60), way.next(0.6, 0.8, 60), way.next(0.6, -0.8, 60), way.next(0, 0, 60)});
  double slowest = 1;
  double farthest = 0;
  for (int k = 0; k < 240; ++k) {
    rig.wait(1);
    if (k > 70 && k < 170) slowest = std::min(slowest, rig.ground.v);
    farthest = std::max(farthest, rig.away(rig.driver.wanted().p));
  }
  EXPECT_GT(slowest, 0.57);
  EXPECT_LT(farthest, 0.04);
  EXPECT_EQ(rig.driver.state(), DriverState::holding);
  rig.wait(50);
  EXPECT_LT(rig.away(way.end().p), kClose);
}

TEST_F(Driving, RestsAtTheEndOfItsWayAndBrakes) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 40), way.next(0, 0, 40)});
  ASSERT_TRUE(rig.reach(DriverState::holding));
  EXPECT_TRUE(rig.last.enabled) << "the last point is stabilised";
  const PlatformReply reply = rig.wait(100);
  EXPECT_FALSE(rig.last.enabled);
  EXPECT_TRUE(reply.at_rest);
  EXPECT_EQ(reply.state, DriverState::holding);
  EXPECT_LT(rig.away(way.end().p), kClose);
}

// Somewhere in the room the map moves by 20 cm, or turns.
TEST(MovingMap, MakesNoKickAndIsFollowedInTheEnd) {
  const auto begun = [] {
    auto rig = std::make_unique<PlatformRig>();
    EXPECT_TRUE(rig->synchronise());
    Way way = rig->way();
    rig->macrostep(rig->set(way.next(0.5, 0, 60)));
    for (int k = 0; k < 3; ++k) rig->macrostep(rig->set(way.next(0.5, 0, 300)));
    rig->wait(90);
    return rig;
  };
  const auto still = begun();
  still->wait(700);
  for (const PlanarPose& displacement :
       {PlanarPose{0.2, 0, 0}, {-0.2, 0, 0}, {0, 0.2, 0}, {0.1, -0.2, 0}, {0, 0, 0.1}}) {
    const auto moved = begun();
    moved->platform.faults.displacement = displacement;
    double kick = 0, turned = 0;
    for (int k = 0; k < 50; ++k) {
      moved->wait(1);
      kick = std::max(kick, std::abs(moved->ground.v - 0.5));
      turned = std::max(turned, std::abs(moved->ground.w));
    }
    EXPECT_LT(kick, 1.2 * ReferenceOffset::kBack);
    EXPECT_LT(turned, 0.25);
    moved->wait(650);
    ASSERT_EQ(moved->driver.state(), DriverState::executing);
    EXPECT_LT(distance(chained(displacement, moved->ground.p), still->ground.p), kClose)
        << displacement.x << " " << displacement.y << " " << displacement.phi;
  }
}

TEST_F(Driving, APlatformThatIsPushedAwayFromItsEndDrivesBack) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 40), way.next(0, 0, 40)});
  rig.wait(200);
  ASSERT_FALSE(rig.last.enabled);
  rig.ground.push = 8;
  rig.wait(20);
  rig.ground.push = 0;
  EXPECT_GT(rig.away(way.end().p), PlatformDriver::kHeldPosition);
  rig.wait(100);
  EXPECT_LT(rig.away(way.end().p), PlatformDriver::kHeldPosition);
  EXPECT_FALSE(rig.last.enabled);
}

TEST_F(Driving, APauseStandsOnTheWayAndGoesOnFromThere) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 50), way.next(0.5, 0.5, 100, 50), way.next(0, 0, 50)});
  rig.wait(60);
  for (int k = 9; k >= 0; --k) {
    rig.pace = k / 10.;
    rig.wait(1);
  }
  const PlatformReply paused = rig.wait(100);
  EXPECT_EQ(paused.state, DriverState::executing);
  EXPECT_LT(std::abs(rig.ground.v), 1e-3);
  EXPECT_TRUE(rig.last.enabled);
  const PlatformReply still = rig.wait(100);
  EXPECT_EQ(still.iteration, paused.iteration) << "the fragment's time stands";
  EXPECT_EQ(still.notified, paused.notified);
  rig.pace = 1;
  EXPECT_TRUE(rig.reach(DriverState::holding));
  rig.wait(60);
  EXPECT_LT(rig.away(way.end().p), kClose);
}

TEST_F(Driving, HalfThePaceTakesTwiceTheTime) {
  rig.pace = 0.5;
  Way way = rig.way();
  hand({way.next(0.5, 0, 40, 20), way.next(0, 0, 40)});
  int macrosteps = 1;
  for (; rig.driver.state() == DriverState::executing && macrosteps < 1000; ++macrosteps) {
    const PlatformReply reply = rig.wait(1);
    EXPECT_LT(rig.ground.v, 0.29);
    if (macrosteps < 38) {
      EXPECT_EQ(reply.notified, 0) << "notify counts the fragment's time";
    }
    if (macrosteps == 42) {
      EXPECT_EQ(reply.notified, 1);
    }
  }
  EXPECT_NEAR(macrosteps, 160, 2);
}

TEST_F(Driving, AStopComesToRestOnTheWayWhateverTheReason) {
  for (int reason = 0; reason < 4; ++reason) {
    PlatformRig other;
    ASSERT_TRUE(other.synchronise());
    Way way = other.way();
    other.macrostep(other.set(way.next(0.8, 0, 60)));
    other.macrostep(other.set(way.next(0.8, 0.5, 200)));
    other.wait(80);
    const PlanarPose from = other.ground.p;
    if (reason == 0) other.driver.drop_owner();
    if (reason == 1) other.macrostep(other.command(Instruction::reset));
    if (reason == 2) {
      PlatformCommand release = other.keep();
      release.instruction = Instruction::release;
      other.macrostep(release);
    }
    const std::int64_t stopped = other.ground.step;
    double off_the_way = 0;
    for (int k = 0; k < 80; ++k) {
      other.quiet();
      if (other.driver.state() == DriverState::decelerating)
        off_the_way = std::max(off_the_way, other.away(other.driver.wanted().p));
    }
    EXPECT_EQ(other.driver.state(), DriverState::holding) << reason;
    EXPECT_TRUE(other.driver.standstill().at_rest()) << reason;
    EXPECT_FALSE(other.last.enabled) << "the drives brake";
    EXPECT_LT(other.away(from), reason == 3 ? 0.4 : 0.25) << reason;
    EXPECT_LT(off_the_way, 0.05) << reason;
    if (reason == 0) {
      EXPECT_LE(other.driver.standstill().stop_steps(stopped), 300);
    }
    EXPECT_EQ(other.driver.reply().executing, 0);
    EXPECT_EQ(other.driver.reply().remaining, 0);
  }
}

// Something presses it to and fro, as a box does against which it leans, so that the tracker goes on until the stop.
TEST_F(Driving, AStopAtTheEndOfItsWayIsCountedFromTheStopAndNotFromTheEnd) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 40), way.next(0, 0, 40)});
  ASSERT_TRUE(rig.reach(DriverState::holding));
  for (int k = 0; k < 40; ++k) {
    rig.ground.push = k / 5 % 2 == 0 ? 2 : -2;
    rig.wait(1);
  }
  ASSERT_TRUE(rig.last.enabled) << "it is still held at the end";
  rig.ground.push = 0;
  rig.driver.drop_owner();
  const std::int64_t stopped = rig.ground.step;
  for (int k = 0; k < 80; ++k) rig.quiet();
  EXPECT_TRUE(rig.driver.standstill().at_rest());
  EXPECT_GT(rig.driver.standstill().stop_steps(stopped), 0);
  EXPECT_LE(rig.driver.standstill().stop_steps(stopped), 300);
}

TEST_F(Driving, AStopOfAPlatformThatRestsAtItsEndTakesNoStep) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 40), way.next(0, 0, 40)});
  ASSERT_TRUE(rig.reach(DriverState::holding));
  rig.ground.push = 0.05;
  rig.wait(40);
  rig.ground.push = 0;
  rig.wait(60);
  ASSERT_FALSE(rig.last.enabled);
  rig.driver.drop_owner();
  const std::int64_t stopped = rig.ground.step;
  for (int k = 0; k < 20; ++k) rig.quiet();
  EXPECT_EQ(rig.driver.standstill().stop_steps(stopped), 0);
}

TEST_F(Driving, AStopAtSpeedDeceleratesByNoMoreThanTyresCanGive) {
  Way way = rig.way();
  hand({way.next(1, 0, 60), way.next(1, 0, 200)});
  rig.wait(80);
  rig.driver.drop_owner();
  rig.quiet();
  ASSERT_EQ(rig.driver.state(), DriverState::decelerating);
  double before = 1;
  int macrosteps = 0;
  for (; rig.driver.state() == DriverState::decelerating; ++macrosteps) {
    rig.quiet();
    EXPECT_LE(before - rig.driver.wanted().v, kPaceAcceleration * kPlatformPeriod + 1e-9) << macrosteps;
    before = rig.driver.wanted().v;
  }
  EXPECT_NEAR(macrosteps, 25, 1) << "1 m/s with 2 m/s^2";
}

TEST_F(Driving, APauseAndItsEndChangeTheSpeedByNoMoreThanTyresCanGive) {
  Way way = rig.way();
  hand({way.next(1, 0, 60), way.next(1, 0, 300), way.next(1, 0, 300)});
  rig.wait(80);
  for (const double pace : {0., 1.}) {
    rig.pace = pace;
    double before = rig.driver.wanted().v;
    for (int k = 0; k < 60; ++k) {
      rig.wait(1);
      const double now = rig.driver.wanted().v;
      EXPECT_LE(std::abs(now - before), kPaceAcceleration * kPlatformPeriod + 1e-9) << k;
      before = now;
    }
    EXPECT_NEAR(before, pace, 1e-9);
  }
}

TEST_F(Driving, AStoppedPlatformDoesNotGoBackToWhereItWasToStand) {
  Way way = rig.way();
  hand({way.next(0.8, 0, 60), way.next(0.8, 0, 200)});
  rig.wait(80);
  rig.driver.drop_owner();
  rig.ground.push = 3;  // it slides on
  PlanarPose to_stand_at;
  while (rig.driver.state() != DriverState::holding) {
    to_stand_at = rig.driver.wanted().p;
    rig.quiet();
  }
  rig.ground.push = 0;
  int held = 0;
  double slowest = 0;
  rig.after_each_step = [&] { slowest = std::min(slowest, rig.ground.v); };
  for (int k = 0; k < 60; ++k) {
    rig.quiet();
    const PlanarPose &wanted = rig.driver.wanted().p, &is = rig.driver.estimate().estimate.p;
    EXPECT_GT(std::hypot(wanted.x - to_stand_at.x, wanted.y - to_stand_at.y), 0.03) << k;
    EXPECT_LT(std::hypot(wanted.x - is.x, wanted.y - is.y), 1e-12) << k << ": it is to stand where it is";
    held += rig.last.enabled ? 1 : 0;
  }
  EXPECT_GE(held, 2) << "the tracker had time to go back";
  EXPECT_GT(slowest, -0.01);
}

TEST_F(Driving, SilenceIsToldAndAMotionRefusedUntilThen) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 50), way.next(0.5, 0, 200)});
  rig.wait(60);
  for (int k = 0; k < 9; ++k) rig.quiet();
  EXPECT_EQ(rig.driver.state(), DriverState::executing) << "a fragment outlasts many macrosteps";
  const PlatformReply reply = rig.quiet();
  EXPECT_EQ(reply.state, DriverState::decelerating);
  EXPECT_EQ(reply.fault.code, FaultCode::peer_silent);
  ASSERT_TRUE(rig.reach(DriverState::holding));
  rig.wait(60);
  EXPECT_FALSE(rig.driver.fault());
  Way anew = rig.way();
  anew.number = 2;
  EXPECT_EQ(rig.macrostep(rig.set(anew.next(0.1, 0, 20))).verdict, Verdict::executed);
}

TEST_F(Driving, AnotherSessionBeginsWithItsOwnNumbersAfterAStop) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 50), way.next(0.5, 0, 200)});
  rig.wait(60);
  rig.driver.drop_owner();
  for (int k = 0; k < 80; ++k) rig.quiet();
  PlatformCommand c = rig.set(rig.way().next(0.2, 0, 20));
  c.session = 8;
  c.number = 1;
  const PlatformReply reply = rig.macrostep(c);
  EXPECT_EQ(reply.verdict, Verdict::executed) << reply.fault.text.view();
  EXPECT_EQ(reply.accepted, 1);
}

TEST_F(Driving, AnOlderMessageDoesNotReplaceThePaceOfANewerOne) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 20), way.next(0.5, 0, 300)});
  rig.wait(30);
  for (int k = 0; k < 40; ++k) {
    PlatformCommand newer = rig.keep(), older = rig.keep();
    newer.pace = 0.4;
    older.pace = 0.9;
    older.macrostep -= 1 + k % 3;
    rig.driver.take(k % 2 == 0 ? newer : older);
    rig.macrostep(k % 2 == 0 ? older : newer);
  }
  EXPECT_NEAR(rig.driver.wanted().v, 0.4 * 0.5, 1e-9);
  PlatformCommand late = rig.keep();
  late.pace = 0.9;
  late.macrostep -= 5;
  for (int k = 0; k < 5; ++k) rig.macrostep(late);
  EXPECT_NEAR(rig.driver.wanted().v, 0.4 * 0.5, 1e-9) << "also when it comes alone";
  for (int k = 0; k < 20; ++k) {
    PlatformCommand first = rig.keep(), second = rig.keep();
    first.pace = 0.9;
    second.pace = 0.6;
    rig.driver.take(first);
    rig.macrostep(second);
  }
  EXPECT_NEAR(rig.driver.wanted().v, 0.6 * 0.5, 1e-9) << "of two with one stamp the later one counts";
}

TEST_F(Driving, StampsOfTheSessionBeforeDoNotHoldThePaceOfANewOne) {
  Way way = rig.way();
  hand({way.next(0.3, 0, 20), way.next(0, 0, 20)});
  ASSERT_TRUE(rig.reach(DriverState::holding));
  PlatformCommand far_ahead = rig.keep();
  far_ahead.macrostep += 100'000;
  rig.macrostep(far_ahead);
  rig.driver.drop_owner();
  rig.quiet();
  const auto of_session_8 = [](PlatformCommand c, double pace) {
    c.session = 8;
    c.pace = pace;
    return c;
  };
  Way anew = rig.way();
  for (const std::int64_t number : {1, 2}) {
    PlatformCommand c = of_session_8(rig.set(anew.next(0.4, 0, number == 1 ? 20 : 300)), 0.5);
    c.number = number;
    const PlatformReply reply = rig.macrostep(c);
    ASSERT_EQ(reply.verdict, Verdict::executed) << reply.fault.text.view();
  }
  for (int k = 0; k < 60; ++k) rig.macrostep(of_session_8(rig.keep(), 0.5));
  EXPECT_NEAR(rig.driver.wanted().v, 0.5 * 0.4, 1e-9) << "from its first message on";
  for (int k = 0; k < 30; ++k) rig.macrostep(of_session_8(rig.keep(), 0.25));
  EXPECT_NEAR(rig.driver.wanted().v, 0.25 * 0.4, 1e-9);
}

TEST_F(Driving, TheFirstFragmentOfASessionBeginsWithItsPaceAndItsNumbers) {
  Way way = rig.way();
  hand({way.next(0.3, 0, 20), way.next(0, 0, 20)});
  ASSERT_TRUE(rig.reach(DriverState::holding));
  PlatformCommand far_ahead = rig.keep();
  far_ahead.macrostep += 100'000;
  EXPECT_EQ(rig.macrostep(far_ahead).notified, 2);
  rig.driver.drop_owner();
  rig.quiet();
  Way anew = rig.way();
  PlatformCommand c = rig.set(anew.next(0.4, 0, 40, 20));
  c.session = 8;
  c.number = 1;
  c.pace = 0.5;
  const PlatformReply first = rig.macrostep(c);
  ASSERT_EQ(first.verdict, Verdict::executed) << first.fault.text.view();
  EXPECT_EQ(first.accepted, 1);
  EXPECT_EQ(first.notified, 0) << "nothing of the session before";
  EXPECT_EQ(first.iteration, 0);
  for (int k = 0; k < 8; ++k) rig.quiet();
  EXPECT_LE(rig.quiet().iteration, 5) << "half the pace from its beginning on";
}

TEST_F(Driving, AFragmentThatComesLateDoesNotReplaceThePaceOfANewerMessage) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 20), way.next(0.5, 0, 300)});
  rig.wait(30);
  rig.pace = 0.4;
  rig.wait(20);
  PlatformCommand late = rig.set(way.next(0.5, 0, 100));
  late.pace = 0.9;
  late.macrostep -= 5;
  EXPECT_EQ(rig.macrostep(late).verdict, Verdict::executed);
  for (int k = 0; k < 5; ++k) rig.quiet();
  EXPECT_NEAR(rig.driver.wanted().v, 0.4 * 0.5, 1e-9);
}

TEST_F(Driving, ASessionWhoseFirstFragmentIsRefusedHasNotBegun) {
  Way way = rig.way();
  hand({way.next(0.5, 0, 20), way.next(0, 0, 20)});
  ASSERT_TRUE(rig.reach(DriverState::holding));
  rig.driver.drop_owner();
  ASSERT_EQ(rig.quiet().accepted, 2);
  PlatformCommand c = rig.set(rig.way().next(0.2, 0, 20));
  c.session = 8;
  c.number = 1;
  c.fragment.number = 3;  // it goes on from the session before
  const PlatformReply refused = rig.macrostep(c);
  EXPECT_EQ(refused.verdict, Verdict::refused);
  EXPECT_EQ(refused.fault.limit, 1) << "the number that is expected";
  EXPECT_EQ(refused.accepted, 2);
  EXPECT_EQ(refused.notified, 2);
  c.fragment.number = 1;
  c.number = refused.expected;
  c.session = 9;
  EXPECT_EQ(rig.macrostep(c).accepted, 1);
}

TEST_F(Driving, ARefusedFragmentChangesNothing) {
  PlatformRig twin;
  ASSERT_TRUE(twin.synchronise());
  Way way = rig.way();
  const Fragment first = way.next(0.5, 0, 50);
  Fragment bad = way.next(0.5, 0, 50);
  bad.knot[9].v = 3;
  rig.macrostep(rig.set(first));
  twin.macrostep(twin.set(first));
  const PlatformReply reply = rig.macrostep(rig.set(bad));
  EXPECT_EQ(reply.verdict, Verdict::refused);
  EXPECT_EQ(reply.fault.axis, 3);
  EXPECT_EQ(reply.fault.value, 3);
  EXPECT_EQ(reply.fault.limit, 1);
  twin.wait(1);
  for (int k = 0; k < 60; ++k) {
    rig.wait(1);
    twin.wait(1);
    ASSERT_EQ(rig.last.torque, twin.last.torque);
    ASSERT_EQ(rig.driver.state(), twin.driver.state());
  }
}

TEST_F(Driving, UnnumberedPartsThatAreNoNumbersAreCountedAndDropped) {
  Way way = rig.way();
  hand({way.next(0.3, 0, 50), way.next(0.3, 0, 100)});
  const std::int32_t before = rig.wait(1).rejected;
  rig.pace = 2;
  EXPECT_EQ(rig.wait(1).rejected, before + 1);
  rig.pace = std::nan("");
  EXPECT_EQ(rig.wait(1).rejected, before + 2);
  rig.pace = 1;
  PlatformCommand c = rig.keep();
  c.map.step = rig.ground.step + 1'000;
  EXPECT_EQ(rig.macrostep(c).rejected, before + 3);
  c = rig.keep();
  c.odometry.valid = true;
  c.odometry.step = rig.ground.step;
  EXPECT_EQ(rig.macrostep(c).rejected, before + 4) << "a matrix of zeros";
  EXPECT_EQ(rig.driver.state(), DriverState::executing);
  EXPECT_NEAR(rig.ground.v, 0.3, 0.3);
}

TEST_F(Driving, MeasurementsOlderThanTheWindowAreCounted) {
  rig.wait(50);
  const PlatformReply before = rig.wait(1);
  PlatformCommand c = rig.keep();
  c.odometry.valid = true;
  c.odometry.step_before = rig.ground.step - 300;
  c.odometry.step = rig.ground.step - 260;
  c.odometry.A = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  for (std::size_t k = 0; k < 6; ++k) c.odometry.covariance[7 * k] = 1e-6;
  EXPECT_EQ(rig.macrostep(c).late_odometry, before.late_odometry + 1);
  EXPECT_EQ(rig.macrostep(c).late_odometry, before.late_odometry + 1)
      << "the same one is not looked at again";
}

TEST_F(Driving, TheEstimatedSlipIsUsedOnceItIsCertain) {
  Way way = rig.way();
  hand({way.next(0.3, 0, 50), way.next(0.3, 0, 300)});
  EXPECT_FALSE(rig.wait(5).adapting);
  EXPECT_EQ(FakeTracker::used.mu_x, Slip{}.mu_x);
  rig.platform.faults.slip_sd = 0.1;
  EXPECT_TRUE(rig.wait(1).adapting);
  EXPECT_EQ(FakeTracker::used.mu_x, 0.5);
  rig.platform.faults.slip_sd = 0.2;
  EXPECT_TRUE(rig.wait(1).adapting) << "it is not forgotten at once";
  rig.platform.faults.slip_sd = 0.4;
  EXPECT_FALSE(rig.wait(1).adapting);
}

TEST(DrivingFixed, NoMoreFrictionThanTheNominalOneIsCountedOn) {
  PlatformDriverParameters p = PlatformRig::parameters();
  p.nominal = {0.45, 0.6, 0};
  PlatformRig rig(p);
  ASSERT_TRUE(rig.synchronise());
  rig.platform.faults.slip_sd = 0.01;
  rig.macrostep(rig.set(rig.way().next(0.3, 0, 50)));
  ASSERT_TRUE(rig.wait(5).adapting);
  EXPECT_EQ(FakeTracker::used.mu_x, 0.45) << "0.5 are estimated";
  EXPECT_EQ(FakeTracker::used.mu_y, 0.4);
  EXPECT_EQ(FakeTracker::used.split, 0.1);
}

TEST(DrivingFixed, WithoutAdaptationTheNominalSlipIsUsed) {
  PlatformDriverParameters p = PlatformRig::parameters();
  p.adapt = false;
  p.nominal.mu_y = 0.33;
  PlatformRig rig(p);
  ASSERT_TRUE(rig.synchronise());
  rig.platform.faults.slip_sd = 0.01;
  rig.macrostep(rig.set(rig.way().next(0.3, 0, 50)));
  EXPECT_FALSE(rig.wait(5).adapting);
  EXPECT_EQ(FakeTracker::used.mu_y, 0.33);
}

}  // namespace
}  // namespace mrroc::edp::test
