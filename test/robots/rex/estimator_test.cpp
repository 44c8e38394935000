// Both estimators of Rex on a platform of their model's structure and on another one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>

#include "base/planar.hpp"
#include "test/robots/rex/estimator_rig.hpp"
#include "test/robots/rex/estimators.hpp"

namespace mrroc::rex::test {
namespace {

class Estimators : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<edp::Estimator> estimator = make(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Rex, Estimators, testing::Values("mhe", "ekf"), name_of);

Trial winding_trial() { return {.drive = winding(0.6, 0.9), .duration = 20}; }

bool all_ok(const std::vector<Sample>& run) {
  return std::all_of(run.begin(), run.end(),
                     [](const Sample& s) { return s.result.health.ok && !s.result.health.solver_failed; });
}

/// @return standard deviation of the position that was told at a time [m]
double position_deviation(const std::vector<Sample>& run, double time) {
  const auto at = std::find_if(run.begin(), run.end(), [&](const Sample& s) { return s.time >= time; });
  const PlanarCovariance& P = at->result.estimate.covariance;
  return std::sqrt(P[0] + P[4]);
}

void report(const std::string& name, const std::vector<Sample>& run) {
  const Slip slip = mean_slip(run, run.back().time / 2);
  testing::Test::RecordProperty(name + "_mu_x", std::to_string(slip.mu_x));
  testing::Test::RecordProperty(name + "_mu_y", std::to_string(slip.mu_y));
  testing::Test::RecordProperty(name + "_split", std::to_string(slip.split));
  testing::Test::RecordProperty(name + "_position_rms_mm", std::to_string(1e3 * position_rms(run)));
  testing::Test::RecordProperty(name + "_in_ellipse", std::to_string(share_in_ellipse(run)));
}

TEST_P(Estimators, FindFrictionOfTheirOwnModel) {
  const Slip grounds[]{
      {0.7, 0.6, 0}, {0.35, 0.3, 0}, {0.9, 0.9, 0}, {0.525, 0.45, 1.0 / 3}, {0.525, 0.45, -1.0 / 3}};
  for (const Slip& ground : grounds) {
    Trial trial = winding_trial();
    trial.truth.friction = ground;
    const auto samples = drive(*estimator, trial);
    report("own_model", samples);
    const Slip found = mean_slip(samples, 4);
    EXPECT_NEAR(found.mu_x, ground.mu_x, 0.02);
    EXPECT_NEAR(found.mu_y, ground.mu_y, 0.02);
    EXPECT_NEAR(found.split, ground.split, 0.02);
    EXPECT_LT(position_rms(samples), 0.005);
    EXPECT_GE(share_in_ellipse(samples), 0.8);
    EXPECT_TRUE(all_ok(samples));
  }
}

TEST_P(Estimators, FindFrictionSoonAfterItHasChanged) {
  Trial trial = winding_trial();
  trial.later = {0.35, 0.3, 0};
  trial.changes = 10;
  const auto samples = drive(*estimator, trial);
  const Slip found = mean_slip(samples, 12.5);
  EXPECT_NEAR(found.mu_x, 0.35, 0.035);
  EXPECT_NEAR(found.mu_y, 0.30, 0.030);
  EXPECT_LT(position_max(samples, 1, 20), 0.03);
}

TEST_P(Estimators, KnowWhereAPlatformOfAnotherStructureIs) {
  for (const Slip& ground : {Slip{0.7, 0.6, 0}, Slip{0.35, 0.3, 0}, Slip{0.525, 0.45, 1.0 / 3}})
    for (unsigned seed = 1; seed <= 3; ++seed) {
      Trial trial = winding_trial();
      trial.truth = another_structure();
      trial.truth.friction = ground;
      trial.seed = seed;
      const auto samples = drive(*estimator, trial);
      report("another_structure", samples);
      EXPECT_LT(position_rms(samples), 0.008);
      EXPECT_LT(heading_max(samples), 0.03);
      EXPECT_NEAR(mean_slip(samples, 4).split, ground.split, 0.05);
      EXPECT_GE(share_in_ellipse(samples), 0.8);
      EXPECT_TRUE(all_ok(samples));
    }
}

// The position told is that of B: with the mass centre taken for it, it would be wrong by 4 cm.
TEST_P(Estimators, TellAboutTheBodyNotAboutItsMassCentre) {
  Trial trial = winding_trial();
  trial.truth.centre_x = 0.04;
  trial.truth.centre_y = -0.03;
  trial.odometry = true;
  const auto samples = drive(*estimator, trial);
  EXPECT_NEAR(samples.back().result.centre.x, 0.04, 1e-9);
  EXPECT_NEAR(samples.back().result.centre.y, -0.03, 1e-9);
  EXPECT_NEAR(samples.back().result.mass, kMass, 1e-9);
  EXPECT_LT(position_rms(samples), 0.005);
  double slip = 0;
  for (const Sample& s : samples) slip = std::max(slip, std::abs(s.result.estimate.v.vy - s.v.vy));
  EXPECT_LT(slip, 0.05);
}

TEST_P(Estimators, FollowHeadingsThatGoRoundAndRound) {
  Trial trial = winding_trial();
  trial.drive = [](double time) {
    return PlanarVelocity{std::min(time / 4, 0.5), 0, std::min(time / 2, 1.2)};
  };
  const auto samples = drive(*estimator, trial);
  EXPECT_GT(samples.back().p.phi, 4 * std::numbers::pi);
  EXPECT_LT(position_rms(samples), 0.005);
  EXPECT_LT(heading_max(samples), 0.02);
  for (const Sample& s : samples) ASSERT_LE(std::abs(s.result.estimate.p.phi), std::numbers::pi);
}

TEST_P(Estimators, GoOnWithoutTheMap) {
  Trial trial = winding_trial();
  trial.truth = another_structure();
  trial.map_lost = {8, 18};
  const auto with = drive(*estimator, trial);
  EXPECT_LT(position_max(with, 8, 18.2), 0.06);
  trial.odometry = false;
  const auto without = drive(*estimator, trial);
  EXPECT_LT(position_max(without, 8, 18.2), 0.15);
  EXPECT_GT(position_deviation(without, 17.9), 2 * position_deviation(without, 7.9))
      << "and know that they drift";
  EXPECT_LT(position_rms(without, 19), 0.015) << "and come back";
}

// As exact as they are in a room with much to see: the pictures count for more than the IMU, whose bias is not known.
TEST_P(Estimators, HoldTheWayByExactPictures) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    Trial trial = winding_trial();
    trial.truth = another_structure();
    trial.map_lost = {6, 16};
    trial.pictures = 0.1;
    trial.seed = seed;
    const auto samples = drive(*estimator, trial);
    EXPECT_LT(position_max(samples, 6, 16.2), 0.03);
    EXPECT_GE(share_in_ellipse(samples), 0.8);
    trial.map_lost = {6, 1e9};
    trial.duration = 44;
    EXPECT_LT(position_max(drive(*estimator, trial), 6, 44), 0.04);
  }
}

// With neither map nor IMU the heading is that of the model, or that of the pictures.
TEST_P(Estimators, OdometryHoldsTheWay) {
  Trial trial = winding_trial();
  trial.truth = another_structure();
  trial.truth.friction = {0.35, 0.3, 0};
  trial.map_lost = {2, 20};
  trial.imu = false;
  const auto with = drive(*estimator, trial);
  trial.odometry = false;
  const auto without = drive(*estimator, trial);
  EXPECT_LT(position_max(with, 2, 20), 0.3);
  EXPECT_LT(heading_max(with), 0.1);
  EXPECT_GT(heading_max(without), 4 * heading_max(with));
  EXPECT_LT(position_deviation(with, 19), 0.7 * position_deviation(without, 19));
}

// Beyond them the platform holds better or worse than any ground that is believed in.
TEST_P(Estimators, KeepSlipCoefficientsWithinTheirBounds) {
  for (const Slip& ground : {Slip{1.2, 1.1, 0}, Slip{0.05, 0.04, 0}}) {
    Trial trial = winding_trial();
    trial.truth.friction = ground;
    const auto samples = drive(*estimator, trial);
    EXPECT_LT(position_rms(samples), 0.015);
    EXPECT_TRUE(all_ok(samples));
    constexpr SlipBounds kBounds;
    for (const Sample& s : samples) {
      ASSERT_GE(std::min(s.result.slip.mu_x, s.result.slip.mu_y), kBounds.least_friction);
      ASSERT_LE(std::max(s.result.slip.mu_x, s.result.slip.mu_y), kBounds.most_friction);
      ASSERT_LE(s.result.health.iterations, 2);
    }
  }
}

TEST(Mhe, SolvesOnceMoreOnlyWhereASlipCoefficientIsHeld) {
  Mhe mhe;
  Trial trial = winding_trial();
  const auto within = drive(mhe, trial);
  trial.truth.friction = {1.7, 1.6, 0};
  const auto beyond = drive(mhe, trial);
  EXPECT_EQ(within.back().result.health.iterations, 1);
  EXPECT_EQ(beyond.back().result.health.iterations, 2);
  EXPECT_NEAR(beyond.back().result.slip.mu_y, SlipBounds{}.most_friction, 0.01);
}

TEST_P(Estimators, StandStillWhenThePlatformDoes) {
  Trial trial = winding_trial();
  trial.drive = [](double) { return PlanarVelocity{}; };
  const auto samples = drive(*estimator, trial);
  const Sample& last = samples.back();
  EXPECT_LT(position_rms(samples), 0.004);
  EXPECT_NEAR(last.result.estimate.v.vx, 0, 0.01);
  EXPECT_NEAR(last.result.slip.mu_x, Slip{}.mu_x, 0.01) << "nothing is learnt of the ground";
  EXPECT_NEAR(last.result.slip.mu_y, Slip{}.mu_y, 0.01);
  EXPECT_GT(last.result.slip_sd.mu_x, 0.25);
  EXPECT_GT(last.result.slip_sd.mu_y, 0.25);
}

TEST_P(Estimators, LearnOfTheGroundOnlyWhenTheyTurn) {
  Trial trial = winding_trial();
  trial.drive = winding(0.6, 0);
  const auto straight = drive(*estimator, trial);
  trial.drive = winding(0.6, 0.9);
  const auto turning = drive(*estimator, trial);
  EXPECT_GT(straight.back().result.slip_sd.mu_y, 0.15);
  EXPECT_LT(turning.back().result.slip_sd.mu_y, 0.05);
}

// Whatever the map says where it is when it is back, the platform goes on as it went.
TEST_P(Estimators, AMapThatComesBackElsewhereChangesThePoseAlone) {
  Trial trial = winding_trial();
  trial.duration = 12;
  trial.map_lost = {6, 10};
  const auto as_it_was = drive(*estimator, trial);
  std::mt19937 random(1);
  std::uniform_real_distribution<> place(-0.5, 0.5), angle(-0.3, 0.3);
  for (int i = 0; i < 5; ++i) {
    trial.displacement = {place(random), place(random), angle(random)};
    const auto elsewhere = drive(*estimator, trial);
    PlanarPose displacement;
    for (std::size_t k = 0; k < elsewhere.size(); ++k) {
      const edp::EstimatorResult &a = as_it_was[k].result, &b = elsewhere[k].result;
      displacement = chained(b.displacement, displacement);
      EXPECT_NEAR(b.estimate.v.vx, a.estimate.v.vx, 0.01) << elsewhere[k].time;
      EXPECT_NEAR(b.estimate.v.vy, a.estimate.v.vy, 0.02) << elsewhere[k].time;
      EXPECT_NEAR(b.estimate.v.w, a.estimate.v.w, 0.02) << elsewhere[k].time;
    }
    const PlanarPose there = chained(trial.displacement, elsewhere.back().p);
    EXPECT_LT(distance(elsewhere.back().result.estimate.p, there), 0.02);
    EXPECT_NEAR(wrap_angle(displacement.phi - trial.displacement.phi), 0, 0.05);
  }
}

}  // namespace
}  // namespace mrroc::rex::test
