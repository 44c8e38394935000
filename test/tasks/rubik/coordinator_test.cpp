// The coordinator of the cube's task by value: what ends its behaviours, what is a failure, and what it orders.
#include "tasks/rubik/coordinator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "base/representation.hpp"
#include "tasks/rubik/plan/plan.hpp"
#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {
namespace {

using X = Coordinator::X;

constexpr std::size_t kP = index(Hand::postument), kT = index(Hand::track);

/// The track arm holds the cube, the postument comes, and the track arm leaves; i macrosteps of the behaviour are over.
X image(std::int64_t i = 10) {
  X x;
  x.i_0 = 1000;
  x.i = 1000 + i;
  x.c.last_progress = x.i;
  for (ArmReport& r : x.T.agent) {
    r.ready = true;
    r.gripper = 0.057;
    r.driver_state = DriverState::executing;
  }
  return x;
}

const Motion<Coordinator>& row(int m) { return kCycle[static_cast<std::size_t>(m - 1)]; }

void put(ArmReport& r, const Pose& T) {
  const AngleAxisPose a = angle_axis_from_pose(T);
  std::ranges::copy(a, r.T_0E.begin());
}

FailureReason failure(int m, X x) {
  x.c.coordination.m = m;
  return row(m).f_cc(x).failure;
}

TEST(RubikCoordinator, TheCubeIsLostWhenTheHandThatMustHoldItHoldsNothing) {
  for (int m = 1; m <= 6; ++m)
    for (const std::size_t arm : {kP, kT}) {
      X x = image();
      x.T.agent[arm].gripper = x.c.k.held;
      EXPECT_EQ(failure(m, x), FailureReason::none) << m << " at the bound";
      x.T.agent[arm].gripper = x.c.k.held - 1e-6;
      const bool holds = m == 6 ? arm == kP : arm == kT || m == 5;
      const bool closes = !holds && (m == 3 || m == 4);
      EXPECT_EQ(failure(m, x), holds    ? FailureReason::dropped
                               : closes ? FailureReason::missed
                                        : FailureReason::none)
          << m << " arm " << arm;
      x.T.agent[arm].ready = false;
      EXPECT_EQ(failure(m, x), FailureReason::none) << "an arm that is not ready tells nothing of its jaws";
    }
}

TEST(RubikCoordinator, WhatLastsTooLongIsTheFailureOfItsBehaviour) {
  const std::array<FailureReason, 6> late{FailureReason::no_contact, FailureReason::none,
                                          FailureReason::missed,     FailureReason::missed,
                                          FailureReason::none,       FailureReason::not_released};
  for (int m = 1; m <= 6; ++m) {
    const Parameters k;
    EXPECT_EQ(failure(m, image(k.timeout - 1)), FailureReason::none) << m;
    EXPECT_EQ(failure(m, image(k.timeout)), late[static_cast<std::size_t>(m - 1)]) << m;
  }
}

TEST(RubikCoordinator, AFaceJamsWhenItMakesNoProgressForSoLong) {
  X x = image(200);
  x.c.last_progress = x.i - x.c.k.stall + 1;
  EXPECT_EQ(failure(5, x), FailureReason::none);
  --x.c.last_progress;
  EXPECT_EQ(failure(5, x), FailureReason::jammed);
  for (const int m : {1, 2, 3, 4, 6}) EXPECT_EQ(failure(m, x), FailureReason::none) << m;
}

TEST(RubikCoordinator, ProgressIsATurnOfTheTrackArmByItsShareEitherWay) {
  const Pose begun{rotation_from_angle_axis({1, -2, 0.5}), {0.3, 1, 1.2}};
  for (const double sign : {1., -1.})
    for (const bool enough : {false, true}) {
      X x = image();
      x.c.begun = begun;
      x.c.last_progress = 900;
      x.c.angle = x.c.last_angle = sign * 0.3;
      const double angle = sign * (0.3 + x.c.k.progress + (enough ? 1e-6 : -1e-6));
      put(x.T.agent[kT], begun * Pose{rotation_from_angle_axis({0, 0, angle}), Vector3::Zero()});
      const auto c = row(5).f_cc(x);
      EXPECT_NEAR(c.angle, angle, 1e-9);
      EXPECT_NEAR(c.last_angle, enough ? angle : sign * 0.3, 1e-9);
      EXPECT_EQ(c.last_progress, enough ? x.i : 900);
      EXPECT_EQ(c.travelled, 0);
    }
}

/// @param took  macrosteps since the last progress @param progress  the face makes some now
/// @return F_d of the next order, after `torque`
double next_torque(double torque, std::int64_t took, bool progress, double most = 8) {
  X x = image(300);
  x.c.k.most_torque = most;
  x.c.cycle.turn.torque = torque;
  x.c.last_progress = x.i - took;
  put(x.T.agent[kT],
      Pose{rotation_from_angle_axis({0, 0, progress ? 1.1 * x.c.k.progress : 0}), Vector3::Zero()});
  x.c = row(5).f_cc(x);
  return row(5).f_cT(x)[kT].cube.turn.torque;
}

TEST(RubikCoordinator, TheTorqueGrowsWhileAFaceIsSlowAndFallsAgainWhenItIsFast) {
  for (const double sign : {1., -1.}) {
    EXPECT_EQ(next_torque(sign * 5, 7, false), sign * 5) << "not yet slow";
    EXPECT_GT(sign * next_torque(sign * 5, 8, false), 5);
    EXPECT_EQ(next_torque(sign * 5, 8, true), sign * 5) << "it goes on";
    EXPECT_EQ(next_torque(sign * 5, 3, true), sign * 5) << "as fast as usual";
    EXPECT_LT(sign * next_torque(sign * 5, 2, true), 5);
    EXPECT_EQ(next_torque(sign * 7.99, 99, false), sign * 8) << "no farther than this";
    EXPECT_EQ(next_torque(sign * Parameters{}.torque, 1, true), sign * Parameters{}.torque)
        << "nor less than usual";
    EXPECT_EQ(next_torque(sign * 4, 99, false, 3), sign * 4) << "the usual torque counts, where it is more";
  }
  EXPECT_EQ(next_torque(0, 99, false), 0) << "a re-grasp turns nothing";
}

TEST(RubikCoordinator, TheTorqueHasGrownToItsMostLongBeforeAFaceCountsAsJammed) {
  X x = image(0);
  x.c.k.most_torque = 8.5;
  x.c.cycle.turn.torque = x.c.k.torque;
  std::int64_t grown = 0;
  for (x.c.failure = FailureReason::none; x.c.failure == FailureReason::none; ++x.i) {
    x.c = row(5).f_cc(x);
    if (grown == 0 && x.c.cycle.turn.torque == 8.5) grown = x.i - x.i_0;
  }
  EXPECT_EQ(x.c.failure, FailureReason::jammed);
  EXPECT_GT(grown, 0);
  EXPECT_LT(grown, x.c.k.stall / 2);
}

TEST(RubikCoordinator, TheDistanceOfTheWorkerIsAlongItsOwnZFromWhereItBegan) {
  const Pose begun{rotation_from_angle_axis({1, -2, 0.5}), {0.3, 1, 1.2}};
  for (const double distance : {-0.01, 0.004, 0.0149}) {
    X x = image();
    x.c.begun = begun;
    put(x.T.agent[kP], begun * Pose{rotation_from_angle_axis({0, 0, 0.2}), {0.05, -0.02, distance}});
    const auto c = row(1).f_cc(x);
    EXPECT_NEAR(c.travelled, distance, 1e-9);
    EXPECT_EQ(c.angle, 0);
    EXPECT_EQ(row(2).f_cc(x).travelled, 0) << "of the approach alone";
  }
}

TEST(RubikCoordinator, TheWorkerMeetsTheCubeWhereItShouldBeOrItHasSlipped) {
  const auto meets = [](double off, bool contact) {
    X x = image();
    put(x.T.agent[kP], {Matrix3::Identity(), {0, 0, kApproachDistance + off}});
    if (contact) x.T.agent[kP].event = 1;
    return row(1).f_cc(x).failure;
  };
  const double slip = Parameters{}.slip;
  EXPECT_EQ(meets(slip - 1e-6, true), FailureReason::none);
  EXPECT_EQ(meets(1e-6 - slip, true), FailureReason::none);
  EXPECT_EQ(meets(slip + 1e-6, true), FailureReason::elsewhere);
  EXPECT_EQ(meets(-1e-6 - slip, true), FailureReason::elsewhere);
  EXPECT_EQ(meets(slip - 1e-6, false), FailureReason::none);
  EXPECT_EQ(meets(-1e-6 - slip, false), FailureReason::none) << "it is still on its way";
  EXPECT_EQ(meets(slip + 1e-6, false), FailureReason::no_contact) << "it has gone too far";
}

TEST(RubikCoordinator, ABehaviourBeginsWhereItsActorIs) {
  for (int m = 1; m <= 6; ++m)
    for (const Hand leaves : {Hand::postument, Hand::track}) {
      X x = image();
      x.c.cycle.leaves = leaves;
      put(x.T.agent[kP], {Matrix3::Identity(), {1, 0, 0}});
      put(x.T.agent[kT], {Matrix3::Identity(), {2, 0, 0}});
      x.c.angle = x.c.last_angle = 7;
      x.c.last_progress = 3;
      const auto c = row(m).f_entry(x);
      const bool track = m == 5 || (m == 6 && leaves == Hand::track);
      EXPECT_EQ(c.begun.p.x(), track ? 2 : 1) << m;
      EXPECT_EQ(c.angle, 0);
      EXPECT_EQ(c.last_angle, 0);
      EXPECT_EQ(c.last_progress, x.i);
    }
}

TEST(RubikCoordinator, ABehaviourEndsWithItsEventOrWithAFailure) {
  for (int m = 1; m <= 6; ++m) {
    X x = image();
    x.c.coordination.m = m;
    EXPECT_FALSE(row(m).f_tau(x));
    x.c.failure = FailureReason::missed;
    EXPECT_TRUE(row(m).f_tau(x));
    x.c.failure = FailureReason::none;
    x.T.agent[kP].event = m;
    x.c = row(m).f_cc(x);
    EXPECT_EQ(x.c.coordination.m, m + 1);
    EXPECT_TRUE(row(m).f_tau(x));
  }
}

TEST(RubikCoordinator, InACycleOneArmActsAndBothGetTheTurnAndThePaceOfTheJaws) {
  for (int m = 1; m <= 6; ++m)
    for (const Hand comes : kHands) {
      X x = image();
      x.c.coordination = {.m = m, .go_on = {m % 2 == 0, m % 2 == 1}};
      x.c.cycle = {.holds = other(comes),
                   .comes = comes,
                   .leaves = other(comes),
                   .turn = {.torque = -3, .mobility = 0.2, .angle = 1}};
      const auto orders = row(m).f_cT(x);
      const Hand actor = m <= 4 ? comes : m == 5 ? Hand::track : other(comes);
      for (const Hand hand : kHands) {
        const ArmOrder& o = orders[index(hand)];
        EXPECT_EQ(o.m, m);
        EXPECT_EQ(o.go_on, x.c.coordination.go_on);
        EXPECT_EQ(o.variant, hand == actor ? kActs : kStands) << m;
        EXPECT_EQ(o.cube.turn.torque, -3);
        EXPECT_EQ(o.cube.turn.angle, 1);
        EXPECT_EQ(o.cube.jaw_step, m == 6 ? x.c.k.opening_step : m == 4 ? x.c.k.grip_step : x.c.k.jaw_step);
      }
    }
}

JointPath path_of(int points, double jaws = 0) {
  JointPath path;
  path.jaws = jaws;
  for (int k = 1; k <= points; ++k) path.add(AxisVector::Constant(6, k), 0.5);
  return path;
}

TEST(RubikCoordinator, PointsAreToldOneAfterAnotherAndThenThoseThatAreMissing) {
  X x = image();
  x.c.joint_paths = {path_of(3, 0.06), JointPath{}};
  x.c.next = {2, 2};
  x.c = kSendPath.f_entry(x);
  std::vector<int> told;
  for (int k = 0; k < 8; ++k) {
    const auto orders = kSendPath.f_cT(x);
    EXPECT_EQ(orders[kP].m, kTakePath);
    EXPECT_EQ(orders[kP].cube.jaws, 0.06);
    EXPECT_EQ(orders[kP].cube.point.motors[0], orders[kP].variant + 1);
    EXPECT_EQ(orders[kT].m, kWait) << "nothing to tell it";
    told.push_back(orders[kP].variant);
    x.T.agent[kP].cube.points = k < 5 ? 1 : 7;
    x.c = kSendPath.f_cc(x);
  }
  EXPECT_EQ(told, (std::vector{0, 1, 2, 1, 2, 1, 2, 2}));
}

TEST(RubikCoordinator, APathWithoutPointsIsToldByItsJaws) {
  X x = image();
  x.c.joint_paths[kT].jaws = 0.07;
  x.c = kSendPath.f_entry(x);
  for (int k = 0; k < 3; ++k) {
    const auto orders = kSendPath.f_cT(x);
    EXPECT_EQ(orders[kT].m, kTakePath);
    EXPECT_EQ(orders[kT].variant, -1);
    EXPECT_EQ(orders[kT].cube.jaws, 0.07);
    EXPECT_EQ(orders[kP].m, kWait);
    x.c = kSendPath.f_cc(x);
    EXPECT_EQ(x.c.next[kT], 0);
  }
}

TEST(RubikCoordinator, PathsAreKnownWhenBothArmsTellSoAndTheirReportsAreNew) {
  X x = image(4);
  x.c.joint_paths = {path_of(3), path_of(2)};
  x.T.agent[kP].cube.points = 3;
  x.T.agent[kT].cube.points = 2;
  EXPECT_TRUE(kSendPath.f_tau(x));
  for (const std::size_t arm : {kP, kT}) {
    X y = x;
    --y.T.agent[arm].cube.points;
    EXPECT_FALSE(kSendPath.f_tau(y)) << arm;
    y.c.joint_paths[arm] = {};
    EXPECT_TRUE(kSendPath.f_tau(y)) << "it has none";
  }
  --x.i;
  EXPECT_FALSE(kSendPath.f_tau(x)) << "the reports may be about the paths before";
}

TEST(RubikCoordinator, EachArmSetsOutInItsMacrostepAndStaysWithoutOne) {
  for (const bool jaws : {false, true}) {
    X x = image(4);
    x.c.goes_at = {0, 5};
    x.c.jaws_too = jaws;
    EXPECT_EQ(kMoveAlong.f_cT(x)[kP].m, kGo);
    EXPECT_EQ(kMoveAlong.f_cT(x)[kP].variant, jaws ? kActs : kStands);
    EXPECT_EQ(kMoveAlong.f_cT(x)[kT].m, kWait);
    ++x.i;
    EXPECT_EQ(kMoveAlong.f_cT(x)[kT].m, kGo);
    x.c.goes_at = {-1, -1};
    for (const ArmOrder& o : kMoveAlong.f_cT(x)) EXPECT_EQ(o.m, kWait);
  }
}

TEST(RubikCoordinator, ArmsHaveArrivedWhenAllThatGoTellSoInNewReports) {
  X x = image(9);
  x.c.goes_at = {0, 5};
  for (ArmReport& r : x.T.agent) r.event = kGo;
  EXPECT_TRUE(kMoveAlong.f_tau(x));
  --x.i;
  EXPECT_FALSE(kMoveAlong.f_tau(x)) << "the second has just set out";
  ++x.i;
  for (const std::size_t arm : {kP, kT}) {
    X y = x;
    y.T.agent[arm].event = 0;
    EXPECT_FALSE(kMoveAlong.f_tau(y));
    y.c.failure = FailureReason::dropped;
    EXPECT_TRUE(kMoveAlong.f_tau(y));
    y.c.failure = FailureReason::none;
    y.c.goes_at[arm] = -1;
    EXPECT_TRUE(kMoveAlong.f_tau(y)) << "it does not go";
  }
}

TEST(RubikCoordinator, OnThePathTheLoadedHandIsWatched) {
  for (const std::size_t arm : {kP, kT}) {
    X x = image();
    x.T.agent[arm].gripper = 0.05;
    EXPECT_EQ(kMoveAlong.f_cc(x).failure, FailureReason::none) << "it has no cube";
    x.c.loaded[arm] = true;
    EXPECT_EQ(kMoveAlong.f_cc(x).failure, FailureReason::dropped);
    x.T.agent[arm].gripper = 0.057;
    EXPECT_EQ(kMoveAlong.f_cc(x).failure, FailureReason::none);
  }
}

TEST(RubikCoordinator, EveryHandIsWeighedWithWhatHangsOnIt) {
  X x = image(4);
  for (std::size_t arm = 0; arm < kArms; ++arm)
    for (std::size_t cube = 0; cube < 2; ++cube) {
      const double n = 1 + 2. * static_cast<double>(arm) + static_cast<double>(cube);
      x.c.k.load[arm][cube] = {n, {n, 10 * n, 100 * n}};
    }
  x.c.loaded = {false, true};
  const auto orders = kWeighBoth.f_cT(x);
  for (const auto& [arm, n] : {std::pair{kP, 1.}, {kT, 4.}}) {
    EXPECT_EQ(orders[arm].m, kWeigh);
    EXPECT_EQ(orders[arm].cube.weight, n);
    EXPECT_EQ(orders[arm].cube.mass_centre, (std::array{n, 10 * n, 100 * n}));
  }
  for (ArmReport& r : x.T.agent) r.event = kWeigh;
  EXPECT_TRUE(kWeighBoth.f_tau(x));
  for (const std::size_t arm : {kP, kT}) {
    X y = x;
    y.T.agent[arm].event = kGo;
    EXPECT_FALSE(kWeighBoth.f_tau(y));
  }
  --x.i;
  EXPECT_FALSE(kWeighBoth.f_tau(x));
}

TEST(RubikCoordinator, WhatIsBrokenOffIsOverWhenBothArmsRest) {
  for (const DriverState a : {DriverState::holding, DriverState::ready, DriverState::executing})
    for (const DriverState b : {DriverState::holding, DriverState::ready, DriverState::decelerating}) {
      X x = image(4);
      x.T.agent[kP].driver_state = a;
      x.T.agent[kT].driver_state = b;
      EXPECT_EQ(kStopBoth.f_tau(x), a != DriverState::executing && b != DriverState::decelerating);
      --x.i;
      EXPECT_FALSE(kStopBoth.f_tau(x));
    }
  for (const ArmOrder& o : kStopBoth.f_cT(image())) EXPECT_EQ(o.m, kWait);
}

TEST(RubikCoordinator, StartsWhenBothArmsAreReadyAndTheOperatorSaysSo) {
  X x = image();
  x.T.h.started = true;
  EXPECT_TRUE(kWaitForStart.f_tau(x));
  for (const std::size_t arm : {kP, kT}) {
    X y = x;
    y.T.agent[arm].ready = false;
    EXPECT_FALSE(kWaitForStart.f_tau(y));
  }
  x.T.h.started = false;
  EXPECT_FALSE(kWaitForStart.f_tau(x));
}

TEST(RubikCoordinator, APauseIsOverWhenTheOperatorEndsItAndThinkingAfterItsTime) {
  X x = image(kThinking - 1);
  x.t.paused = true;
  EXPECT_FALSE(kResume.f_tau(x));
  x.t.paused = false;
  EXPECT_TRUE(kResume.f_tau(x));
  EXPECT_FALSE(kThink.f_tau(x));
  ++x.i;
  EXPECT_TRUE(kThink.f_tau(x));
}

// Half a second of rest before the picture, of ten steps a macrostep; after two seconds any picture will do.
TEST(RubikCoordinator, APictureCountsWhenItWasTakenAtRestAndShowsTheFaceOrWhenThereIsNoBetterOne) {
  X x = image(30);
  x.V.there = x.V.reading.valid = true;
  x.V.reading.step = (1000 + 25) * 10;
  EXPECT_TRUE(kLook.f_tau(x));
  --x.V.reading.step;
  EXPECT_FALSE(kLook.f_tau(x)) << "the arms still moved";
  ++x.V.reading.step;
  x.V.there = false;
  EXPECT_FALSE(kLook.f_tau(x));
  x.V.there = true;
  x.V.reading.valid = false;
  EXPECT_FALSE(kLook.f_tau(x));
  x.i = 1099;
  EXPECT_FALSE(kLook.f_tau(x));
  ++x.i;
  EXPECT_TRUE(kLook.f_tau(x)) << "two seconds are over";
  x.c.shown.face = 3;
  EXPECT_EQ(kLook.f_cV(x).face, 3);
  EXPECT_NE(kThink.f_cV(x).face, 3) << "only who looks tells what at";
}

TEST(RubikCoordinator, EveryFailureReasonHasAnotherName) {
  std::set<std::string> names;
  for (int k = 0; k <= static_cast<int>(FailureReason::dropped); ++k)
    names.insert(to_string(static_cast<FailureReason>(k)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(FailureReason::dropped) + 1);
  EXPECT_FALSE(names.contains("?"));
}

}  // namespace
}  // namespace mrroc::rubik
