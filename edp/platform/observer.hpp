// The state estimator of a platform's driver, and what it is given from outside: positions and odometry.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "edp/platform/parameters.hpp"
#include "edp/platform/platform.hpp"

namespace mrroc::edp {

/// Feeds the estimator and judges what it says. Everything but the constructor is real-time safe.
class Observer {
 public:
  /// Failures of the estimator in succession that are a fault.
  static constexpr int kFailures = 5;
  /// Map poses in succession that contradict the estimate, from which it counts as lost.
  static constexpr int kInconsistent = 25;
  /// Standard deviation of the position from which it counts as lost [m].
  static constexpr double kLost = 0.5;
  /// Stages that may be missed in succession, by the wall clock.
  static constexpr int kMissed = 25;
  /// The estimated slip is used from where all of its standard deviations are below the first number, until one is above the
  /// second.
  static constexpr double kCertain = 0.15;
  static constexpr double kUncertain = 0.3;

  /// @param estimator  not null
  Observer(std::unique_ptr<Estimator> estimator, const PlatformDriverParameters& parameters)
      : estimator_(std::move(estimator)), adapt_(parameters.adapt), nominal_(parameters.nominal) {}

  /// Keeps what is newest of the unnumbered parts of a command of the owner.
  void note(const PlatformCommand& command) noexcept;
  /// @param now  step of the newest reading
  /// @return a map pose that has come since the last call and can be used. What cannot is counted
  [[nodiscard]] std::optional<MapPose> take_map(std::int64_t now) noexcept;

  /// The platform stands.
  void begin(const StandingStill& found) noexcept;
  /// A new stage, with the map pose and the odometry that have come. Stages that were missed before it are filled in.
  /// @param now  step of the newest reading
  /// @return estimate_lost, or nothing
  [[nodiscard]] std::optional<Fault> step(const StageReading& stage, std::int64_t now) noexcept;

  /// @return whether there has been a result that can be used since begin()
  [[nodiscard]] bool known() const noexcept { return known_; }
  /// @return of the newest step whose result can be used
  [[nodiscard]] const EstimatorResult& result() const noexcept { return result_; }
  /// @return slip that the tracker is to use: friction is at most the nominal one
  [[nodiscard]] const Slip& slip() const noexcept { return slip_; }
  /// @return whether that is the estimated one
  [[nodiscard]] bool adapting() const noexcept { return adapting_; }
  /// @return of the newest step, whether it could be used or not
  [[nodiscard]] const Health& health() const noexcept { return health_; }

  /// @return as PlatformReply has them
  [[nodiscard]] std::int32_t late_odometry() const noexcept { return late_odometry_; }
  [[nodiscard]] std::int32_t late_map() const noexcept { return late_map_; }
  [[nodiscard]] std::int32_t rejected() const noexcept { return rejected_; }
  [[nodiscard]] std::int32_t failures() const noexcept { return failures_; }
  /// A part of a command that is no proper number has been dropped.
  void reject() noexcept { ++rejected_; }

 private:
  [[nodiscard]] bool add_stages(const StageReading& stage) noexcept;
  void add_odometry(std::int64_t now) noexcept;
  void add_map(std::int64_t now) noexcept;
  void adapt() noexcept;
  [[nodiscard]] std::optional<Fault> judge() noexcept;

  std::unique_ptr<Estimator> estimator_;
  bool adapt_;
  Slip nominal_;
  Slip slip_{nominal_};
  EstimatorResult result_{};
  Health health_{};
  StageReading last_stage_{};
  bool known_{};
  bool adapting_{};
  MapPose map_{};               // newest
  OdometryReading odometry_{};  // newest
  bool new_map_{};
  bool new_odometry_{};
  bool map_added_{};  // in this step
  std::int64_t map_step_{-1};
  std::int64_t odometry_step_{-1};
  int failed_{};        // in succession
  int inconsistent_{};  // in succession
  std::int32_t late_odometry_{};
  std::int32_t late_map_{};
  std::int32_t rejected_{};
  std::int32_t failures_{};
};

}  // namespace mrroc::edp
