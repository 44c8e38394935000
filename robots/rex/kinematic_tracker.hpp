// The second, simple tracker of Rex: a kinematic law above regulators of the wheels' speeds.
#pragma once
#include "edp/platform/platform.hpp"

namespace mrroc::rex {

/// Tracks a reference as if the platform were a unicycle: Kanayama's law (Kanayama et al., "A stable tracking control method
/// for an autonomous mobile robot", 1990)
///
///     v = v_d cos e_phi + k_x e_x      w = w_d + v_d (k_y e_y + k_phi sin e_phi) + k_turn e_phi
///
/// with errors along B, whose last term also turns a platform that stands; wheels roll at (v -+ b w) / r with a track b that is
/// wider than the real one by what skidding costs; PI regulators make torques of their speeds. It knows nothing of slip, loads
/// and the future: what model predictive control is measured against.
class KinematicTracker final : public edp::Tracker {
 public:
  void begin(const edp::EstimatorResult& x) noexcept override;
  /// @param slip, load  not used
  edp::TrackerResult step(const edp::EstimatorResult& x, const Slip& slip, const PerWheel& load,
                          std::span<const PathPoint, kHorizonPoints> reference) noexcept override;

 private:
  PerWheel integral_{};  // of the wheels' speed errors [rad]
};

}  // namespace mrroc::rex
