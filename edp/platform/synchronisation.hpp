// SYNCHRO of a platform: what must be known at rest before it may move.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "edp/platform/parameters.hpp"
#include "edp/platform/platform.hpp"
#include "edp/platform/stage_collector.hpp"

namespace mrroc::edp {

/// Lets the platform stand, resets the IMU, takes its drift and the loads of the wheels for a while, then the position on the
/// map from several poses that agree. A platform that is pushed meanwhile begins anew. Real-time safe.
class PlatformSynchronisation {
 public:
  /// Wheels that stay within so many increments have not turned.
  static constexpr double kPlay = 2;
  /// Poses of the map that are wanted.
  static constexpr int kPoses = 5;
  /// They agree within this distance [m] and this angle [rad].
  static constexpr double kAgree = 0.1;
  /// The IMU has obeyed its reset after so many steps.
  static constexpr int kResetSteps = 10;

  /// @param dt  duration of a step [s]
  PlatformSynchronisation(const PlatformDriverParameters& parameters, double dt) noexcept;

  /// Begins.
  void start() noexcept;
  /// A step, after the collector has taken its reading.
  void step(const StageCollector& sensors) noexcept;
  /// A pose of the map that can be used and has not been given before.
  void add(const MapPose& pose) noexcept;

  /// @return whether the IMU is to be reset in this step
  [[nodiscard]] bool resets_imu() const noexcept { return standing_ == 1; }
  /// @return everything, once it is known
  [[nodiscard]] std::optional<StandingStill> found(const StageCollector& sensors,
                                                   std::int64_t step) const noexcept;
  /// @return why it has failed: sensor_silent, when load cells or IMU have told too little; position_unknown, when it has
  ///         taken too long
  [[nodiscard]] std::optional<Fault> failed() const noexcept;

 private:
  [[nodiscard]] bool measured() const noexcept { return standing_ >= rest_steps_ + kResetSteps; }
  void stand_anew(const StageCollector& sensors) noexcept;
  void forget_poses() noexcept { poses_ = 0; }

  int rest_steps_;
  int timeout_steps_;
  int steps_{};     // since the start
  int standing_{};  // steps since the wheels have turned
  std::int64_t stands_since_{};
  PerWheel away_{};  // from where they stood then [increments]
  double yaw_rate_sum_{};
  int yaw_rates_{};
  PerWheel load_sum_{};
  int loads_{};
  PlanarPose first_{};
  PlanarPose sum_{};  // of the poses, relative to the first one
  PlanarCovariance covariance_sum_{};
  int poses_{};
};

}  // namespace mrroc::edp
