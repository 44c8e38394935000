// Motors to joints and back.
#include "test/robots/irb6/arms.hpp"

namespace mrroc::irb6::test {
namespace {

using Transmissions = Irb6;
INSTANTIATE_TEST_SUITE_P(Arms, Transmissions, kTrackKept, arm_case_name);

TEST_P(Transmissions, RoundTripEveryPoseInTheLimits) {
  double worst_motor = 0, worst_joint = 0;
  for (int k = 0; k < kCases; ++k) {
    const AxisVector m = random_motors();
    const Converted q = arm_.transmission().joints(m);
    const Converted back = arm_.transmission().motors(q.value);
    ASSERT_TRUE(q.inside && back.inside) << m.transpose();
    worst_motor = std::max(worst_motor, (back.value - m).cwiseAbs().maxCoeff());
    worst_joint =
        std::max(worst_joint, (arm_.joints_from_motors(back.value) - q.value).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(worst_motor, 1e-9);
  EXPECT_LE(worst_joint, 1e-9);
}

TEST_P(Transmissions, JacobianMatchesFiniteDifferences) {
  constexpr double h = 1e-6;
  for (int k = 0; k < 1000; ++k) {
    const AxisVector q = random_joints();
    const AxisMatrix J = arm_.transmission().jacobian(q);
    for (int j = 0; j < q.size(); ++j) {
      AxisVector a = q, b = q;
      a[j] -= h;
      b[j] += h;
      const AxisVector numeric = (arm_.motors_from_joints(b) - arm_.motors_from_joints(a)) / (2 * h);
      ASSERT_LE((J.col(j) - numeric).cwiseAbs().maxCoeff(), 1e-4) << "joint " << j << ": " << q.transpose();
    }
  }
}

// Power: what the motors give, the joints get.
TEST_P(Transmissions, JacobianIsInvertibleInTheLimits) {
  for (int k = 0; k < 1000; ++k) {
    const AxisMatrix J = arm_.transmission().jacobian(random_joints());
    for (int j = 0; j < J.rows(); ++j) ASSERT_GT(std::abs(J(j, j)), 50) << "axis " << j;
    ASSERT_TRUE(J.isLowerTriangular());
  }
}

// The original wrapped the V motor by 2 pi of the motor, 0.08 rad of the joint.
TEST_P(Transmissions, TMovesTheVMotorOneToOneAndWithoutWrapping) {
  AxisVector q = arm_.front();
  const AxisVector m = arm_.motors_from_joints(q);
  const int T = first_ + 3, V = first_ + 4;
  for (double turn = -1.2; turn < 1.2; turn += 0.01) {
    q[T] = arm_.front()[T] + turn;
    const AxisVector moved = arm_.motors_from_joints(q);
    ASSERT_NEAR(moved[T] - m[T], -128 * turn, 1e-9);
    ASSERT_NEAR(moved[V] - m[V], -128 * turn, 1e-9);
  }
}

TEST_P(Transmissions, ClampAndReportOutsideTheLinkages) {
  for (int k = 0; k < 1000; ++k) {
    AxisVector m = random_motors();
    const int axis = first_ + 1 + k % 2;
    m[axis] = k % 4 < 2 ? uniform(2e3, 1e300) : -uniform(2e3, 1e300);
    const Converted q = arm_.transmission().joints(m);
    ASSERT_FALSE(q.inside);
    ASSERT_TRUE(q.value.allFinite());

    AxisVector joints = random_joints();
    joints[first_ + 1] = k % 2 == 0 ? uniform(2, 1e10) : uniform(-1e10, -4);
    const Converted back = arm_.transmission().motors(joints);
    ASSERT_FALSE(back.inside);
    ASSERT_TRUE(back.value.allFinite());
    ASSERT_TRUE(arm_.transmission().jacobian(joints).allFinite());
  }
}

TEST_P(Transmissions, DoNotMakeAPositionOfNotANumber) {
  for (int k = 0; k < arm_.axes(); ++k) {
    AxisVector x = arm_.front();
    x[k] = std::nan("");
    EXPECT_FALSE(arm_.transmission().motors(x).inside);
    EXPECT_TRUE(std::isnan(arm_.motors_from_joints(x)[k]));
    x = arm_.motors_from_joints(arm_.front());
    x[k] = std::nan("");
    EXPECT_FALSE(arm_.transmission().joints(x).inside);
    EXPECT_TRUE(std::isnan(arm_.joints_from_motors(x)[k]));
  }
}

TEST(TransmissionFigures, MatchTheOriginalAfterSynchronisation) {
  AxisVector q(6);
  q << -0.10063, -1.54194, 0.01974, 1.13352, 3.69714, -2.73812;
  EXPECT_LE((Arm(kPostument).synchronised() - q).cwiseAbs().maxCoeff(), 6e-6);
}

TEST(TransmissionFigures, MatchTheOriginalsAnglesAtTheMotorLimits) {
  const Arm arm(kPostument);
  AxisVector lower(6), upper(6);
  for (int k = 0; k < 6; ++k) {
    lower[k] = arm.axis(k).motor.lower;
    upper[k] = arm.axis(k).motor.upper;
  }
  const AxisVector a = arm.joints_from_motors(lower), b = arm.joints_from_motors(upper);
  EXPECT_NEAR(a[0], 2.874, 1e-3);
  EXPECT_NEAR(b[0], -2.949, 1e-3);
  EXPECT_NEAR(a[1], -2.188, 1e-3);
  EXPECT_NEAR(b[1], -0.906, 1e-3);
  EXPECT_NEAR(a[1] + a[2] + kPi / 2, -0.442, 1e-3);
  EXPECT_NEAR(b[1] + b[2] + kPi / 2, 0.638, 1e-3);
  EXPECT_NEAR(a.segment<3>(1).sum() + kPi / 2, 1.729, 1e-3);
  EXPECT_NEAR(b.segment<3>(1).sum() + kPi / 2, -1.787, 1e-3);
}

}  // namespace
}  // namespace mrroc::irb6::test
