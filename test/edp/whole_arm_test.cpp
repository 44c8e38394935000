// The whole arm as the predictor of stability has it, over random poses, gears and laws.
#include "edp/whole_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/fault.hpp"
#include "edp/stability.hpp"
#include "robots/irb6/arm.hpp"

namespace mrroc::edp {
namespace {

constexpr int kCases = 40;

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<>(low, high)(random);
}

/// Somewhere above the table, with masses that are nobody's.
ArmBelief random_belief(std::mt19937_64& random, const Robot& robot) {
  ArmBelief b;
  const Pose T_0W{(Matrix3() << 1, 0, 0, 0, -1, 0, 0, 0, -1).finished() *
                      Eigen::AngleAxisd(between(random, -0.2, 0.2), Vector3::UnitY()).toRotationMatrix(),
                  Vector3(between(random, 0.8, 1), between(random, -0.1, 0.1), between(random, 1, 1.1))};
  b.joints = robot.inverse(T_0W, AxisVector::Zero(robot.axes())).joints;
  b.T_WE.p = Vector3(0, 0, between(random, 0.1, 0.3));
  const auto n = robot.axes();
  // Regulators are made for the inertia of their drives; links couple them.
  AxisVector share(n);
  b.rotors.resize(n);
  for (int k = 0; k < n; ++k) {
    const double inertia = robot.axis(k).servo.drive.inertia;
    share[k] = between(random, 0.3, 0.6) * inertia;
    b.rotors[k] = inertia - share[k];
  }
  AxisMatrix coupling = AxisMatrix::Identity(n, n);
  for (double& x : coupling.reshaped()) x += between(random, -0.03, 0.03);
  const AxisMatrix J = robot.motors_per_joints(b.joints);
  const AxisMatrix links = coupling * share.asDiagonal() * coupling.transpose();
  b.mass = J.transpose() * links * J;
  b.tool = between(random, 0.2, 2);
  b.tool_centre = Vector3(0, 0, between(random, 0.05, 0.1));
  return b;
}

ContactLoop random_loop(std::mt19937_64& random, const WholeArm& arm, bool elastic) {
  ContactLoop l;
  l.inertia = between(random, 2, 40);
  l.mobility = std::exp(between(random, std::log(5e-4), std::log(0.02)));
  l.contact_damping = 2e-3;
  l.servo = arm;
  l.gears.frequency = elastic ? between(random, 8, 15) : 0;
  return l;
}

/// The same arm in other joints q = S q'.
WholeArm in_joints(WholeArm arm, const AxisMatrix& S) {
  arm.motors_per_joints = arm.motors_per_joints * S;
  arm.mass = S.transpose() * arm.mass * S;
  arm.tip = S.transpose() * arm.tip;
  arm.tool_centre = S.transpose() * arm.tool_centre;
  arm.set = S.inverse() * arm.set;
  return arm;
}

/// Calls with the arm at random poses, with rigid and elastic gears in turn.
template <class Check>
void at_random_poses(std::uint64_t seed, Check check) {
  std::mt19937_64 random(seed);
  const irb6::Arm robot(irb6::kPostument);
  for (int k = 0; k < kCases; ++k) {
    SCOPED_TRACE(k);
    const ArmBelief belief = random_belief(random, robot);
    const WholeArm arm = whole_arm(robot, belief);
    check(random, robot, belief, arm, random_loop(random, arm, k % 2 == 1));
  }
}

TEST(WholeArm, ItsSetMotionMovesTheTipAlongTheAxisAndDoesNotTurnIt) {
  at_random_poses(1, [](auto&, const Robot& robot, const ArmBelief& b, const WholeArm& arm, const auto&) {
    constexpr double kWay = 1e-6;  // [m]
    const Pose from = robot.forward(b.joints) * b.T_WE;
    const Pose to = robot.forward(b.joints + kWay * arm.set) * b.T_WE;
    EXPECT_NEAR(((to.p - from.p) / kWay - from.R.col(2)).norm(), 0, 1e-4);
    EXPECT_NEAR((to.R - from.R).norm() / kWay, 0, 1e-4);
    EXPECT_NEAR(arm.tip.dot(arm.set), 1, 1e-6);
    EXPECT_NEAR(arm.tool_centre.dot(arm.set), 1, 1e-6) << "what does not turn moves as a whole";
  });
}

// The contact of a sheet that slopes moves axes that the law does not command, too.
TEST(WholeArm, ASlopingContactPushesAlongItsNormal) {
  at_random_poses(4, [](auto& random, const Robot& robot, ArmBelief b, const WholeArm& level, const auto&) {
    constexpr double kWay = 1e-6;  // [rad, m]
    b.normal = Vector3(between(random, -0.2, 0.2), between(random, -0.2, 0.2), 1);
    const WholeArm arm = whole_arm(robot, b);
    const Vector3 normal = b.normal.normalized();
    const Pose from = robot.forward(b.joints) * b.T_WE;
    for (Eigen::Index k = 0; k < robot.axes(); ++k) {
      AxisVector joints = b.joints;
      joints[k] += kWay;
      const Vector3 way = from.R.transpose() * ((robot.forward(joints) * b.T_WE).p - from.p);
      EXPECT_NEAR(arm.tip[k], normal.dot(way) / kWay, 1e-4);
    }
    EXPECT_NEAR(arm.tip.dot(arm.set), arm.felt, 1e-6);
    EXPECT_NEAR(arm.felt, normal.z(), 1e-12);
    EXPECT_NEAR((arm.set - level.set).norm(), 0, 1e-12) << "the driver does not know the slope";
  });
}

// Gears that give way have a spring a joint, so that joints may be scaled, but not mixed.
TEST(WholeArm, ItIsAsStableInOtherJoints) {
  at_random_poses(2, [](auto& random, const auto&, const auto&, const WholeArm& arm, ContactLoop loop) {
    const auto n = arm.tip.size();
    AxisMatrix S = AxisMatrix::Identity(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        if (i == j || loop.gears.frequency == 0) S(i, j) += between(random, -0.07, 0.07);
    const double K = std::exp(between(random, std::log(1e3), std::log(1e5)));
    const double radius = contact_mode(loop, K).radius;
    loop.servo = in_joints(arm, S);
    EXPECT_NEAR(contact_mode(loop, K).radius, radius, 1e-5);
  });
}

TEST(WholeArm, HardlyMobileItIsStableInAnyContact) {
  at_random_poses(3, [](auto& random, const auto&, const auto&, const auto&, ContactLoop loop) {
    loop.mobility = 1e-5;
    const double K = std::exp(between(random, std::log(1e3), std::log(1e5)));
    EXPECT_LT(contact_mode(loop, K).radius, 1);
  });
}

TEST(WholeArm, ASingularArmIsRefused) {
  const irb6::Arm robot(irb6::kPostument);
  std::mt19937_64 random(5);
  ArmBelief b = random_belief(random, robot);
  b.joints[4] = 0;
  EXPECT_THROW(static_cast<void>(whole_arm(robot, b)), FaultError);
}

}  // namespace
}  // namespace mrroc::edp
