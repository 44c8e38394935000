// Behaviours and predicates of a turn by value: tables 4-8 and (66)-(77) of MG.
#include "tasks/rubik/turn/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mrroc::rubik {
namespace {

using X = Arm::X;
using std::numbers::pi;

X at(double angle_about_z, const Pose& T_0E = {}) {
  X x;
  const Pose T = T_0E * Pose{rotation_from_angle_axis({0, 0, angle_about_z}), Vector3::Zero()};
  const AngleAxisPose r = angle_axis_from_pose(T);
  std::ranges::copy(r, x.e.T_0E.begin());
  return x;
}

/// What rows command for an image.
EffectorCommand commanded(const std::array<Motion<Arm>, 6>& rows, int m, const X& x = {}) {
  return rows[static_cast<std::size_t>(m - 1)].f_ce(x);
}

TEST(RubikTables, TheWorkerApproachesGuardedAndSettlesAt4N) {
  for (const int m : {1, 2}) {
    const EffectorCommand y = commanded(kWorker, m);
    EXPECT_EQ(y.arm.frame.z, g(0.01, 5, 0.0025));
    EXPECT_EQ(y.arm.frame.y, u());
    EXPECT_EQ(y.arm.gripper, 0) << "the jaws stay";
    EXPECT_EQ(y.arm.mu, Interpolation::tcim_velocity);
    EXPECT_EQ(y.arm.n_Q, y.arm.n_s - 1);
  }
  EXPECT_DOUBLE_EQ(kApproach.z.velocity / kApproach.z.mobility, 4);
}

TEST(RubikTables, ThresholdsAreThoseOfThePaper) {
  EXPECT_EQ(kNarrow, 0.06) << "(71)";
  EXPECT_EQ(kRelease, 0.02) << "(77)";
  EXPECT_NEAR(static_cast<double>(kSettling) * kPacing.macrostep_s(), 0.5, 1e-12) << "(69)";
  EXPECT_NEAR(kApproachForce, 0.9 * kApproach.z.velocity / kApproach.z.mobility, 1e-12)
      << "(66), nearly where the force of the guarded motion settles";
  EXPECT_FALSE(nothing({})) << "who only holds sees no event of his own";
}

TEST(RubikTables, TheWorkerClosesCompliantAlongYThenAlongXAndY) {
  X x;
  x.e.gripper = 0.07;
  EffectorCommand y = commanded(kWorker, 3, x);
  EXPECT_EQ(y.arm.frame.y, c(0, 20, 0.005));
  EXPECT_EQ(y.arm.frame.x, u());
  EXPECT_DOUBLE_EQ(y.arm.gripper, 0.069);
  y = commanded(kWorker, 4, x);
  EXPECT_EQ(y.arm.frame.x, c(0, 20, 0.005));
  EXPECT_EQ(y.arm.frame.y, c(0, 20, 0.005));
  x.e.gripper = 0.0535;
  EXPECT_EQ(commanded(kWorker, 4, x).arm.gripper, kClosest) << "never beyond the stops";
}

TEST(RubikTables, TheHolderTurnsWithTheOrdersTorqueAndNoForceElsewhere) {
  X x;
  EXPECT_EQ(commanded(kHolder, 5, x).arm.frame, kTurn) << "without an order: the table";
  x.c.turn = {.torque = -5, .mobility = 0.1};
  x.c.mobility = 0.1;
  const TaskFrameCommand frame = commanded(kHolder, 5, x).arm.frame;
  EXPECT_EQ(frame.az, c(-5, 0.5, 0.1));
  for (const Axis a : {Axis::x, Axis::y, Axis::z}) EXPECT_EQ(frame[a], c(0, 20, 0.005));
  for (const Axis a : {Axis::ax, Axis::ay}) EXPECT_EQ(frame[a], u());
}

TEST(RubikTables, AFaceThatStandsIsTurnedWithLittleMobilityAndOneThatTurnsWithTheOrders) {
  X x;
  x.T.cube.turn = {.torque = -4, .mobility = 0.1, .angle = 1.5};
  x.c = begin_turn(x);
  const double little = x.c.mobility;
  EXPECT_NEAR(little, kOfStanding * 0.1, 1e-12);
  for (int k = 0; k < 40; ++k) {
    const double before = x.c.mobility;
    x.c = track_turn(x);
    EXPECT_LE(x.c.mobility, std::min(0.1, kQuicken * before) + 1e-12);
  }
  EXPECT_DOUBLE_EQ(x.c.mobility, 0.1);
  x.e.F_a[Axis::az] = -0.8 * 4;
  EXPECT_DOUBLE_EQ(track_turn(x).mobility, little) << "at once";
  x.T.cube.turn = {.torque = 5, .mobility = 0.025, .angle = 1.5};
  x.c = begin_turn(x);
  EXPECT_DOUBLE_EQ(x.c.mobility, 0.025) << "tab. 7 is as printed";
  EXPECT_DOUBLE_EQ(track_turn(x).mobility, 0.025);
}

TEST(RubikTables, TheHolderOpensStandingStill) {
  X x;
  x.e.gripper = 0.057;
  const EffectorCommand y = commanded(kHolder, 6, x);
  EXPECT_EQ(y.arm.frame, kStill);
  EXPECT_DOUBLE_EQ(y.arm.gripper, 0.058);
}

TEST(RubikTables, OneArmActsWhileTheOtherStands) {
  for (int m = 1; m <= 6; ++m) {
    const auto& still = m <= 4 ? kHolder : kWorker;
    EXPECT_EQ(commanded(still, m).arm.frame, kStill) << m;
    EXPECT_EQ(commanded(still, m).arm.gripper, 0) << m;
    EXPECT_EQ(kWorker[static_cast<std::size_t>(m - 1)].m, m);
    EXPECT_EQ(kHolder[static_cast<std::size_t>(m - 1)].m, m);
  }
}

TEST(RubikTables, EachEventIsTaggedWithItsBehaviourAndSeenByOneArm) {
  X x = at(2);
  x.e.F_a[Axis::z] = 10;
  x.e.gripper = 0.058;
  x.e.blocked = true;
  x.i = 1000;
  x.c.gap = 0.03;
  for (int m = 1; m <= 6; ++m) {
    const auto k = static_cast<std::size_t>(m - 1);
    EXPECT_EQ(kWorker[k].f_cT(x).event, m <= 4 ? m : 0);
    EXPECT_EQ(kHolder[k].f_cT(x).event, m >= 5 ? m : 0);
    EXPECT_EQ(kWorker[k].f_cT({}).event, m == 3 ? 3 : 0) << "jaws that read zero are narrow";
    EXPECT_EQ(kHolder[k].f_cT({}).event, 0);
  }
}

TEST(RubikTables, OddBehavioursEndByElement1EvenOnesByElement2) {
  for (int m = 1; m <= 6; ++m)
    for (const auto* rows : {&kWorker, &kHolder}) {
      X x;
      const auto& row = (*rows)[static_cast<std::size_t>(m - 1)];
      EXPECT_FALSE(row.f_tau(x));
      x.T.go_on[m % 2 == 1 ? 1 : 0] = true;
      EXPECT_FALSE(row.f_tau(x)) << m;
      x.T.go_on = {m % 2 == 1, m % 2 == 0};
      EXPECT_TRUE(row.f_tau(x)) << m;
    }
}

TEST(RubikPredicates, ContactIsNineTenthsOfTheForceAtWhichTheApproachSettles) {
  X x;
  x.e.F_a[Axis::z] = 3.59;
  EXPECT_FALSE(pushing(x));
  x.e.F_a[Axis::z] = 3.61;
  EXPECT_TRUE(pushing(x));
}

TEST(RubikPredicates, SettlingCountsFromEntry) {
  X x;
  x.i_0 = 100;
  x.i = 100 + kSettling - 1;
  EXPECT_FALSE(settled(x));
  ++x.i;
  EXPECT_TRUE(settled(x));
}

TEST(RubikPredicates, ReleaseCountsFromTheDistanceAtEntry) {
  X x;
  x.e.gripper = 0.0568;
  x.c = keep_gap(x);
  EXPECT_FALSE(released(x));
  x.e.gripper = 0.0767;
  EXPECT_FALSE(released(x));
  x.e.gripper = 0.0769;
  EXPECT_TRUE(released(x));
}

TEST(RubikPredicates, TheAngleIsSignedAndUnwrappedFromAnyOrientation) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int k = 0; k < 50; ++k) {
    const Pose start{rotation_from_angle_axis({number(random), number(random), number(random)}),
                     {0.3, 1, 1.2}};
    for (const double sign : {1., -1.}) {
      X x = at(0, start);
      x.c.turn = {.torque = 5 * sign, .angle = 2 * pi + 0.5};
      x.c = keep_pose(x);
      for (double angle = 0; angle < 7.2; angle += 0.1) {
        x.e = at(sign * angle, start).e;
        const bool done = turned(x);
        EXPECT_EQ(done, angle >= x.c.turn.angle - 1e-9) << angle;
        x.c = track_angle(x);
        EXPECT_NEAR(x.c.angle, sign * angle, 1e-9);
      }
    }
  }
}

TEST(RubikPredicates, ATurnTheWrongWayDoesNotEnd) {
  X x = at(0);
  x.c.turn = {.torque = 5};
  x.c = keep_pose(x);
  x.e = at(-1.7).e;
  EXPECT_FALSE(turned(x));
}

TEST(RubikTables, JawsGoAsFastAsIsOrderedWhereTheyMoveAndNoFartherThanTheyGo) {
  X x;
  x.e.gripper = 0.07;
  x.T.cube.jaw_step = 0.003;
  for (const int m : {3, 4}) EXPECT_DOUBLE_EQ(commanded(kWorker, m, x).arm.gripper, 0.067);
  EXPECT_DOUBLE_EQ(commanded(kHolder, 6, x).arm.gripper, 0.073);
  for (const int m : {1, 2, 5, 6}) EXPECT_EQ(commanded(kWorker, m, x).arm.gripper, 0) << m;
  for (const int m : {1, 2, 3, 4, 5}) EXPECT_EQ(commanded(kHolder, m, x).arm.gripper, 0) << m;
  x.e.gripper = 0.0885;
  EXPECT_EQ(commanded(kHolder, 6, x).arm.gripper, kWidest);
  x.e.gripper = 0.0545;
  EXPECT_EQ(commanded(kWorker, 3, x).arm.gripper, kClosest);
}

TEST(RubikTables, TheLeastMobilityIsTheTablesOrAShareOfTheOrders) {
  const auto least = [](double ordered) {
    X x;
    x.T.cube.turn.mobility = ordered;
    return begin_turn(x).mobility;
  };
  EXPECT_DOUBLE_EQ(least(0.2), 0.4 * 0.2);
  EXPECT_DOUBLE_EQ(least(0.05), 0.025) << "a share of it would be less";
  EXPECT_DOUBLE_EQ(least(0.01), 0.01) << "never above what is ordered";
}

TEST(RubikTables, MobilityGrowsByATenthUntilTheFaceResistsEitherWay) {
  for (const double torque : {4., -4.}) {
    X x;
    x.T.cube.turn = {.torque = torque, .mobility = 0.1, .angle = 1.5};
    x.c = begin_turn(x);
    for (const double share : {-0.76, -0.74, 0., 0.74, 0.76}) {
      x.c.mobility = 0.06;
      x.e.F_a[Axis::az] = share * torque;
      EXPECT_DOUBLE_EQ(track_turn(x).mobility, std::abs(share) > 0.75 ? 0.04 : 0.066) << share;
    }
    x.c.mobility = 0.095;
    x.e.F_a[Axis::az] = 0;
    EXPECT_DOUBLE_EQ(track_turn(x).mobility, 0.1);
  }
}

TEST(RubikTables, TheHolderTurnsWithTheTorqueThatIsOrderedNow) {
  X x;
  x.T.cube.turn = {.torque = -4, .mobility = 0.1, .angle = 1.5};
  x.c = begin_turn(x);
  x.T.cube.turn.torque = -6;
  x.e.F_a[Axis::az] = 0.7 * 6;
  x.c = kHolder[4].f_cc(x);
  EXPECT_EQ(commanded(kHolder, 5, x).arm.frame.az.force, -6);
  EXPECT_GT(x.c.mobility, kOfStanding * 0.1) << "a share of the torque of now tells whether the face stands";
}

TEST(RubikTables, ATurnBeginsWhereTheArmIsWithWhatIsOrdered) {
  X x = at(0.7, {Matrix3::Identity(), {1, 2, 3}});
  x.c.angle = 9;
  x.T.cube.turn = {.torque = -3, .mobility = 0.05, .angle = 1.2};
  const ArmMemory c = kHolder[4].f_entry(x);
  EXPECT_EQ(c.angle, 0);
  EXPECT_LT((c.T_0E.p - Vector3(1, 2, 3)).norm(), 1e-12);
  EXPECT_NEAR(angle_axis_from_rotation(c.T_0E.R).z(), 0.7, 1e-12);
  EXPECT_EQ(c.turn.torque, -3);
  EXPECT_EQ(c.turn.angle, 1.2);
}

TEST(RubikTables, EveryBehaviourEndsWithTheTaskAndWithAnOrderOfSomethingElse) {
  for (const auto* rows : {&kWorker, &kHolder})
    for (const auto& row : *rows) {
      X x;
      x.T.m = 6;
      EXPECT_FALSE(row.f_tau(x)) << row.name;
      x.T.m = 7;
      EXPECT_TRUE(row.f_tau(x)) << row.name;
      x.T.m = row.m;
      x.T.finished = true;
      EXPECT_TRUE(row.f_tau(x)) << row.name;
    }
}

TEST(RubikPredicates, JawsAreNarrowAtTheirThresholdAndATurnByNothingIsOver) {
  X x;
  x.e.gripper = kNarrow;
  EXPECT_TRUE(narrow(x));
  x.e.gripper = kNarrow + 1e-9;
  EXPECT_FALSE(narrow(x));
  x = at(0);
  x.c = keep_pose(x);
  x.c.turn = {.torque = 0, .angle = -1};
  EXPECT_TRUE(turned(x));
  x.c.turn.angle = 0.1;
  EXPECT_FALSE(turned(x));
}

}  // namespace
}  // namespace mrroc::rubik
