// Inverse kinematics along a path, called every step with the joints of the step before.
#include "test/robots/irb6/arms.hpp"

namespace mrroc::irb6::test {
namespace {

using Paths = Irb6;
INSTANTIATE_TEST_SUITE_P(Arms, Paths, kTrackKept, arm_case_name);

Vector3 unit(std::mt19937_64& random) {
  std::normal_distribution<> n;
  return Vector3(n(random), n(random), n(random)).normalized();
}

// Straight lines with a turn about a fixed axis, 0.1 mm and 0.1 mrad per step, until a limit or a singular
// wrist comes near. A wrong branch would show as a jump of at least 0.3 rad.
TEST_P(Paths, StraightLinesNeverJump) {
  constexpr double kStep = 1e-4;
  long steps = 0;
  for (int line = 0; line < kCases / 2000; ++line) {
    AxisVector q = random_joints();
    const Pose start = arm_.forward(q);
    const Vector3 direction = unit(random_), axis = unit(random_);
    for (int k = 1; k < 3000; ++k) {
      const Pose T{rotation_from_angle_axis(k * kStep * axis) * start.R, start.p + k * kStep * direction};
      const edp::InverseSolution s = arm_.inverse(T, q);
      if (!s.reached || std::abs(std::sin(s.joints[first_ + 4])) < 0.1) break;
      ASSERT_LE((s.joints - q).cwiseAbs().maxCoeff(), 0.01)
          << "step " << k << " from " << q.transpose() << " to " << s.joints.transpose();
      ASSERT_LE(difference(arm_.forward(s.joints), T), 1e-9);
      if (!motors_legal(arm_, s.joints)) break;
      q = s.joints;
      ++steps;
    }
  }
  EXPECT_GT(steps, kCases / 20);
}

// q5 through 0 and pi, the other joints moving as well, exactly hitting the singular pose.
TEST_P(Paths, GoThroughTheSingularWrist) {
  for (const double centre : {0.0, kPi}) {
    AxisVector q0 = arm_.front();
    q0[first_ + 4] = centre;
    AxisVector rate = AxisVector::Constant(arm_.axes(), 1e-4);
    if (first_ == 1) rate[0] = 0;
    AxisVector q = q0 - 500 * rate;
    for (int k = -500; k <= 500; ++k) {
      const AxisVector expected = q0 + k * rate;
      const Pose T = arm_.forward(expected);
      const edp::InverseSolution s = arm_.inverse(T, q);
      ASSERT_TRUE(s.reached);
      ASSERT_EQ(s.singular, k == 0);
      ASSERT_LE((s.joints - expected).cwiseAbs().maxCoeff(), k == 0 ? 1e-3 : 1e-9) << k;
      ASSERT_LE(difference(arm_.forward(s.joints), T), 1e-9);
      q = s.joints;
    }
  }
}

TEST_P(Paths, TurnTheLastAxisThroughHalfTurnsWithoutUnwinding) {
  AxisVector q = arm_.front();
  const double start = arm_.axis(first_ + 5).motor.lower;
  AxisVector m = arm_.motors_from_joints(q);
  for (m[first_ + 5] = start; m[first_ + 5] < arm_.axis(first_ + 5).motor.upper; m[first_ + 5] += 5) {
    const AxisVector expected = arm_.joints_from_motors(m);
    q[first_ + 5] = m[first_ + 5] == start ? expected[first_ + 5] : q[first_ + 5];
    const edp::InverseSolution s = arm_.inverse(arm_.forward(expected), q);
    ASSERT_LE((s.joints - expected).cwiseAbs().maxCoeff(), 1e-9);
    q = s.joints;
  }
}

// Beyond a limit the angle goes on, for the guard to see, rather than jump a turn back.
TEST_P(Paths, CrossALimitWithoutAJump) {
  AxisVector m = arm_.motors_from_joints(arm_.front());
  m[first_ + 5] = arm_.axis(first_ + 5).motor.upper - 1;
  AxisVector q = arm_.joints_from_motors(m);
  for (int k = 0; k < 100; ++k, m[first_ + 5] += 0.5) {
    const AxisVector expected = arm_.joints_from_motors(m);
    const edp::InverseSolution s = arm_.inverse(arm_.forward(expected), q);
    ASSERT_LE((s.joints - expected).cwiseAbs().maxCoeff(), 1e-9);
    q = s.joints;
  }
  EXPECT_FALSE(motors_legal(arm_, q));
}

// The drawing's place: a sheet of 200 x 200 mm, 0.90 m in front of the column, at any height from 0.90 to
// 0.95 m, with a lift of 30 mm; the pen straight down.
TEST_P(Paths, ReachTheWholeSheet) {
  AxisVector near = arm_.front();
  near[first_ + 4] = 4.712;
  near[first_ + 5] = 1.57;
  const Pose T_EW = arm_.tool_in_wrist().inverse();
  for (double z = 0.90; z < 0.9801; z += 0.01)
    for (double x = 0.80; x < 1.0001; x += 0.01)
      for (double y = -0.10; y < 0.1001; y += 0.01) {
        const double y_base = y + (first_ == 1 ? near[0] : 0);
        const edp::InverseSolution s = arm_.inverse(tool_down(x, y_base, z) * T_EW, near);
        ASSERT_TRUE(s.reached) << x << ' ' << y << ' ' << z;
        ASSERT_TRUE(legal(arm_, s.joints)) << x << ' ' << y << ' ' << z << ": " << s.joints.transpose();
        near = s.joints;
      }
}

}  // namespace
}  // namespace mrroc::irb6::test
