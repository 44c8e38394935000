#include "test/contract/platform_contract.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "test/heap.hpp"

namespace mrroc::contract {

using edp::EstimatorResult;
using edp::StageReading;
using edp::StandingStill;
using edp::TrackerResult;

StandingStill PlatformContract::standing() {
  StandingStill found;
  found.covariance = {1e-6, 0, 0, 0, 1e-6, 0, 0, 0, 1e-6};
  found.load.fill(100);
  return found;
}

StageReading PlatformContract::rest(int stage) {
  StageReading reading;
  reading.step = static_cast<std::int64_t>(stage) * kPlatformSteps;
  reading.imu_valid = true;
  reading.load.fill(100);
  return reading;
}

StageReading PlatformContract::random_stage(int stage) {
  StageReading reading = rest(stage);
  for (std::size_t k = 0; k < kWheels; ++k) {
    reading.theta[k] = uniform(-20, 20);
    reading.theta_dot[k] = uniform(-1, 1) * q_.max_wheel_speed;
    reading.load[k] = uniform(0, 200);
    reading.torque[k] = uniform(-1, 1) * q_.max_torque;
  }
  reading.yaw = uniform(-10, 10);
  reading.yaw_rate = uniform(-3, 3);
  reading.imu_valid = random_() % 10 != 0;
  reading.enabled = random_() % 4 != 0;
  return reading;
}

MapPose PlatformContract::random_map(int stage) {
  MapPose pose;
  pose.valid = true;
  pose.step = static_cast<std::int64_t>(stage) * kPlatformSteps - static_cast<std::int64_t>(random_() % 300);
  pose.p = {uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
  pose.covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4};
  return pose;
}

OdometryReading PlatformContract::random_odometry(int stage) {
  OdometryReading reading;
  reading.valid = true;
  reading.step = (stage - static_cast<std::int64_t>(random_() % 25)) * kPlatformSteps;
  reading.step_before = reading.step - 40;
  const double turn = uniform(-0.2, 0.2);
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  reading.A = {c, -s, 0, uniform(-0.1, 0.1), s, c, 0, uniform(-0.1, 0.1), 0, 0, 1, 0};
  for (std::size_t k = 0; k < 6; ++k) reading.covariance[7 * k] = 4e-6;
  return reading;
}

EstimatorResult PlatformContract::random_state() {
  EstimatorResult x;
  x.estimate.p = {uniform(-3, 3), uniform(-3, 3), uniform(-3.14, 3.14)};
  x.estimate.v = {uniform(-1, 1) * q_.max_speed, uniform(-0.2, 0.2), uniform(-1, 1) * q_.max_turn_rate};
  for (std::size_t k = 0; k < kWheels; ++k) {
    const double side = k % 2 == 0 ? -1 : 1;
    x.estimate.theta_dot[k] =
        (x.estimate.v.vx + side * q_.half_track * x.estimate.v.w) / q_.wheel_radius + uniform(-1, 1);
  }
  x.slip_sd = {0.1, 0.1, 0.1};
  x.mass = uniform(30, 50);
  x.centre = {uniform(-0.06, 0.06), uniform(-0.06, 0.06), 0};
  return x;
}

std::array<PathPoint, kHorizonPoints> PlatformContract::random_reference(const EstimatorResult& x) {
  const double v = uniform(-1, 1) * q_.max_speed;
  const double most = std::min(q_.max_turn_rate, q_.max_lateral_acceleration / std::max(std::abs(v), 1e-3));
  const double w = uniform(-most, most);
  PathPoint point{
      {x.estimate.p.x + uniform(-0.2, 0.2), x.estimate.p.y + uniform(-0.2, 0.2),
       x.estimate.p.phi + uniform(-0.5, 0.5) + 6.283185307179586 * static_cast<double>(random_() % 3)},
      v,
      w};
  std::array<PathPoint, kHorizonPoints> reference{};
  for (PathPoint& next : reference) {
    next = point;
    point.p.phi += w * q_.horizon_period;
    point.p.x += v * q_.horizon_period * std::cos(point.p.phi);
    point.p.y += v * q_.horizon_period * std::sin(point.p.phi);
  }
  return reference;
}

namespace {

constexpr int kStages = 300;
constexpr int kCases = 300;
/// More iterations than any solver may take in a macrostep.
constexpr int kMostIterations = 200;

std::vector<double> numbers(const EstimatorResult& r) {
  const PlatformEstimate& e = r.estimate;
  std::vector<double> all{e.p.x, e.p.y, e.p.phi, e.v.vx, e.v.vy, e.v.w};
  for (const PerWheel& wheels : {e.theta, e.theta_dot}) all.insert(all.end(), wheels.begin(), wheels.end());
  all.insert(all.end(), e.covariance.begin(), e.covariance.end());
  for (const Slip& slip : {r.slip, r.slip_sd}) all.insert(all.end(), {slip.mu_x, slip.mu_y, slip.split});
  all.insert(all.end(), {r.mass, r.centre.x, r.centre.y});
  return all;
}

std::vector<double> numbers(const TrackerResult& r) {
  std::vector<double> all(r.torque.begin(), r.torque.end());
  for (const PerWheel& torque : r.torques) all.insert(all.end(), torque.begin(), torque.end());
  for (const PlanarPose& p : r.horizon) all.insert(all.end(), {p.x, p.y, p.phi});
  return all;
}

template <class Result>
bool is_finite(const Result& result) {
  return std::ranges::all_of(numbers(result), [](double x) { return std::isfinite(x); });
}

bool makes_sense(const Slip& slip) { return slip.mu_x > 0 && slip.mu_y > 0 && std::abs(slip.split) < 1; }

template <class Result>
bool equal_bits(const Result& a, const Result& b) {
  return std::ranges::equal(numbers(a), numbers(b), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

}  // namespace

TEST_P(PlatformContract, PropertiesMakeSense) {
  EXPECT_FALSE(q_.name.empty());
  for (const double positive :
       {q_.wheel_radius, q_.half_track, q_.increments_per_turn, q_.max_torque, q_.max_wheel_speed,
        q_.max_speed, q_.max_turn_rate, q_.max_lateral_acceleration, q_.horizon_period})
    EXPECT_GT(positive, 0);
  EXPECT_GE(q_.brake, 0);
  EXPECT_GE(q_.max_wheel_speed * q_.wheel_radius, q_.max_speed)
      << "the wheels can be as quick as the platform may be";
}

TEST_P(PlatformContract, MakesWhatItNamesAndNothingElse) {
  ASSERT_FALSE(platform_->estimators().empty());
  ASSERT_FALSE(platform_->trackers().empty());
  for (const auto& kinds : {platform_->estimators(), platform_->trackers()})
    EXPECT_EQ(std::set<std::string_view>(kinds.begin(), kinds.end()).size(), kinds.size());
  for (const std::string_view kind : platform_->estimators())
    EXPECT_NE(platform_->estimator(kind), nullptr) << kind;
  for (const std::string_view kind : platform_->trackers())
    EXPECT_NE(platform_->tracker(kind), nullptr) << kind;
  for (const std::string_view none : {"", "no such kind"}) {
    EXPECT_THROW(std::ignore = platform_->estimator(none), std::invalid_argument);
    EXPECT_THROW(std::ignore = platform_->tracker(none), std::invalid_argument);
  }
}

TEST_P(PlatformContract, AStandingPlatformIsEstimatedToStand) {
  for (const std::string_view kind : platform_->estimators()) {
    const auto estimator = platform_->estimator(kind);
    estimator->begin(standing());
    for (int stage = 1; stage <= kStages; ++stage) {
      estimator->add(rest(stage));
      const EstimatorResult r = estimator->step();
      ASSERT_TRUE(r.health.ok) << kind << ", stage " << stage;
      ASSERT_EQ(r.estimate.step, stage * static_cast<std::int64_t>(kPlatformSteps));
      ASSERT_LT(std::hypot(r.estimate.p.x, r.estimate.p.y), 0.01) << kind << ", stage " << stage;
      ASSERT_LT(std::abs(r.estimate.p.phi), 0.02) << kind << ", stage " << stage;
      ASSERT_LT(std::hypot(r.estimate.v.vx, r.estimate.v.vy), 0.02) << kind << ", stage " << stage;
      ASSERT_NEAR(r.mass, 400 / 9.81, 0.1) << kind << ": it was weighed";
      ASSERT_TRUE(makes_sense(r.slip)) << kind << ", stage " << stage;
      const PlanarCovariance& C = r.estimate.covariance;
      ASSERT_TRUE(C[0] > 0 && C[4] > 0 && C[8] > 0) << kind;
      ASSERT_NEAR(C[1], C[3], 1e-9);
    }
  }
}

TEST_P(PlatformContract, AStandingPlatformThatIsToStandGetsHardlyAnyTorque) {
  EstimatorResult x;
  x.mass = 400 / 9.81;
  std::array<PathPoint, kHorizonPoints> reference{};
  for (const std::string_view kind : platform_->trackers()) {
    const auto tracker = platform_->tracker(kind);
    tracker->begin(x);
    for (int k = 0; k < 20; ++k) {
      const TrackerResult r = tracker->step(x, {}, {100, 100, 100, 100}, reference);
      ASSERT_TRUE(r.health.ok) << kind;
      for (const double torque : r.torque) ASSERT_LT(std::abs(torque), 0.05 * q_.max_torque) << kind;
    }
  }
}

TEST_P(PlatformContract, EstimatorsGiveEqualBitsForEqualInputsAndNothingThatIsNotFinite) {
  for (const std::string_view kind : platform_->estimators()) {
    const auto one = platform_->estimator(kind);
    const auto other = platform_->estimator(kind);
    one->begin(standing());
    other->begin(standing());
    for (int stage = 1; stage <= kStages; ++stage) {
      const StageReading reading = random_stage(stage);
      one->add(reading);
      other->add(reading);
      if (random_() % 4 == 0) {
        const MapPose pose = random_map(stage);
        EXPECT_EQ(one->add(pose), other->add(pose)) << kind;
      }
      if (random_() % 4 == 0) {
        const OdometryReading odometry = random_odometry(stage);
        EXPECT_EQ(one->add(odometry), other->add(odometry)) << kind;
      }
      const EstimatorResult r = one->step();
      ASSERT_TRUE(equal_bits(r, other->step())) << kind << ", stage " << stage;
      ASSERT_TRUE(is_finite(r) || !r.health.ok) << kind << ", stage " << stage;
      ASSERT_TRUE(makes_sense(r.slip) || !r.health.ok) << kind << ", stage " << stage;
      ASSERT_LE(r.health.iterations, kMostIterations) << kind;
    }
  }
}

TEST_P(PlatformContract, MeasurementsOutsideOfTheWindowAreIgnored) {
  for (const std::string_view kind : platform_->estimators()) {
    const auto estimator = platform_->estimator(kind);
    estimator->begin(standing());
    for (int stage = 1; stage <= 200; ++stage) {
      estimator->add(rest(stage));
      std::ignore = estimator->step();
    }
    MapPose pose = random_map(200);
    for (const std::int64_t step : {std::int64_t{0}, std::int64_t{100}, std::int64_t{2'500}}) {
      pose.step = step;
      EXPECT_FALSE(estimator->add(pose)) << kind << ", step " << step;
    }
    pose.step = 2'000;
    EXPECT_TRUE(estimator->add(pose)) << kind;
    OdometryReading odometry = random_odometry(200);
    odometry.step = 100;
    odometry.step_before = 60;
    EXPECT_FALSE(estimator->add(odometry)) << kind;
  }
}

TEST_P(PlatformContract, EstimatorsBeginAnew) {
  for (const std::string_view kind : platform_->estimators()) {
    const auto used = platform_->estimator(kind);
    const auto fresh = platform_->estimator(kind);
    used->begin(standing());
    for (int stage = 1; stage <= 50; ++stage) {
      used->add(random_stage(stage));
      std::ignore = used->step();
    }
    used->begin(standing());
    fresh->begin(standing());
    for (int stage = 1; stage <= 30; ++stage) {
      used->add(rest(stage));
      fresh->add(rest(stage));
      ASSERT_TRUE(equal_bits(used->step(), fresh->step())) << kind << ", stage " << stage;
    }
  }
}

TEST_P(PlatformContract, TrackersGiveEqualBitsForEqualInputsAndTorquesWithinTheLimit) {
  for (const std::string_view kind : platform_->trackers()) {
    const auto one = platform_->tracker(kind);
    const auto other = platform_->tracker(kind);
    for (int k = 0; k < kCases; ++k) {
      const EstimatorResult x = random_state();
      const auto reference = random_reference(x);
      const Slip slip{uniform(0.1, 1), uniform(0.1, 1), uniform(-0.6, 0.6)};
      const PerWheel load{uniform(50, 150), uniform(50, 150), uniform(50, 150), uniform(50, 150)};
      if (k % 10 == 0) {
        one->begin(x);
        other->begin(x);
      }
      const TrackerResult r = one->step(x, slip, load, reference);
      ASSERT_TRUE(equal_bits(r, other->step(x, slip, load, reference))) << kind << ", case " << k;
      ASSERT_LE(r.health.iterations, kMostIterations) << kind;
      if (!r.health.ok) continue;
      ASSERT_TRUE(is_finite(r)) << kind << ", case " << k;
      for (const double torque : r.torque) ASSERT_LE(std::abs(torque), q_.max_torque * (1 + 1e-9)) << kind;
      for (const PerWheel& torques : r.torques)
        for (const double torque : torques) ASSERT_LE(std::abs(torque), q_.max_torque * (1 + 1e-9)) << kind;
    }
  }
}

TEST_P(PlatformContract, StepsTakeNoMemory) {
  for (const std::string_view kind : platform_->estimators()) {
    const auto estimator = platform_->estimator(kind);
    const test::AllocationCounter heap;
    estimator->begin(standing());
    for (int stage = 1; stage <= 60; ++stage) {
      estimator->add(random_stage(stage));
      std::ignore = estimator->add(random_map(stage));
      std::ignore = estimator->add(random_odometry(stage));
      std::ignore = estimator->step();
    }
    EXPECT_EQ(heap.count(), 0) << kind;
  }
  for (const std::string_view kind : platform_->trackers()) {
    const auto tracker = platform_->tracker(kind);
    const test::AllocationCounter heap;
    for (int k = 0; k < 60; ++k) {
      const EstimatorResult x = random_state();
      if (k % 20 == 0) tracker->begin(x);
      std::ignore = tracker->step(x, {}, {100, 100, 100, 100}, random_reference(x));
    }
    EXPECT_EQ(heap.count(), 0) << kind;
  }
}

}  // namespace mrroc::contract
