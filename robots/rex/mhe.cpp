#include "robots/rex/mhe.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "robots/rex/estimate.hpp"
#include "robots/rex/parameters.hpp"

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

/// @return largest change of a wheel's slip in a step [m/s]
double slip_change(const StageVector& change) noexcept {
  double most = 0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double s_x = change[kVelocity] - kWheelY[i] * change[kTurnRate] -
                       kWheelRadius * change[kWheelSpeed + static_cast<int>(i)];
    const double s_y = change[kVelocity + 1] + kWheelX[i] * change[kTurnRate];
    most = std::max(most, std::hypot(s_x, s_y));
  }
  return most;
}

/// @return the step, shortened to that change of slip [m/s] but for the speeds of the wheels
StageVector shortened(const StageVector& step, double most) noexcept {
  const double change = slip_change(step);
  if (change <= most) return step;
  StageVector part = most / change * step;
  part.segment<4>(kWheelSpeed) = step.segment<4>(kWheelSpeed);
  return part;
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
  for (int k = 0; k < kWindowStages; ++k) {
    const auto at = static_cast<std::size_t>(k);
    residuals_[at] = window_.residuals_at(k, z(k));
    if (k < kNewest) transitions_[at] = window_.transition_from(k, z(k));
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
  for (int k = 0; k < kWindowStages && solved; ++k)
    z(k) = contained(z(k) + shortened(change_[static_cast<std::size_t>(k)], kMostSlipChange));
}

// The QP's states are corrections of z, so that the arrival cost is that of z_0 = zbar + root(P) w.
void Mhe::set_dynamics() noexcept {
  const StageMatrix L = root(arrival_.P);
  const StageVector error = difference(arrival_.z, z(0));
  qp_.dynamics(0, {}, L, error);
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
