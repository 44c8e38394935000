// The first estimator of Rex: moving horizon estimation of state and slip coefficients (paper REX, sec. 3.2: the state
// estimator of the virtual effector).
#pragma once
#include <array>

#include "robots/ocp/ocp_qp.hpp"
#include "robots/rex/stage_belief.hpp"

namespace mrroc::rex {

/// Moving horizon estimator. Over the window of stages k = 0..M it looks for states z_k and noise w_k with
///
///     min |z_0 - zbar|^2 in P^-1 + sum |w_k|^2 + sum |h(z_k) - y_k|^2    z_(k+1) = f(z_k) + diag(deviation) w_k
///
/// all in units of their standard deviations, mu and split within SlipBounds; one Gauss-Newton step over the whole window
/// per stage, by direct multiple shooting. The stage that leaves makes a step of the extended Kalman filter from (zbar, P):
/// the arrival cost. Until the window is full the filter alone estimates. The QP is solved without bounds first: it is done
/// when what it finds is within them, as it nearly always is, at a third of the price. When it is not solved, the states are
/// kept as the model predicts them.
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

  [[nodiscard]] StageVector& z(int k) noexcept { return z_[static_cast<std::size_t>(k)]; }
  [[nodiscard]] const StageVector& z(int k) const noexcept { return z_[static_cast<std::size_t>(k)]; }
  /// Takes the oldest stage's measurements into the arrival cost, before it leaves.
  void leave() noexcept;
  /// Filters over a window that is not full.
  void fill() noexcept;
  void linearise() noexcept;
  /// @return result of the QP, whose solution has changed the states when it is ok
  [[nodiscard]] ocp::QpResult improve() noexcept;
  void set_problem(ocp::OcpQp& qp) const noexcept;
  void set_bounds() noexcept;
  [[nodiscard]] bool within_bounds() const noexcept;
  void update_covariance() noexcept;

  StageWindow window_;
  StageBelief arrival_{};               // of the oldest stage, before its own measurements
  std::array<StageVector, kStages> z_;  // estimates of the stages
  std::array<StageResiduals, kStages> residuals_;
  std::array<StageTransition, kStages> transitions_;  // the last one means nothing
  ocp::OcpQp free_;                                   // without bounds
  ocp::OcpQp bounded_;                                // with those of the slip coefficients
  StageBelief newest_{};
  int steps_to_covariance_{};
  bool inconsistent_{};  // since the last step
};

}  // namespace mrroc::rex
