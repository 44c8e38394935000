#include "robots/rex/stage_residuals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "robots/rex/parameters.hpp"
#include "robots/rex/stage_model.hpp"
#include "robots/rex/weighing.hpp"

namespace mrroc::rex::test {
namespace {

using std::numbers::pi;

constexpr double kDifference = 1e-6;

StageVector random_state(std::mt19937& random) {
  std::uniform_real_distribution<> unit(-1, 1);
  StageVector z;
  for (double& value : z) value = unit(random);
  z[2] *= 3 * pi;
  z.segment<4>(6) *= 6;
  z[kSlipIndex] = 0.6 + 0.3 * unit(random);
  z[kSlipIndex + 1] = 0.6 + 0.3 * unit(random);
  z[kSlipIndex + 2] *= 0.4;
  return z;
}

/// Central differences of a function of z.
template <int rows>
Eigen::Matrix<double, rows, kStageStates> slope_of(
    const std::function<Eigen::Matrix<double, rows, 1>(const StageVector&)>& f, const StageVector& z) {
  Eigen::Matrix<double, rows, kStageStates> slope;
  for (int i = 0; i < kStageStates; ++i) {
    StageVector there = z, back = z;
    there[i] += kDifference;
    back[i] -= kDifference;
    slope.col(i) = (f(there) - f(back)) / (2 * kDifference);
  }
  return slope;
}

WindowStage still_stage() {
  WindowStage stage;
  stage.torque.setZero();
  stage.load = Eigen::Vector4d::Constant(98.1);
  stage.torque_known = true;
  return stage;
}

TEST(StageResiduals, SlopesOfPosesAndMotionsAreThoseOfDifferences) {
  std::mt19937 random(1);
  const Eigen::Vector2d centre(0.04, -0.02);
  for (int i = 0; i < 100; ++i) {
    const StageVector z = random_state(random);
    const auto pose = [&](const StageVector& at) { return pose_of_body(at, centre, -0.008).value; };
    const auto motion = [&](const StageVector& at) { return motion_of_body(at, centre).value; };
    EXPECT_LT((pose_of_body(z, centre, -0.008).slope - slope_of<3>(pose, z)).norm(), 1e-7);
    EXPECT_LT((motion_of_body(z, centre).slope - slope_of<3>(motion, z)).norm(), 1e-7);
  }
}

TEST(StageResiduals, PoseIsThatOfTheBodyNotOfItsCentre) {
  StageVector z = StageVector::Zero();
  z.head<3>() << 1, 2, pi / 2;
  const Eigen::Vector3d pose = pose_of_body(z, {0.04, 0.01}, 0).value;
  EXPECT_NEAR(pose[0], 1.01, 1e-12);
  EXPECT_NEAR(pose[1], 1.96, 1e-12);
}

TEST(StageResiduals, PoseBetweenStagesIsCarriedOnByTheSpeed) {
  StageVector z = StageVector::Zero();
  z[3] = 0.8;
  z[5] = 1.0;
  const Eigen::Vector3d pose = pose_of_body(z, {0, 0}, 0.01).value;
  EXPECT_NEAR(pose[0], 0.008, 1e-12);
  EXPECT_NEAR(pose[2], 0.01, 1e-12);
}

// A turn on the spot about the mass centre moves B.
TEST(StageResiduals, MotionIsThatOfTheBodySeenFromThePicture) {
  StageVector z = StageVector::Zero();
  z[2] = pi;
  z.segment<3>(kCloneIndex) << 0, 0, pi / 2;
  const Eigen::Vector3d motion = motion_of_body(z, {0.04, 0}).value;
  EXPECT_NEAR(motion[0], 0.04, 1e-12);
  EXPECT_NEAR(motion[1], -0.04, 1e-12);
  EXPECT_NEAR(motion[2], pi / 2, 1e-12);
}

TEST(StageResiduals, HeadingsAreComparedTheShortWayRound) {
  WindowStage stage = still_stage();
  stage.imu_valid = true;
  stage.yaw = 0.1;
  stage.yaw_rate = 0;
  stage.map =
      planar_factor({0, 0, -pi + 0.01}, Eigen::Matrix3d::Identity() * 1e-4, Eigen::Vector3d::Constant(0.01));
  stage.odometry =
      planar_factor({0, 0, -0.02}, Eigen::Matrix3d::Identity() * 1e-4, Eigen::Vector3d::Constant(0.01));
  StageVector z = StageVector::Zero();
  z[2] = 5 * pi - 0.01;
  z[kCloneIndex + 2] = pi;
  const StageResiduals all = residuals(z, stage, pi - 0.1, {0, 0}, EstimatorNoise{});
  ASSERT_EQ(all.count, 8);
  EXPECT_NEAR(all.r[1], -0.01 / EstimatorNoise{}.yaw, 1e-9);
  EXPECT_NEAR(all.r[4], -0.02 / 0.01, 1e-9);
  EXPECT_NEAR(all.r[7], 0.01 / 0.01, 1e-9);
}

TEST(StageResiduals, WhatWasNotMeasuredSaysNothing) {
  EXPECT_EQ(residuals(StageVector::Zero(), still_stage(), 0, {0, 0}, EstimatorNoise{}).count, 0);
}

// Wheels that slip as they do when it drives: there the integrator is exact enough for its own derivatives.
TEST(StageModel, SlopesAreThoseOfDifferences) {
  std::mt19937 random(2);
  const Load weighed = weigh(standing_load(44, {0.04, 0, 0}));
  const EstimatorNoise noise{.sliding = 0};  // it learns of the ground at any slip
  WindowStage from = still_stage();
  WindowStage to = still_stage();
  to.torque << 3, -2, 4, 1;
  for (int i = 0; i < 100; ++i) {
    from.picture = i % 2 != 0;
    StageVector z = random_state(random);
    for (int k = 0; k < 4; ++k)
      z[6 + k] = (z[3] - kWheelY[static_cast<std::size_t>(k)] * z[5]) / kWheelRadius + 0.01 * z[6 + k];
    z[4] *= 0.05;
    const auto next = [&](const StageVector& at) {
      return StageVector(transition(at, from, to, weighed, noise).z);
    };
    const StageMatrix F = transition(z, from, to, weighed, noise).F;
    EXPECT_LT((F - slope_of<kStageStates>(next, z)).norm(), 0.01 * F.norm());
  }
}

TEST(StageModel, CloneIsThePoseBehindAPictureOnly) {
  std::mt19937 random(3);
  WindowStage picture = still_stage();
  picture.picture = true;
  const StageVector z = random_state(random);
  const Load weighed = weigh({});
  const StageVector behind = transition(z, picture, still_stage(), weighed, EstimatorNoise{}).z;
  const StageVector later = transition(behind, still_stage(), still_stage(), weighed, EstimatorNoise{}).z;
  EXPECT_EQ(behind.segment<3>(kCloneIndex), z.head<3>());
  EXPECT_EQ(later.segment<3>(kCloneIndex), z.head<3>());
}

TEST(StageModel, NothingIsLearntOfTheGroundAtRestOrWhileBraking) {
  const Load weighed = weigh({});
  WindowStage braked = still_stage();
  braked.torque_known = false;
  StageVector z = StageVector::Zero();
  z.segment<3>(kSlipIndex) << 0.7, 0.6, 0;
  const auto learns = [&](const WindowStage& to) {
    const StageTransition next = transition(z, still_stage(), to, weighed, EstimatorNoise{});
    const bool depends = !next.F.block<10, 3>(0, kSlipIndex).isZero();
    EXPECT_EQ(next.deviation[kSlipIndex], depends ? EstimatorNoise{}.slip_process : 0);
    return depends;
  };
  EXPECT_FALSE(learns(still_stage()));
  z[3] = 0.5;
  EXPECT_TRUE(learns(still_stage()));
  EXPECT_FALSE(learns(braked));
  z[3] = 0;
  z[5] = 0.5;
  EXPECT_TRUE(learns(still_stage())) << "a turn on the spot";
}

TEST(StageModel, RollingWheelsForgetTheGroundAndLearnNothing) {
  StageVector z = StageVector::Zero();
  z.segment<3>(kSlipIndex) << 0.7, 0.6, 0;
  z[kVelocity] = 0.6;
  z.segment<4>(kWheelSpeed).setConstant((0.6 + 2 * kSlipSpeed) / kWheelRadius);
  const auto next = [&] { return transition(z, still_stage(), still_stage(), weigh({}), EstimatorNoise{}); };
  EXPECT_TRUE((next().F.block<10, 3>(0, kSlipIndex).isZero()));
  EXPECT_EQ(next().deviation[kSlipIndex], EstimatorNoise{}.rolling_slip_process);
  z.segment<4>(kWheelSpeed).setConstant((0.6 + 4 * kSlipSpeed) / kWheelRadius);
  EXPECT_FALSE((next().F.block<10, 3>(0, kSlipIndex).isZero()));
  EXPECT_EQ(next().deviation[kSlipIndex], EstimatorNoise{}.slip_process);
}

}  // namespace
}  // namespace mrroc::rex::test
