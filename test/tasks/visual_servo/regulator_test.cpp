#include "tasks/visual_servo/regulator.hpp"

#include <gtest/gtest.h>

#include "test/base/random_pose.hpp"

namespace mrroc::visual_servo {
namespace {

using mrroc::test::distance;
using mrroc::test::random_pose;

constexpr double kStep = 0.042;

TEST(Regulator, MakesUpForItsShareOfASmallError) {
  const RegulatorParameters k{.gain = 0.25, .angular_gain = 0.5};
  AngleAxisPose e;
  e << 0.01, -0.004, 0.002, 0.01, 0.02, -0.01;
  const AngleAxisPose r = angle_axis_from_pose(regulate(k, pose_from_angle_axis(e), kStep));
  EXPECT_LT((r.head<3>() - 0.25 * e.head<3>()).norm(), 1e-12);
  EXPECT_LT((r.tail<3>() - 0.5 * e.tail<3>()).norm(), 1e-12);
}

TEST(Regulator, KeepsAxisAndDirectionAndClipsWhatIsTooLong) {
  std::mt19937_64 random(1);
  const RegulatorParameters k;
  for (int n = 0; n < 500; ++n) {
    const AngleAxisPose e = angle_axis_from_pose(random_pose(random));
    const AngleAxisPose r = angle_axis_from_pose(regulate(k, pose_from_angle_axis(e), kStep));
    const double way = r.head<3>().norm(), angle = r.tail<3>().norm();
    EXPECT_NEAR(way, std::min(k.gain * e.head<3>().norm(), k.speed * kStep), 1e-12);
    EXPECT_NEAR(angle, std::min(k.angular_gain * e.tail<3>().norm(), k.angular_speed * kStep), 1e-9);
    EXPECT_NEAR(r.head<3>().dot(e.head<3>()), way * e.head<3>().norm(), 1e-12);
    EXPECT_NEAR(r.tail<3>().dot(e.tail<3>()), angle * e.tail<3>().norm(), 1e-9);
  }
}

TEST(Regulator, IsQuietWhenNoiseExplainsTheError) {
  const RegulatorParameters k;
  const Matrix6 covariance = 1e-6 * Matrix6::Identity();  // 1 mm, 1 mrad
  const auto gain = [&](double mm) {
    const RegulatorParameters quiet = quieted(k, {Matrix3::Identity(), {1e-3 * mm, 0, 0}}, covariance);
    EXPECT_NEAR(quiet.angular_gain / k.angular_gain, quiet.gain / k.gain, 1e-12) << "both gains alike";
    EXPECT_EQ(quiet.speed, k.speed);
    return quiet.gain;
  };
  // 1 - (3/6)^2 of what is left above the quiet share.
  EXPECT_NEAR(gain(6), k.gain * (k.quiet + (1 - k.quiet) * 0.75), 1e-9);
  EXPECT_EQ(gain(0), k.quiet * k.gain);
  EXPECT_EQ(gain(2.9), k.quiet * k.gain);
  EXPECT_GT(gain(4), gain(3.1));
  EXPECT_NEAR(gain(100), k.gain, 1e-3);
}

TEST(Regulator, CommandsNothingWithoutAnError) {
  EXPECT_EQ(distance(smooth({}, regulate({}, {}, kStep), {}, kStep), Pose{}), 0);
}

TEST(Regulator, ChangesTheMotionNoFasterThanTheClip) {
  std::mt19937_64 random(2);
  const RegulatorParameters k;
  AngleAxisPose before = AngleAxisPose::Zero();
  for (int n = 0; n < 500; ++n) {
    const Pose wanted =
        regulate({.gain = 1, .angular_gain = 1, .speed = 1, .angular_speed = 3}, random_pose(random), kStep);
    const AngleAxisPose r = angle_axis_from_pose(smooth(k, wanted, pose_from_angle_axis(before), kStep));
    EXPECT_LE((r - before).head<3>().norm(), k.acceleration * kStep * kStep * (1 + 1e-9));
    EXPECT_LE((r - before).tail<3>().norm(), k.angular_acceleration * kStep * kStep * (1 + 1e-9));
    EXPECT_LE(r.head<3>().norm(), k.top_speed * kStep * (1 + 1e-9));
    EXPECT_LE(r.tail<3>().norm(), k.top_angular_speed * kStep * (1 + 1e-9));
    before = r;
  }
}

// Below both clips nothing is lost, above each of them exactly the clip is left, whatever the other one does.
TEST(Regulator, EachClipIsReachedAndBelowItNothingIsClipped) {
  const RegulatorParameters k{
      .top_speed = 0.4, .top_angular_speed = 0.9, .acceleration = 2, .angular_acceleration = 5};
  const double most = k.acceleration * kStep * kStep, most_angle = k.angular_acceleration * kStep * kStep;
  const Vector3 way = Vector3(1, -2, 2) / 3, axis = Vector3(2, 1, -2) / 3;
  const auto from_rest = [&](double length, double angle) {
    AngleAxisPose r;
    r << length * way, angle * axis;
    return angle_axis_from_pose(smooth(k, pose_from_angle_axis(r), {}, kStep));
  };
  for (const double share : {0.5, 0.99, 1.01, 2.0})
    for (const double angular_share : {0.5, 0.99, 1.01, 2.0}) {
      const AngleAxisPose r = from_rest(share * most, angular_share * most_angle);
      EXPECT_LT((r.head<3>() - std::min(1., share) * most * way).norm(), 1e-12) << share;
      EXPECT_LT((r.tail<3>() - std::min(1., angular_share) * most_angle * axis).norm(), 1e-12)
          << angular_share;
    }
}

TEST(Regulator, TheTopSpeedsAreReachedByWhoeverIsToldToBeFaster) {
  const RegulatorParameters k{.top_speed = 0.4, .top_angular_speed = 0.9};
  AngleAxisPose wanted;
  wanted << 0, 0.3, 0.4, 0.5, 0, 0;
  Pose now;
  for (int n = 0; n < 200; ++n) now = smooth(k, pose_from_angle_axis(wanted), now, kStep);
  const AngleAxisPose r = angle_axis_from_pose(now);
  EXPECT_LT((r.head<3>() - Vector3(0, 0.6, 0.8) * k.top_speed * kStep).norm(), 1e-12);
  EXPECT_LT((r.tail<3>() - Vector3(k.top_angular_speed * kStep, 0, 0)).norm(), 1e-9);
}

TEST(Regulator, EasedIsSlowerInAllSpeedsAndInNothingElse) {
  const RegulatorParameters k{.gain = 0.2,
                              .angular_gain = 0.4,
                              .speed = 1,
                              .angular_speed = 2,
                              .top_speed = 3,
                              .top_angular_speed = 4,
                              .acceleration = 5,
                              .angular_acceleration = 6};
  const RegulatorParameters slower = eased(k, 0.5);
  EXPECT_EQ(slower.speed, 0.5);
  EXPECT_EQ(slower.angular_speed, 1);
  EXPECT_EQ(slower.top_speed, 1.5);
  EXPECT_EQ(slower.top_angular_speed, 2);
  EXPECT_EQ(slower.gain, k.gain);
  EXPECT_EQ(slower.angular_gain, k.angular_gain);
  EXPECT_EQ(slower.acceleration, k.acceleration);
  EXPECT_EQ(slower.angular_acceleration, k.angular_acceleration);
}

TEST(Regulator, ReachesAMotionThatItIsToldForLongEnough) {
  const RegulatorParameters k;
  AngleAxisPose wanted;
  wanted << 0.004, 0.002, 0, 0, 0.01, 0;
  Pose now;
  for (int n = 0; n < 20; ++n) now = smooth(k, pose_from_angle_axis(wanted), now, kStep);
  EXPECT_LT((angle_axis_from_pose(now) - wanted).norm(), 1e-12);
}

}  // namespace
}  // namespace mrroc::visual_servo
