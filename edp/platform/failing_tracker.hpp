// A tracker that fails on purpose, to try what a driver does then.
#pragma once
#include <memory>
#include <utility>

#include "base/step_interval.hpp"
#include "edp/platform/platform.hpp"

namespace mrroc::edp {

/// Tracks as the one that it has, but says while some steps last that its solver has found nothing. Real-time safe.
class FailingTracker final : public Tracker {
 public:
  /// @param tracker  not null  @param fails  steps of the estimates with which it does
  FailingTracker(std::unique_ptr<Tracker> tracker, const StepInterval& fails)
      : tracker_(std::move(tracker)), fails_(fails) {}

  void begin(const EstimatorResult& x) noexcept override { tracker_->begin(x); }
  TrackerResult step(const EstimatorResult& x, const Slip& slip, const PerWheel& load,
                     std::span<const PathPoint, kHorizonPoints> reference) noexcept override {
    TrackerResult result = tracker_->step(x, slip, load, reference);
    if (fails_.contains(x.estimate.step)) result.health = {.ok = false, .solver_failed = true};
    return result;
  }

 private:
  std::unique_ptr<Tracker> tracker_;
  StepInterval fails_;
};

}  // namespace mrroc::edp
