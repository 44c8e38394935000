#include "base/screw.hpp"

#include <gtest/gtest.h>

#include "test/base/random_pose.hpp"

namespace mrroc {
namespace {

TEST(Screw, LogUndoesExp) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int k = 0; k < 1000; ++k) {
    const double scale = std::pow(10, 6 * part(random) - 6);  // also the slowest motion
    Twist v;
    for (const Axis a : kAxes) v[a] = (a < Axis::ax ? 1 : 1.7) * scale * part(random);
    EXPECT_LT((log_screw(exp_screw(v)).vector() - v.vector()).norm(), 1e-9 * scale + 1e-15);
  }
}

TEST(Screw, IsTheMotionWithAConstantVelocityInTheMovingFrame) {
  const Twist v{{0.3, -0.2, 0.1, 0.5, 1, -0.7}};
  Pose T;
  constexpr int kParts = 100'000;
  const Pose small = pose_from_angle_axis(v.vector() / kParts);
  for (int k = 0; k < kParts; ++k) T = T * small;
  const Pose whole = exp_screw(v);
  EXPECT_LT((T.p - whole.p).norm(), 1e-5);
  EXPECT_LT((T.R - whole.R).norm(), 1e-5);
}

TEST(Screw, HalfTheTimeTwiceIsTheWholeWay) {
  const Twist v{{1, 2, -1, 0.4, -1.1, 0.9}};
  const Pose half = exp_screw(v, 0.5);
  const Pose twice = half * half, whole = exp_screw(v);
  EXPECT_LT((twice.p - whole.p).norm() + (twice.R - whole.R).norm(), 1e-12);
}

}  // namespace
}  // namespace mrroc
