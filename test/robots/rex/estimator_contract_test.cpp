// What every estimator of a platform promises, for those of Rex.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <tuple>

#include "test/heap.hpp"
#include "test/robots/rex/estimator_inputs.hpp"
#include "test/robots/rex/estimator_rig.hpp"
#include "test/robots/rex/estimators.hpp"

namespace mrroc::rex::test {
namespace {

using mrroc::test::AllocationCounter;

class EstimatorContract : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<edp::Estimator> estimator = make(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Rex, EstimatorContract, testing::Values("mhe", "ekf"), name_of);

TEST_P(EstimatorContract, AnswerNotOkBeforeTheyHaveBegun) {
  estimator->add(edp::StageReading{.step = 10});
  EXPECT_FALSE(estimator->add(MapPose{.step = 10, .valid = true, .p = {}}));
  EXPECT_FALSE(estimator->add(OdometryReading{.step_before = 0, .step = 10, .valid = true}));
  EXPECT_FALSE(estimator->step().health.ok);
}

TEST_P(EstimatorContract, AnswerWhereTheyStandAtOnce) {
  estimator->begin(
      {.step = 70, .p = {1, 2, 3}, .load = standing_load(44, {0.04, 0, 0}), .theta = {1, 2, 3, 4}});
  const edp::EstimatorResult result = estimator->step();
  EXPECT_TRUE(result.health.ok);
  EXPECT_EQ(result.estimate.step, 70);
  EXPECT_NEAR(result.estimate.p.x, 1, 1e-6);
  EXPECT_NEAR(result.estimate.p.y, 2, 1e-6);
  EXPECT_NEAR(result.estimate.p.phi, 3, 1e-6);
  EXPECT_EQ(result.estimate.theta, (PerWheel{1, 2, 3, 4}));
  EXPECT_NEAR(result.mass, 44, 1e-9);
}

TEST_P(EstimatorContract, RefuseWhatIsTooLate) {
  estimator->begin({});
  for (int i = 1; i <= 40; ++i) {
    estimator->add(edp::StageReading{.step = 10 * i});
    std::ignore = estimator->step();
  }
  const MapPose pose{.step = 200, .valid = true, .p = {}};
  MapPose late = pose;
  late.step = 199;
  EXPECT_TRUE(estimator->add(pose));
  EXPECT_FALSE(estimator->add(late));
  OdometryReading motion{.step_before = 200, .step = 240, .valid = true};
  motion.A = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  EXPECT_TRUE(estimator->add(motion));
  motion.step_before = 190;
  EXPECT_FALSE(estimator->add(motion));
}

TEST_P(EstimatorContract, SayWhenTheMapContradictsThem) {
  estimator->begin({});
  for (int i = 1; i <= 40; ++i) {
    estimator->add(edp::StageReading{.step = 10 * i});
    std::ignore = estimator->step();
  }
  MapPose pose{.step = 380, .valid = true, .p = {}, .covariance = {25e-6, 0, 0, 0, 25e-6, 0, 0, 0, 1e-4}};
  EXPECT_TRUE(estimator->add(pose));
  EXPECT_FALSE(estimator->step().health.inconsistent);
  pose.step = 390;
  pose.p.x = 0.2;
  EXPECT_TRUE(estimator->add(pose));
  EXPECT_TRUE(estimator->step().health.inconsistent);
  EXPECT_FALSE(estimator->step().health.inconsistent) << "that was another step";
}

TEST_P(EstimatorContract, GiveEqualBitsForEqualInputs) {
  Trial trial{.drive = winding(0.6, 0.9)};
  trial.truth = another_structure();
  trial.duration = 5;
  const auto first = drive(*estimator, trial);
  const auto again = drive(*estimator, trial);
  const auto other = drive(*make(GetParam()), trial);
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(numbers_of(first[i].result), numbers_of(again[i].result)) << "stage " << i << ", begun again";
    ASSERT_EQ(numbers_of(first[i].result), numbers_of(other[i].result)) << "stage " << i;
  }
}

TEST_P(EstimatorContract, StayFiniteWhateverTheyAreGiven) {
  WildNumbers wild(1);
  for (int round = 0; round < 20; ++round) {
    estimator->begin(wild_rest(wild));
    for (int i = 1; i < 150; ++i) {
      estimator->add(wild_reading(wild, 10 * i));
      std::ignore = estimator->add(wild_pose(wild, 10 * i));
      std::ignore = estimator->add(wild_motion(wild, 10 * i));
      ASSERT_TRUE(is_finite(estimator->step())) << "round " << round << ", stage " << i;
    }
  }
}

TEST_P(EstimatorContract, RecoverFromReadingsThatAreNoNumbers) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  estimator->begin(
      {.p = {}, .covariance = {9e-6, 0, 0, 0, 9e-6, 0, 0, 0, 25e-6}, .load = standing_load(kMass, {})});
  for (int i = 1; i <= 200; ++i) {
    edp::StageReading reading{.step = 10 * i, .imu_valid = true, .load = standing_load(kMass, {})};
    if (i >= 50 && i < 60) {
      reading.theta.fill(kNan);
      reading.theta_dot.fill(kNan);
      reading.yaw = reading.yaw_rate = kNan;
      reading.load.fill(kNan);
      reading.torque.fill(kNan);
    }
    estimator->add(reading);
    const edp::EstimatorResult result = estimator->step();
    ASSERT_TRUE(is_finite(result));
    ASSERT_LT(std::hypot(result.estimate.p.x, result.estimate.p.y), 0.02) << "stage " << i;
  }
}

TEST_P(EstimatorContract, AllocateNothingBetweenBeginAndEnd) {
  Trial trial{.drive = winding(0.6, 0.9)};
  trial.duration = 1;
  std::ignore = drive(*estimator, trial);
  WildNumbers wild(2);
  const AllocationCounter counter;
  estimator->begin(wild_rest(wild));
  for (int i = 1; i < 60; ++i) {
    estimator->add(edp::StageReading{.step = 10 * i, .torque = {2, 2, 2, 2}});
    std::ignore = estimator->add(MapPose{.step = 10 * (i - 4), .valid = true, .p = {}});
    std::ignore = estimator->add(wild_motion(wild, 10 * i));
    std::ignore = estimator->step();
  }
  EXPECT_EQ(counter.count(), 0);
}

}  // namespace
}  // namespace mrroc::rex::test
