// Poses of hands that grip a cube where the arms meet.
#include "tasks/rubik/plan/grips.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace mrroc::rubik {
namespace {

constexpr double kNear = 1e-12;

Meeting somewhere() {
  return {.T_UM = {rotation_from_angle_axis({0.3, -1.2, 0.7}), {0.4, 1.1, 0.9}}, .joints = {}};
}
Vector3 axis(const Pose& T_UE, int k) { return T_UE.R.col(k); }

TEST(Grips, PalmsInFrontFaceEachOtherAcrossTheCube) {
  const Meeting meeting = somewhere();
  for (const Hand hand : kHands) {
    const Pose grip = front_grip(meeting, hand);
    EXPECT_TRUE(is_proper(grip));
    EXPECT_LT((grip * Vector3(0, 0, depth(hand)) - meeting.T_UM.p).norm(), kNear);
  }
  EXPECT_NEAR(axis(front_grip(meeting, Hand::track), 2).dot(axis(front_grip(meeting, Hand::postument), 2)),
              -1, kNear);
}

TEST(Grips, AHandFromTheSideComesAcrossTheAxisOfTheOneThatOffers) {
  const Meeting meeting = somewhere();
  for (const Hand comes : kHands)
    for (double angle = 0; angle < 2 * std::numbers::pi; angle += 0.1) {
      const SideGrip grip = side_grip(meeting, comes, angle);
      EXPECT_TRUE(is_proper(grip.comes) && is_proper(grip.offers));
      EXPECT_LT((axis(grip.offers, 2) - axis(front_grip(meeting, other(comes)), 2)).norm(), kNear);
      const Vector3 direction(std::cos(angle), std::sin(angle), 0);
      EXPECT_LT((axis(grip.comes, 2) - meeting.T_UM.R * direction).norm(), kNear);
      EXPECT_LT((grip.comes * Vector3(0, 0, depth(comes)) - meeting.T_UM.p).norm(), kNear);
      EXPECT_LT((grip.offers * Vector3(0, 0, depth(other(comes))) - meeting.T_UM.p).norm(), kNear);
    }
}

TEST(Grips, TheFingersOfTheTrackArmLieBesideBothHands) {
  for (const Hand comes : kHands) {
    const SideGrip grip = side_grip(somewhere(), comes, 0.4);
    const Pose& track = comes == Hand::track ? grip.comes : grip.offers;
    const Pose& postument = comes == Hand::track ? grip.offers : grip.comes;
    EXPECT_NEAR(axis(track, 1).dot(axis(postument, 2)), 0, kNear);
    EXPECT_NEAR(std::abs(axis(postument, 1).dot(axis(track, 2))), 1, kNear)
        << "before and behind the palm of the track arm";
  }
}

TEST(Grips, OnlyATrackGivesAnArmSeveralPlaces) {
  const AxisVector fixed = AxisVector::Constant(6, 0.5), moved = AxisVector::Constant(7, 0.5);
  ASSERT_EQ(along_track(fixed).size(), 1U);
  EXPECT_EQ(along_track(fixed).front(), fixed);
  const auto places = along_track(moved);
  EXPECT_NEAR(places.front()[0], -0.1, kNear);
  EXPECT_NEAR(places.back()[0], 1.1, kNear);
  for (const AxisVector& place : places) EXPECT_EQ(place.tail(6), moved.tail(6));
}

}  // namespace
}  // namespace mrroc::rubik
