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
    return quieted(k, {Matrix3::Identity(), {1e-3 * mm, 0, 0}}, covariance).gain;
  };
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
