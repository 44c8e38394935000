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
constexpr std::array<int, kSlips> kBounded{kSlipIndex, kSlipIndex + 1, kSlipIndex + 2};

/// @return stages of the QP: one without state, whose controls are the error of the arrival cost, and those of the window
std::vector<ocp::Stage> stages() {
  const std::vector<int> bounded(kBounded.begin(), kBounded.end());
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

}  // namespace

Mhe::Mhe(const EstimatorNoise& noise) : window_(noise), qp_(stages(), 30) {
  const Eigen::Matrix<double, kStageStates, kStageStates> unit = StageMatrix::Identity();
  const Eigen::Matrix<double, kStageNoises, kStageNoises> unit_noise =
      unit.topLeftCorner<kStageNoises, kStageNoises>();
  qp_.cost(0, {}, {}, unit, {}, {});
  for (int k = 0; k < kNewest; ++k) qp_.cost(k + 1, {}, {}, unit_noise, {}, {});
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
    set_arrival();
    set_stages();
    const ocp::QpResult solved = qp_.solve();
    health.solver_failed = !solved.ok();
    health.iterations = solved.iterations;
    if (solved.ok()) improve();
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

// The QP's states are corrections of z, so that the arrival cost is that of z_0 = zbar + root(P) w.
void Mhe::set_arrival() noexcept {
  const StageMatrix L = root(arrival_.P);
  const StageVector b = difference(arrival_.z, z(0));
  qp_.dynamics(0, {}, L, b);
}

void Mhe::set_stages() noexcept {
  constexpr SlipBounds kBounds;
  constexpr double kDefinite = 1e-6;
  const Eigen::Vector3d least(kBounds.least_friction, kBounds.least_friction, -kBounds.most_split);
  const Eigen::Vector3d most(kBounds.most_friction, kBounds.most_friction, kBounds.most_split);
  for (int k = 0; k < kWindowStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const auto H = residuals_[at].H.topRows(residuals_[at].count);
    StageMatrix Q = H.transpose().lazyProduct(H);
    Q.diagonal().array() += kDefinite;
    const StageVector q = H.transpose().lazyProduct(residuals_[at].r.head(residuals_[at].count));
    qp_.cost(k + 1, Q, {}, {}, q, {});
    const Eigen::Vector3d lower = least - z(k).segment<kSlips>(kSlipIndex);
    const Eigen::Vector3d upper = most - z(k).segment<kSlips>(kSlipIndex);
    qp_.bounds_x(k + 1, lower, upper);
    if (k == kNewest) break;
    const StageTransition& to = transitions_[at];
    ShootingNoise B = ShootingNoise::Zero();
    B.diagonal() = to.deviation;
    const StageVector gap = difference(to.z, z(k + 1));
    qp_.dynamics(k + 1, to.F, B, gap);
  }
}

void Mhe::improve() noexcept {
  StageVector change;
  for (int k = 0; k < kWindowStages; ++k)
    if (qp_.x(k + 1, change)) z(k) = contained(z(k) + change);
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
