#include "robots/rex/mhe.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

#include "robots/rex/estimate.hpp"

namespace mrroc::rex {
namespace {

using ShootingNoise = Eigen::Matrix<double, kStageStates, kStageNoises>;

constexpr int kNewest = kWindowStages - 1;
constexpr int kSlips = 3;
constexpr int kIterations = 30;  // of the solver, at most

/// @param bounded  states with bounds
/// @return stages of the QP: one without state, whose controls are the error of the arrival cost, and those of the window
std::vector<ocp::Stage> stages(const std::vector<int>& bounded) {
  std::vector<ocp::Stage> all{{.n_x = 0, .n_u = kStageStates}};
  for (int k = 0; k < kWindowStages; ++k)
    all.push_back({.n_x = kStageStates, .n_u = k < kNewest ? kStageNoises : 0, .bounded_x = bounded});
  return all;
}

/// @return L with L L' = P, or standard deviations alone when rounding has made P no covariance
StageMatrix root(const StageMatrix& P) noexcept {
  const Eigen::LLT<StageMatrix> llt(P);
  if (llt.info() == Eigen::Success) return llt.matrixL();
  return P.diagonal().cwiseAbs().cwiseSqrt().asDiagonal();
}

/// Slip coefficients that are as near to their bounds as the solver is exact are within them.
constexpr double kOnBound = 1e-6;

Eigen::Vector3d least_slip() noexcept {
  constexpr SlipBounds kBounds;
  return {kBounds.least_friction, kBounds.least_friction, -kBounds.most_split};
}

Eigen::Vector3d most_slip() noexcept {
  constexpr SlipBounds kBounds;
  return {kBounds.most_friction, kBounds.most_friction, kBounds.most_split};
}

}  // namespace

Mhe::Mhe(const EstimatorNoise& noise)
    : window_(noise),
      free_(stages({}), kIterations),
      bounded_(stages({kSlipIndex, kSlipIndex + 1, kSlipIndex + 2}), kIterations) {
  const StageMatrix arrival = StageMatrix::Identity();
  const Eigen::Matrix<double, kStageNoises, kStageNoises> process =
      arrival.topLeftCorner<kStageNoises, kStageNoises>();
  for (ocp::OcpQp* qp : {&free_, &bounded_}) {
    qp->cost(0, {}, {}, arrival, {}, {});
    for (int k = 0; k < kNewest; ++k) qp->cost(k + 1, {}, {}, process, {}, {});
  }
}

void Mhe::begin(const edp::StandingStill& found) noexcept {
  window_.begin(found);
  arrival_ = standing_belief(found, window_);
  z(0) = arrival_.z;
  newest_ = arrival_;
  steps_to_covariance_ = 0;
  inconsistent_ = false;
}

void Mhe::add(const edp::StageReading& reading) noexcept {
  const bool shifts = window_.full();
  if (shifts && reading.step > window_.newest().step) leave();
  switch (window_.add(reading)) {
    case Entry::repeated:
      return;
    case Entry::restart:
      arrival_ = newest_;
      z(0) = newest_.z;
      return;
    case Entry::next:
      break;
  }
  if (shifts) std::move(z_.begin() + 1, z_.end(), z_.begin());
  const int before = window_.size() - 2;
  z(before + 1) = contained(window_.transition_from(before, z(before)).z);
}

void Mhe::leave() noexcept {
  correct(arrival_, window_.residuals_at(0, z(0)), z(0));
  predict(arrival_, window_.transition_from(0, z(0)), z(0));
}

// Behind the new picture, up to the next one, the clone is another pose.
bool Mhe::add(const OdometryReading& odometry) noexcept {
  const int picture = window_.add(odometry);
  if (picture < 0) return false;
  for (int k = picture + 1; k < window_.size(); ++k) {
    z(k).segment<3>(kCloneIndex) = z(picture).segment<3>(kPose);
    if (window_[k].picture) break;
  }
  return true;
}

bool Mhe::add(const MapPose& pose) noexcept {
  const int k = window_.add(pose);
  if (k < 0) return false;
  const Eigen::Matrix3d covariance = pose_covariance(newest_, window_.centre());
  inconsistent_ = inconsistent_ || beyond_ellipse(window_[k], z(k), covariance, window_.centre());
  return true;
}

edp::EstimatorResult Mhe::step() noexcept {
  if (window_.size() == 0) return no_result();
  edp::Health health{.inconsistent = inconsistent_};
  inconsistent_ = false;
  if (window_.full()) {
    linearise();
    const ocp::QpResult solved = improve();
    health.solver_failed = !solved.ok();
    health.iterations = solved.iterations;
    newest_.z = z(kNewest);
    update_covariance();
  } else {
    fill();
  }
  health.ok = newest_.z.allFinite();
  return result_of(newest_, window_, health);
}

void Mhe::fill() noexcept {
  newest_ = arrival_;
  for (int k = 0; k < window_.size(); ++k) {
    correct(newest_, window_.residuals_at(k, newest_.z), newest_.z);
    z(k) = newest_.z;
    if (k + 1 < window_.size()) predict(newest_, window_.transition_from(k, z(k)), z(k));
  }
}

void Mhe::linearise() noexcept {
  for (int k = 0; k < kWindowStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    residuals_[at] = window_.residuals_at(k, z(k));
    if (k < kNewest) transitions_[at] = window_.transition_from(k, z(k));
  }
}

ocp::QpResult Mhe::improve() noexcept {
  set_problem(free_);
  ocp::QpResult solved = free_.solve();
  const bool bounded = !solved.ok() || !within_bounds();
  if (bounded) {
    set_problem(bounded_);
    set_bounds();
    solved = bounded_.solve();
  }
  const ocp::OcpQp& solution = bounded ? bounded_ : free_;
  StageVector change;
  for (int k = 0; k < kWindowStages && solved.ok(); ++k)
    if (solution.x(k + 1, change)) z(k) = contained(z(k) + change);
  return solved;
}

// The QP's states are corrections of z, so that the arrival cost is that of z_0 = zbar + root(P) w.
void Mhe::set_problem(ocp::OcpQp& qp) const noexcept {
  constexpr double kDefinite = 1e-6;
  const StageMatrix L = root(arrival_.P);
  const StageVector error = difference(arrival_.z, z(0));
  qp.dynamics(0, {}, L, error);
  for (int k = 0; k < kWindowStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto H = residuals_[at].H.topRows(residuals_[at].count);
    StageMatrix Q = H.transpose().lazyProduct(H);
    Q.diagonal().array() += kDefinite;
    const StageVector q = H.transpose().lazyProduct(residuals_[at].r.head(residuals_[at].count));
    qp.cost(k + 1, Q, {}, {}, q, {});
    if (k == kNewest) break;
    const StageTransition& to = transitions_[at];
    ShootingNoise B = ShootingNoise::Zero();
    B.diagonal() = to.deviation;
    const StageVector gap = difference(to.z, z(k + 1));
    qp.dynamics(k + 1, to.F, B, gap);
  }
}

void Mhe::set_bounds() noexcept {
  for (int k = 0; k < kWindowStages; ++k) {
    const Eigen::Vector3d lower = least_slip() - z(k).segment<kSlips>(kSlipIndex);
    const Eigen::Vector3d upper = most_slip() - z(k).segment<kSlips>(kSlipIndex);
    bounded_.bounds_x(k + 1, lower, upper);
  }
}

bool Mhe::within_bounds() const noexcept {
  StageVector change;
  for (int k = 0; k < kWindowStages; ++k) {
    if (!free_.x(k + 1, change)) return false;
    const Eigen::Vector3d slip = z(k).segment<kSlips>(kSlipIndex) + change.segment<kSlips>(kSlipIndex);
    if ((slip - least_slip()).minCoeff() < -kOnBound || (most_slip() - slip).minCoeff() < -kOnBound)
      return false;
  }
  return true;
}

// A recursion over the window: what the filter would believe of the newest stage, linearised where the states were.
void Mhe::update_covariance() noexcept {
  constexpr int kEvery = 5;  // steps: it changes slowly
  if (steps_to_covariance_-- > 0) return;
  steps_to_covariance_ = kEvery - 1;
  StageBelief belief = arrival_;
  for (int k = 0; k < kWindowStages; ++k) {
    belief.z = z(k);
    correct(belief, residuals_[static_cast<std::size_t>(k)], z(k));
    if (k < kNewest) predict(belief, transitions_[static_cast<std::size_t>(k)], z(k));
  }
  newest_.P = belief.P;
}

}  // namespace mrroc::rex
