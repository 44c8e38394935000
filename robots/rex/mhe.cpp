#include "robots/rex/mhe.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>
#include <vector>

#include "robots/rex/estimate.hpp"

namespace mrroc::rex {
namespace {

using ShootingNoise = Eigen::Matrix<double, kStageStates, kStageNoises>;

constexpr int kNewest = kWindowStages - 1;
constexpr int kIterations = 30;  // of the solver: a problem without bounds takes none

/// @return stages of the QP: one without state, whose controls are the error of the arrival cost, and those of the window
std::vector<ocp::Stage> stages() {
  std::vector<ocp::Stage> all{{.n_x = 0, .n_u = kStageStates}};
  for (int k = 0; k < kWindowStages; ++k)
    all.push_back({.n_x = kStageStates, .n_u = k < kNewest ? kStageNoises : 0});
  return all;
}

/// @return L with L L' = P, or standard deviations alone when rounding has made P no covariance
StageMatrix root(const StageMatrix& P) noexcept {
  const Eigen::LLT<StageMatrix> llt(P);
  if (llt.info() == Eigen::Success) return llt.matrixL();
  return P.diagonal().cwiseAbs().cwiseSqrt().asDiagonal();
}

}  // namespace

Mhe::Mhe(const EstimatorNoise& noise) : window_(noise), qp_(stages(), kIterations) {
  const StageMatrix arrival = StageMatrix::Identity();
  const Eigen::Matrix<double, kStageNoises, kStageNoises> process =
      arrival.topLeftCorner<kStageNoises, kStageNoises>();
  qp_.cost(0, {}, {}, arrival, {}, {});
  for (int k = 0; k < kNewest; ++k) qp_.cost(k + 1, {}, {}, process, {}, {});
}

void Mhe::begin(const edp::StandingStill& found) noexcept {
  window_.begin(found);
  arrival_ = standing_belief(found, window_);
  z_.set(0, arrival_.z);
  newest_ = arrival_;
  steps_to_covariance_ = 0;
  inconsistent_ = false;
  displacement_ = {};
}

void Mhe::add(const edp::StageReading& reading) noexcept {
  const bool shifts = window_.full();
  if (shifts && reading.step > window_.newest().step) leave();
  switch (window_.add(reading)) {
    case Entry::repeated:
      return;
    case Entry::restart:
      arrival_ = newest_;
      z_.set(0, newest_.z);
      return;
    case Entry::next:
      break;
  }
  if (shifts) z_.shift();
  const int before = window_.size() - 2;
  z_.set(before + 1, contained(window_.transition_from(before, z_[before]).z));
}

void Mhe::leave() noexcept {
  correct(arrival_, window_.residuals_at(0, z_[0]), z_[0]);
  predict(arrival_, window_.transition_from(0, z_[0]), z_[0]);
}

// Behind the new picture, up to the next one, the clone is another pose.
bool Mhe::add(const OdometryReading& odometry) noexcept {
  const int picture = window_.add(odometry);
  if (picture < 0) return false;
  window_.see_heading(picture, z_[picture][2]);
  z_.renew(picture);
  for (int k = picture + 1; k < window_.size(); ++k) {
    StageVector z = z_[k];
    z.segment<3>(kCloneIndex) = z_[picture].segment<3>(kPose);
    z_.set(k, z);
    if (window_[k].picture) break;
  }
  return true;
}

bool Mhe::add(const MapPose& pose) noexcept {
  const int k = window_.add(pose);
  if (k < 0) return false;
  const Eigen::Matrix3d covariance = pose_covariance(newest_, window_.centre());
  inconsistent_ = inconsistent_ || beyond_ellipse(window_[k], z_[k], covariance, window_.centre());
  if (const auto displacement = displacement_at(window_, k, z_[k], covariance)) displace(*displacement);
  return true;
}

void Mhe::displace(const Displacement& displacement) noexcept {
  window_.displace(displacement.motion.phi);
  for (int i = 0; i < window_.size(); ++i) z_.set(i, moved(z_[i], displacement.motion));
  arrival_ = moved(arrival_, displacement);
  newest_ = moved(newest_, displacement);
  displacement_ = chained(displacement.motion, displacement_);
}

edp::EstimatorResult Mhe::step() noexcept {
  if (window_.size() == 0) return no_result();
  edp::Health health{.inconsistent = std::exchange(inconsistent_, false)};
  if (window_.full()) {
    z_.linearise(window_);
    improve(health);
    newest_.z = z_[kNewest];
    update_covariance();
  } else {
    fill();
  }
  health.ok = newest_.z.allFinite();
  edp::EstimatorResult result = result_of(newest_, window_, health);
  result.displacement = std::exchange(displacement_, {});
  return result;
}

void Mhe::fill() noexcept {
  newest_ = arrival_;
  for (int k = 0; k < window_.size(); ++k) {
    correct(newest_, window_.residuals_at(k, newest_.z), newest_.z);
    z_.set(k, newest_.z);
    if (k + 1 < window_.size()) predict(newest_, window_.transition_from(k, z_[k]), z_[k]);
  }
}

void Mhe::improve(edp::Health& health) noexcept {
  held_.fill({});
  set_dynamics();
  bool solved = false;
  do {
    set_costs();
    solved = solve();
    ++health.iterations;
  } while (solved && health.iterations == 1 && hold_slip());
  health.solver_failed = !solved;
  if (solved) z_.take(change_, window_, arrival_, arrival_root_);
}

// The QP's states are corrections of z, so that the arrival cost is that of z_0 = zbar + root(P) w.
void Mhe::set_dynamics() noexcept {
  arrival_root_ = root(arrival_.P);
  const StageVector error = difference(arrival_.z, z_[0]);
  qp_.dynamics(0, {}, arrival_root_, error);
  for (int k = 0; k < kNewest; ++k) {
    const StageTransition& to = z_.transition(k);
    ShootingNoise B = ShootingNoise::Zero();
    B.diagonal() = to.deviation;
    const StageVector gap = difference(to.z, z_[k + 1]);
    qp_.dynamics(k + 1, to.F, B, gap);
  }
}

void Mhe::set_costs() noexcept {
  constexpr double kDefinite = 1e-6;
  for (int k = 0; k < kWindowStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const StageResiduals& residuals = z_.residuals(k);
    const auto H = residuals.H.topRows(residuals.count);
    StageMatrix Q = H.transpose().lazyProduct(H);
    StageVector q = H.transpose().lazyProduct(residuals.r.head(residuals.count));
    Q.diagonal().array() += kDefinite;
    Q.diagonal().segment<3>(kSlipIndex) += held_[at].weight;
    q.segment<3>(kSlipIndex) += held_[at].weight.cwiseProduct(z_[k].segment<3>(kSlipIndex) - held_[at].bound);
    qp_.cost(k + 1, Q, {}, {}, q, {});
  }
}

bool Mhe::solve() noexcept {
  if (!qp_.solve().ok()) return false;
  for (int k = 0; k < kWindowStages; ++k) {
    StageVector& change = change_[static_cast<std::size_t>(k)];
    if (!qp_.x(k + 1, change) || !change.allFinite()) return false;
  }
  return true;
}

bool Mhe::hold_slip() noexcept {
  constexpr double kDeviation = 1e-3;  // of a coefficient that is held
  bool any = false;
  for (int k = 0; k < kWindowStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const StageVector there = z_[k] + change_[at];
    const Eigen::Vector3d bound = contained(there).segment<3>(kSlipIndex);
    for (int i = 0; i < 3; ++i) {
      if (bound[i] == there[kSlipIndex + i]) continue;
      held_[at].weight[i] = 1 / (kDeviation * kDeviation);
      held_[at].bound[i] = bound[i];
      any = true;
    }
  }
  return any;
}

// A recursion over the window: what the filter would believe of the newest stage, linearised where the states were.
void Mhe::update_covariance() noexcept {
  constexpr int kEvery = 5;  // steps: it changes slowly
  if (steps_to_covariance_-- > 0) return;
  steps_to_covariance_ = kEvery - 1;
  StageBelief belief = arrival_;
  for (int k = 0; k < kWindowStages; ++k) {
    belief.z = z_[k];
    correct(belief, z_.residuals(k), z_[k]);
    if (k < kNewest) predict(belief, z_.transition(k), z_[k]);
  }
  newest_.P = belief.P;
}

}  // namespace mrroc::rex
