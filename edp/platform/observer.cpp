#include "edp/platform/observer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edp/platform/guard.hpp"

namespace mrroc::edp {
namespace {

/// Bounds of a slip that a tracker can use.
constexpr double kLeastFriction = 0.02;
constexpr double kMostFriction = 2;
constexpr double kMostSplit = 0.9;

/// @return the estimate, but no more friction than the nominal one: rolling wheels tell of friction by slip alone, and a ground
///         that is stiffer than the model looks like one that holds better
Slip believed(const Slip& estimate, const Slip& nominal) noexcept {
  return {std::min(estimate.mu_x, nominal.mu_x), std::min(estimate.mu_y, nominal.mu_y), estimate.split};
}

template <class... Numbers>
bool are_finite(Numbers... numbers) {
  return (std::isfinite(numbers) && ...);
}

bool are_finite(const PerWheel& numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

bool is_usable(const EstimatorResult& r) {
  const PlatformEstimate& e = r.estimate;
  return r.health.ok && are_finite(e.p.x, e.p.y, e.p.phi, e.v.vx, e.v.vy, e.v.w) && are_finite(e.theta) &&
         are_finite(e.theta_dot) &&
         std::ranges::all_of(e.covariance, [](double x) { return std::isfinite(x); }) &&
         are_finite(r.slip.mu_x, r.slip.mu_y, r.slip.split) &&
         are_finite(r.slip_sd.mu_x, r.slip_sd.mu_y, r.slip_sd.split) &&
         are_finite(r.mass, r.centre.x, r.centre.y);
}

bool is_usable(const Slip& slip) {
  const auto friction = [](double mu) { return mu >= kLeastFriction && mu <= kMostFriction; };
  return friction(slip.mu_x) && friction(slip.mu_y) && std::abs(slip.split) <= kMostSplit;
}

double largest(const Slip& sd) { return std::max({sd.mu_x, sd.mu_y, sd.split}); }

/// @return the largest standard deviation of the position in any direction [m]
double position_sd(const PlanarCovariance& C) {
  const double mean = (C[0] + C[4]) / 2;
  return std::sqrt(mean + std::hypot((C[0] - C[4]) / 2, C[1]));
}

/// @return what would have been measured at a share of the time from one stage to another
StageReading between(const StageReading& from, const StageReading& to, double share) {
  StageReading stage = to;
  for (std::size_t k = 0; k < kWheels; ++k) stage.theta[k] = std::lerp(from.theta[k], to.theta[k], share);
  if (from.imu_valid) stage.yaw = std::lerp(from.yaw, to.yaw, share);
  return stage;
}

}  // namespace

void Observer::note(const PlatformCommand& command) noexcept {
  const auto is_new = [](const auto& part, const auto& last, bool pending) {
    return part.valid && part.step != last.step && (!pending || part.step > last.step);
  };
  if (is_new(command.map, map_, new_map_)) {
    new_map_ = true;
    map_ = command.map;
  }
  if (is_new(command.odometry, odometry_, new_odometry_)) {
    new_odometry_ = true;
    odometry_ = command.odometry;
  }
}

std::optional<MapPose> Observer::take_map(std::int64_t now) noexcept {
  if (!std::exchange(new_map_, false)) return std::nullopt;
  if (!edp::is_usable(map_, now)) {
    reject();
    return std::nullopt;
  }
  if (map_.step <= map_step_) return std::nullopt;  // an older message that was delayed
  map_step_ = map_.step;
  return map_;
}

void Observer::begin(const StandingStill& found) noexcept {
  estimator_->begin(found);
  last_stage_ = {.step = found.step, .theta = found.theta};
  adapting_ = known_ = false;
  slip_ = nominal_;
  failed_ = inconsistent_ = 0;
}

bool Observer::add_stages(const StageReading& stage) noexcept {
  const std::int64_t stages = (stage.step - last_stage_.step) / kPlatformSteps;
  if (stages > kMissed) return false;
  for (std::int64_t k = 1; k < stages; ++k) {
    StageReading missed = between(last_stage_, stage, static_cast<double>(k) / static_cast<double>(stages));
    missed.step = last_stage_.step + k * kPlatformSteps;
    estimator_->add(missed);
  }
  estimator_->add(stage);
  last_stage_ = stage;
  return true;
}

void Observer::add_odometry(std::int64_t now) noexcept {
  if (!std::exchange(new_odometry_, false)) return;
  if (!edp::is_usable(odometry_, now)) return reject();
  if (odometry_.step <= odometry_step_) return;
  odometry_step_ = odometry_.step;
  if (!estimator_->add(odometry_)) ++late_odometry_;
}

void Observer::add_map(std::int64_t now) noexcept {
  map_added_ = false;
  const std::optional<MapPose> pose = take_map(now);
  if (!pose) return;
  map_added_ = estimator_->add(*pose);
  if (!map_added_) ++late_map_;
}

std::optional<Fault> Observer::step(const StageReading& stage, std::int64_t now) noexcept {
  if (!add_stages(stage)) {
    const std::int64_t missed = (stage.step - last_stage_.step) / kPlatformSteps;
    return make_fault(FaultCode::estimate_lost, "stages missed in succession", -1,
                      static_cast<double>(missed), kMissed);
  }
  add_odometry(now);
  add_map(now);
  const EstimatorResult result = estimator_->step();
  const bool usable = is_usable(result);
  health_ = result.health;
  known_ = known_ || usable;
  if (usable)
    result_ = result;
  else
    result_.displacement = {};
  const bool failed = !usable || health_.solver_failed;
  failed_ = failed ? failed_ + 1 : 0;
  failures_ += failed;
  adapt();
  return judge();
}

void Observer::adapt() noexcept {
  const double sd = largest(result_.slip_sd);
  adapting_ = adapt_ && is_usable(result_.slip) && sd < (adapting_ ? kUncertain : kCertain);
  slip_ = adapting_ ? believed(result_.slip, nominal_) : nominal_;
}

std::optional<Fault> Observer::judge() noexcept {
  if (map_added_) inconsistent_ = health_.inconsistent ? inconsistent_ + 1 : 0;
  if (failed_ >= kFailures)
    return make_fault(FaultCode::estimate_lost, "failures of the estimator in succession", -1, failed_,
                      kFailures);
  if (inconsistent_ >= kInconsistent)
    return make_fault(FaultCode::estimate_lost, "positions in succession that contradict it", -1,
                      inconsistent_, kInconsistent);
  if (const double sd = position_sd(result_.estimate.covariance); !(sd <= kLost))
    return make_fault(FaultCode::estimate_lost, "standard deviation of the position [m]", -1, sd, kLost);
  return {};
}

}  // namespace mrroc::edp
