// The first estimator of Rex: moving horizon estimation of state and slip coefficients (paper REX, sec. 3.2: the state
// estimator of the virtual effector).
#pragma once
#include <array>

#include "robots/ocp/ocp_qp.hpp"
#include "robots/rex/displacement.hpp"
#include "robots/rex/window_states.hpp"

namespace mrroc::rex {

/// Slip coefficients of a stage that are held at their bounds.
struct HeldSlip {
  Eigen::Vector3d weight = Eigen::Vector3d::Zero();  ///< 0: free
  Eigen::Vector3d bound = Eigen::Vector3d::Zero();   ///< where it is held; means nothing where it is free
};

/// Moving horizon estimator. Over the window of stages k = 0..M it looks for states z_k and noise w_k with
///
///     min |z_0 - zbar|^2 in P^-1 + sum |w_k|^2 + sum |h(z_k) - y_k|^2    z_(k+1) = f(z_k) + diag(deviation) w_k
///
/// all in units of their standard deviations; one Gauss-Newton step over the whole window per stage, by direct multiple
/// shooting. The stage that leaves makes a step of the extended Kalman filter from (zbar, P): the arrival cost. Until the
/// window is full the filter alone estimates.
///
/// Slip coefficients stay within SlipBounds: where the step takes one beyond its bound, it is held there and the step is
/// computed once more. That is one iteration of an active set method, and nearly always none is needed; an interior point
/// method takes ten times as long for the same. When the QP is not solved, the states are kept as the model predicts them.
///
/// Friction saturates with slip, and whole steps into saturation and back overshoot, as Newton's do on arctan: where the
/// ground changes, step after step would lead further away. A step that makes the sum larger is therefore halved, at most twice.
class Mhe final : public edp::Estimator {
 public:
  /// Takes all memory. @throws std::bad_alloc
  explicit Mhe(const EstimatorNoise& noise = {});

  void begin(const edp::StandingStill& found) noexcept override;
  void add(const edp::StageReading& reading) noexcept override;
  bool add(const OdometryReading& odometry) noexcept override;
  bool add(const MapPose& pose) noexcept override;
  edp::EstimatorResult step() noexcept override;

 private:
  static constexpr auto kStages = static_cast<std::size_t>(kWindowStages);

  /// Moves all that is believed, as a whole. @param k  stage whose map pose says so
  void displace(const Displacement& displacement) noexcept;
  /// Takes the oldest stage's measurements into the arrival cost, before it leaves.
  void leave() noexcept;
  /// Filters over a window that is not full.
  void fill() noexcept;
  /// Solves the QP and corrects the states.
  void improve(edp::Health& health) noexcept;
  void set_dynamics() noexcept;
  void set_costs() noexcept;
  /// @return whether the solution is one, all of its numbers finite
  [[nodiscard]] bool solve() noexcept;
  /// @return whether a slip coefficient is to be held that was free
  [[nodiscard]] bool hold_slip() noexcept;
  void update_covariance() noexcept;

  StageWindow window_;
  StageBelief arrival_{};                               // of the oldest stage, before its own measurements
  StageMatrix arrival_root_ = StageMatrix::Identity();  // L with L L' = P of it
  WindowStates z_;                                      // estimates of the stages
  std::array<HeldSlip, kStages> held_;
  WindowStates::Change change_;  // what the QP says
  ocp::OcpQp qp_;
  StageBelief newest_{};
  int steps_to_covariance_{};
  bool inconsistent_{};      // since the last step
  PlanarPose displacement_;  // since the last step
};

}  // namespace mrroc::rex
