// The trajectory tracker of a platform's driver, and what stands in for it when it fails.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "edp/platform/platform.hpp"
#include "edp/platform/reference.hpp"

namespace mrroc::edp {

/// Asks the tracker for torques and judges them. When it fails, its last plan goes on for a while. Everything but the
/// constructor is real-time safe.
class Follower {
 public:
  /// Failures in succession that are a fault.
  static constexpr int kFailures = 5;

  /// @param tracker  not null  @param platform  lives longer than this object
  Follower(std::unique_ptr<Tracker> tracker, const PlatformProperties& platform)
      : tracker_(std::move(tracker)), platform_(&platform) {}

  /// The platform stands there, and is to be driven from now on.
  void begin(const EstimatorResult& x) noexcept;
  /// One iteration, as Tracker::step has it.
  /// @return solver_failed, or nothing
  [[nodiscard]] std::optional<Fault> step(const EstimatorResult& x, const Slip& slip, const PerWheel& load,
                                          const Reference& reference) noexcept;

  /// @return for the macrostep [N m], finite and within the limit
  [[nodiscard]] const PerWheel& torque() const noexcept { return torque_; }
  /// @return of the last step whose torques could be used
  [[nodiscard]] const TrackerResult& result() const noexcept { return result_; }
  /// @return steps in which the solver has failed, so far
  [[nodiscard]] std::int32_t failures() const noexcept { return failures_; }

 private:
  [[nodiscard]] bool is_usable(const TrackerResult& result) const noexcept;
  [[nodiscard]] PerWheel planned() const noexcept;

  std::unique_ptr<Tracker> tracker_;
  const PlatformProperties* platform_;
  TrackerResult result_{};
  PerWheel torque_{};
  int failed_{};   // in succession
  int planned_{};  // iterations since the plan was made
  std::int32_t failures_{};
};

}  // namespace mrroc::edp
