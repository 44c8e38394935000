// Inputs of estimators that no platform would give, and all that an answer says.
#pragma once
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "edp/platform/platform.hpp"

namespace mrroc::rex::test {

/// Numbers from plausible to very large, now and then not finite.
class WildNumbers {
 public:
  explicit WildNumbers(unsigned seed) : random_(seed) {}

  double operator()() {
    const int kind = std::uniform_int_distribution<>(0, 19)(random_);
    const double unit = std::uniform_real_distribution<>(-1, 1)(random_);
    if (kind == 0) return std::numeric_limits<double>::quiet_NaN();
    if (kind == 1) return std::copysign(std::numeric_limits<double>::infinity(), unit);
    if (kind < 6) return unit * std::pow(10.0, std::uniform_real_distribution<>(0, 308)(random_));
    return unit * std::pow(10.0, std::uniform_real_distribution<>(-6, 2)(random_));
  }
  template <class Numbers>
  void fill(Numbers& numbers) {
    for (double& number : numbers) number = (*this)();
  }
  bool flag() { return std::bernoulli_distribution(0.8)(random_); }
  std::int64_t step_near(std::int64_t step) {
    return step - 10 * std::uniform_int_distribution<>(-1, 25)(random_);
  }

 private:
  std::mt19937_64 random_;
};

inline edp::StandingStill wild_rest(WildNumbers& wild) {
  edp::StandingStill rest{
      .step = 0, .p = {wild(), wild(), wild()}, .yaw_offset = wild(), .gyro_bias = wild()};
  wild.fill(rest.covariance);
  wild.fill(rest.load);
  wild.fill(rest.theta);
  return rest;
}

inline edp::StageReading wild_reading(WildNumbers& wild, std::int64_t step) {
  edp::StageReading reading{.step = step, .yaw = wild(), .yaw_rate = wild(), .imu_valid = wild.flag()};
  wild.fill(reading.theta);
  wild.fill(reading.theta_dot);
  wild.fill(reading.load);
  wild.fill(reading.torque);
  reading.enabled = wild.flag();
  return reading;
}

/// Its covariance is often that of a measurement, else it would always be refused.
inline MapPose wild_pose(WildNumbers& wild, std::int64_t step) {
  MapPose pose{.step = wild.step_near(step), .valid = wild.flag(), .p = {wild(), wild(), wild()}};
  if (!wild.flag()) wild.fill(pose.covariance);
  return pose;
}

inline OdometryReading wild_motion(WildNumbers& wild, std::int64_t step) {
  OdometryReading motion{
      .step_before = wild.step_near(step - 40), .step = wild.step_near(step), .valid = wild.flag()};
  wild.fill(motion.A);
  if (!wild.flag()) wild.fill(motion.covariance);
  return motion;
}

/// @return all numbers of an answer
inline std::vector<double> numbers_of(const edp::EstimatorResult& result) {
  const PlatformEstimate& e = result.estimate;
  std::vector<double> all{static_cast<double>(e.step), e.p.x, e.p.y, e.p.phi, e.v.vx, e.v.vy, e.v.w};
  all.insert(all.end(), e.theta.begin(), e.theta.end());
  all.insert(all.end(), e.theta_dot.begin(), e.theta_dot.end());
  all.insert(all.end(), e.covariance.begin(), e.covariance.end());
  for (const Slip& slip : {result.slip, result.slip_sd})
    all.insert(all.end(), {slip.mu_x, slip.mu_y, slip.split});
  all.insert(all.end(), {result.mass, result.centre.x, result.centre.y});
  const edp::Health& health = result.health;
  for (const int number :
       {int{health.ok}, int{health.solver_failed}, int{health.inconsistent}, health.iterations})
    all.push_back(number);
  return all;
}

inline bool is_finite(const edp::EstimatorResult& result) {
  for (const double number : numbers_of(result))
    if (!std::isfinite(number)) return false;
  return true;
}

}  // namespace mrroc::rex::test
