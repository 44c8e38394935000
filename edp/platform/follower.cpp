#include "edp/platform/follower.hpp"

#include <algorithm>
#include <cmath>

#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

/// Rounding of torques at the limit, as a share.
constexpr double kRounding = 1e-9;

}  // namespace

void Follower::begin(const EstimatorResult& x) noexcept {
  tracker_->begin(x);
  result_ = {};
  result_.horizon.fill(x.estimate.p);
  torque_ = {};
  failed_ = planned_ = 0;
}

bool Follower::is_usable(const TrackerResult& result) const noexcept {
  const double most = platform_->max_torque * (1 + kRounding);
  const auto fits = [most](const PerWheel& torque) {
    return std::ranges::all_of(torque, [most](double t) { return std::abs(t) <= most; });
  };
  const auto is_pose = [](const PlanarPose& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.phi);
  };
  return result.health.ok && fits(result.torque) && std::ranges::all_of(result.torques, fits) &&
         std::ranges::all_of(result.horizon, is_pose);
}

PerWheel Follower::planned() const noexcept {
  const double period = planned_ * kPlatformPeriod / platform_->horizon_period;
  return result_.torques[std::min(static_cast<std::size_t>(period), result_.torques.size() - 1)];
}

std::optional<Fault> Follower::step(const EstimatorResult& x, const Slip& slip, const PerWheel& load,
                                    const Reference& reference) noexcept {
  const TrackerResult result = tracker_->step(x, slip, load, reference);
  const bool usable = is_usable(result);
  const bool failed = !usable || result.health.solver_failed;
  failed_ = failed ? failed_ + 1 : 0;
  failures_ += failed;
  if (usable) result_ = result;
  planned_ = usable ? 0 : planned_ + 1;
  torque_ = usable ? result.torque : planned();
  if (failed_ < kFailures) return {};
  return make_fault(FaultCode::solver_failed, "failures of the tracker in succession", -1, failed_,
                    kFailures);
}

}  // namespace mrroc::edp
