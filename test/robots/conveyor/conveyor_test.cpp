// The kernel of the conveyor by value: gear, ranges, the line of its poses.
#include "robots/conveyor/conveyor.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mrroc::conveyor {
namespace {

AxisVector at(double way) { return AxisVector::Constant(1, way); }

TEST(Conveyor, TurnsTheMotorBy2250RadiansPerMetre) {
  const Conveyor belt;
  EXPECT_NEAR(belt.motors_from_joints(at(0.3))[0] - belt.motors_from_joints(at(-0.7))[0], 2250, 1e-9);
}

TEST(Conveyor, MovesItsSheetAlongYOfTheWorldAtTheHeightOfTheBelt) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<> way(-1, 1);
  const Conveyor belt;
  for (int k = 0; k < 100; ++k) {
    const double y = way(random);
    const Pose T_UE = type().T_UB * belt.forward(at(y));
    EXPECT_LT((T_UE.p - Vector3(0.90, y, 0.9064)).norm(), 1e-12);
    EXPECT_LT((T_UE.R.col(1) + Vector3::UnitY()).norm(), 1e-12) << "y of E is -y of the world, as in an arm";
  }
}

TEST(Conveyor, WhatIsOffItsLineOrTurnedIsOutOfReach) {
  const Conveyor belt;
  const Pose T = belt.forward(at(0.2));
  EXPECT_TRUE(belt.inverse(T, at(0)).reached);
  EXPECT_NEAR(belt.inverse(T, at(0)).joints[0], 0.2, 1e-12);
  for (const Vector3& off : {Vector3(1e-3, 0, 0), Vector3(0, 0, -1e-3)}) {
    const auto s = belt.inverse({T.R, T.p + off}, at(0));
    EXPECT_FALSE(s.reached);
    EXPECT_NEAR(s.missing, 1e-3, 1e-12);
  }
  EXPECT_FALSE(
      belt.inverse(T * pose_from_angle_axis((AngleAxisPose() << 0, 0, 0, 0.01, 0, 0).finished()), at(0))
          .reached);
}

TEST(Conveyor, BothSheetsStayOnTheBeltOverItsWholeRange) {
  constexpr double kHalfSheet = 0.15;
  constexpr double kSecondArm = 2.1;
  const double middle = type().T_UB.p.y() + kMiddle.y();
  for (const double sheet : {0.0, kSecondArm}) {
    EXPECT_GT(sheet - kHalfSheet, middle - kLength / 2 + kWay);
    EXPECT_LT(sheet + kHalfSheet, middle + kLength / 2 - kWay);
  }
  EXPECT_NEAR(kAxis.motor.lower, kGear * (kAxis.joint.lower - kZero), 1e-9);
  EXPECT_NEAR(kAxis.motor.upper, kGear * (kAxis.joint.upper - kZero), 1e-9);
}

}  // namespace
}  // namespace mrroc::conveyor
