#include "robots/rex/mhe.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
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
  z(0) = arrival_.z;
  newest_ = arrival_;
  linearised_ = 0;
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
      linearised_ = 0;
      return;
    case Entry::next:
      break;
  }
  if (shifts) {
    std::move(z_.begin() + 1, z_.end(), z_.begin());
    std::move(transitions_.begin() + 1, transitions_.end(), transitions_.begin());
    linearised_ = std::max(linearised_ - 1, 0);
  }
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
  linearised_ = std::min(linearised_, picture);
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
    improve(health);
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
  for (int k = 0; k < kWindowStages; ++k)
    residuals_[static_cast<std::size_t>(k)] = window_.residuals_at(k, z(k));
  for (; linearised_ < kNewest; ++linearised_)
    transitions_[static_cast<std::size_t>(linearised_)] =
        window_.transition_from(linearised_, z(linearised_));
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
  if (solved) line_search();
}

void Mhe::line_search() noexcept {
  constexpr int kHalvings = 2;
  const double before = cost();
  const std::array<StageVector, kStages> from = z_;
  double share = 1;
  for (int halvings = 0; halvings <= kHalvings; ++halvings, share /= 2) {
    for (std::size_t k = 0; k < kStages; ++k) z_[k] = contained(from[k] + share * change_[k]);
    linearised_ = 0;
    linearise();
    if (cost() <= before) return;
  }
}

// Clones have no noise: their gaps are no part of it.
double Mhe::cost() const noexcept {
  const StageVector error = difference(z_[0], arrival_.z);
  double sum = arrival_root_.triangularView<Eigen::Lower>().solve(error).squaredNorm();
  for (std::size_t k = 0; k < kStages; ++k) {
    sum += residuals_[k].r.head(residuals_[k].count).squaredNorm();
    if (k + 1 == kStages) break;
    const StageVector gap = difference(z_[k + 1], transitions_[k].z);
    for (int i = 0; i < kStageNoises; ++i)
      if (const double deviation = transitions_[k].deviation[i]; deviation > 0)
        sum += gap[i] * gap[i] / (deviation * deviation);
  }
  return sum;
}

// The QP's states are corrections of z, so that the arrival cost is that of z_0 = zbar + root(P) w.
void Mhe::set_dynamics() noexcept {
  arrival_root_ = root(arrival_.P);
  const StageVector error = difference(arrival_.z, z(0));
  qp_.dynamics(0, {}, arrival_root_, error);
  for (int k = 0; k < kNewest; ++k) {
    const StageTransition& to = transitions_[static_cast<std::size_t>(k)];
    ShootingNoise B = ShootingNoise::Zero();
    B.diagonal() = to.deviation;
    const StageVector gap = difference(to.z, z(k + 1));
    qp_.dynamics(k + 1, to.F, B, gap);
  }
}

void Mhe::set_costs() noexcept {
  constexpr double kDefinite = 1e-6;
  for (int k = 0; k < kWindowStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const int count = residuals_[at].count;
    const auto H = residuals_[at].H.topRows(count);
    StageMatrix Q = H.transpose().lazyProduct(H);
    StageVector q = H.transpose().lazyProduct(residuals_[at].r.head(count));
    Q.diagonal().array() += kDefinite;
    Q.diagonal().segment<3>(kSlipIndex) += held_[at].weight;
    q.segment<3>(kSlipIndex) += held_[at].weight.cwiseProduct(z(k).segment<3>(kSlipIndex) - held_[at].bound);
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
    const StageVector there = z(k) + change_[at];
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
    belief.z = z(k);
    correct(belief, residuals_[static_cast<std::size_t>(k)], z(k));
    if (k < kNewest) predict(belief, transitions_[static_cast<std::size_t>(k)], z(k));
  }
  newest_.P = belief.P;
}

}  // namespace mrroc::rex
