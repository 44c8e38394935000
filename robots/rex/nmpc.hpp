// Nonlinear model predictive control of Rex (paper REX, sec. 4: the model-based controller of e_1,1).
#pragma once
#include <array>

#include "edp/platform/platform.hpp"
#include "robots/ocp/ocp_qp.hpp"
#include "robots/rex/model.hpp"

namespace mrroc::rex {

/// Tracks a reference by the torques that, by the model, bring the platform nearest to it over the horizon:
///
///     min  sum_k (q_k - q_d,k)' P (q_k - q_d,k) + u_k' R u_k     over 20 intervals of 50 ms, P twice as large at the end
///     permanent constraint: each torque is one that the drive can give at the wheel's speed
///     boundary constraint: |v_x| <= kMaxSpeed at the end; what is beyond has a price
///
/// with q the State of the mass centre, by direct multiple shooting: in each step the model is integrated and linearised along
/// the last solution, and one quadratic programme is solved (Diehl et al., "Real-time optimization and nonlinear model
/// predictive control of processes governed by differential-algebraic equations", 2002: the real-time iteration). From one
/// solution to the next, torques are damped and change within bounds: where friction is at its limit, a linear model
/// promises anything. Where the programme is not solved, the last solution is followed on.
class Nmpc final : public edp::Tracker {
 public:
  Nmpc();

  void begin(const edp::EstimatorResult& x) noexcept override;
  edp::TrackerResult step(const edp::EstimatorResult& x, const Slip& slip, const PerWheel& load,
                          std::span<const PathPoint, kHorizonPoints> reference) noexcept override;

 private:
  static constexpr int kIntervals = static_cast<int>(kHorizonPoints) - 1;
  using References = std::array<State, kHorizonPoints>;

  /// Puts the problem along the last solution into qp_. @return false: something is not finite
  bool linearise(const SkidSteer& model, const Friction& p, const References& references) noexcept;
  void price(int k, const State& reference) noexcept;
  void bound(int k) noexcept;
  /// Takes the solution of qp_ over. @return false: it is not finite
  bool improve() noexcept;
  [[nodiscard]] edp::TrackerResult result(const PlanarPose& centre) const noexcept;

  ocp::OcpQp qp_;
  std::array<State, kHorizonPoints> X_{};
  std::array<Torques, kHorizonPoints - 1> U_{};
  int failures_{};  // in a row
};

}  // namespace mrroc::rex
