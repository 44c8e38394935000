// Transmission of the two-jaw gripper.
#include <gtest/gtest.h>

#include <cmath>

#include "robots/gripper/jaws.hpp"

namespace mrroc::gripper {
namespace {

TEST(JawTransmission, RoundTripsOverTheWholeRangeOfTheMotor) {
  for (double m = kOpenStop; m <= kClosedStop; m += 1) EXPECT_NEAR(motor(distance(m)), m, 1e-6);
}

TEST(JawTransmission, AgreesWithTheInverseAsTheOriginalPrintsIt) {
  for (double j = 0.053; j < 0.091; j += 0.0005)
    EXPECT_NEAR(motor(j), 0.3531946456e-5 * std::sqrt(0.2622172716e19 - 0.28313e20 * j) - 2564.03432, 0.02)
        << j;
}

TEST(JawTransmission, JawsCloseWhileTheMotorTurnsForward) {
  for (double m = kOpenStop; m < kClosedStop; m += 10) {
    EXPECT_LT(distance(m + 1), distance(m));
    EXPECT_NEAR(slope(m), (distance(m + 1e-3) - distance(m - 1e-3)) / 2e-3, 1e-9);
  }
}

TEST(JawTransmission, DistancesBeyondTheDeadCentreAreNeverNotANumber) {
  EXPECT_EQ(motor(1), kDeadCentre);
  EXPECT_EQ(distance(-1e6), distance(kDeadCentre));
}

TEST(JawTransmission, LegalDistancesLieBetweenTheStops) {
  const edp::GripperParameters p = two_jaw();
  EXPECT_GT(p.legal.lower, distance(kClosedStop));
  EXPECT_LT(p.legal.upper, distance(kOpenStop));
  EXPECT_FALSE(edp::check_distance(p, 0));
  EXPECT_FALSE(edp::check_distance(p, 0.07));
  for (const double wrong : {0.05, 0.1, -0.07, std::nan("")})
    EXPECT_EQ(edp::check_distance(p, wrong)->code, FaultCode::out_of_limits);
}

}  // namespace
}  // namespace mrroc::gripper
