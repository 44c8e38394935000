// The second estimator of Rex: an extended Kalman filter that goes back to where late measurements belong.
#pragma once
#include <array>

#include "robots/rex/displacement.hpp"
#include "robots/rex/stage_belief.hpp"

namespace mrroc::rex {

/// Extended Kalman filter over the same window, model and noise as Mhe. A late measurement makes it filter again from its
/// stage on, so that the order in which measurements come does not matter. Unlike Mhe it linearises once, where it predicts.
class Ekf final : public edp::Estimator {
 public:
  explicit Ekf(const EstimatorNoise& noise = {}) noexcept : window_(noise) {}

  void begin(const edp::StandingStill& found) noexcept override;
  void add(const edp::StageReading& reading) noexcept override;
  bool add(const OdometryReading& odometry) noexcept override;
  bool add(const MapPose& pose) noexcept override;
  edp::EstimatorResult step() noexcept override;

 private:
  [[nodiscard]] StageBelief& before(int k) noexcept { return before_[static_cast<std::size_t>(k)]; }
  /// Filters from the oldest stage that has changed to the newest one.
  void filter() noexcept;
  /// Moves all that is believed, as a whole. @param k  stage whose map pose says so
  void displace(const Displacement& displacement) noexcept;
  /// Goes from stage k, whose belief with all measurements is newest_, to the next one.
  void go_on(int k) noexcept;

  StageWindow window_;
  std::array<StageBelief, kWindowStages> before_{};  // of each stage before its own measurements
  StageBelief newest_{};                             // with all measurements
  int changed_{};                                    // oldest stage that has changed since filter()
  bool inconsistent_{};                              // since the last step
  PlanarPose displacement_;                          // since the last step
};

}  // namespace mrroc::rex
