#include "tasks/ball/path.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mrroc::ball {
namespace {

TEST(BallPath, IsContinuousFromTheLiftToThePedestal) {
  const Parameters k;
  EXPECT_LT((path(k, kSqueeze, 0) - path(k, kLift, 0)).norm(), 1e-12);
  EXPECT_LT((path(k, kLift, duration(k, kLift)) - path(k, kWeigh, 0)).norm(), 1e-12);
  EXPECT_LT((path(k, kWeigh, 10) - path(k, kCircle, 0)).norm(), 1e-12);
  EXPECT_LT((path(k, kCircle, duration(k, kCircle)) - path(k, kLower, 0)).norm(), 1e-12);
}

TEST(BallPath, GoesOnceAroundAnUprightCircleAcrossTheLineBetweenThePalms) {
  const Parameters k;
  const Vector3 centre = (k.lift + k.radius) * Vector3::UnitZ();
  double before = 0;
  for (double age = 0; age <= duration(k, kCircle); age += 0.5) {
    const Vector3 p = path(k, kCircle, age);
    EXPECT_NEAR((p - centre).norm(), k.radius, 1e-9);
    EXPECT_NEAR(p.dot(kLine), 0, 1e-12);
    EXPECT_GE(circle_angle(k, age), before);
    EXPECT_LE(circle_angle(k, age) - before, 0.5 * 2 * std::numbers::pi / k.turn + 1e-9)
        << "never faster than a turn takes";
    before = circle_angle(k, age);
  }
  EXPECT_NEAR(before, 2 * std::numbers::pi, 1e-9);
}

TEST(BallPath, StandsBeforeAndAfterABehaviour) {
  const Parameters k;
  for (const int m : {kLift, kCircle, kLower}) {
    EXPECT_EQ(path(k, m, -5), path(k, m, 0));
    EXPECT_LT((path(k, m, duration(k, m) + 5) - path(k, m, duration(k, m))).norm(), 1e-12);
  }
}

TEST(BallPath, HasPalmsThatLookAtEachOther) {
  for (const std::size_t arm : {0U, 1U}) {
    const Matrix3 R = palm_orientation(arm);
    EXPECT_LT((R.transpose() * R - Matrix3::Identity()).norm(), 1e-12);
    EXPECT_NEAR(R.determinant(), 1, 1e-12);
  }
  EXPECT_EQ(palm_orientation(0).col(2), -palm_orientation(1).col(2));
}

}  // namespace
}  // namespace mrroc::ball
