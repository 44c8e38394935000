#include "robots/rex/nmpc.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "robots/rex/wheels.hpp"

namespace mrroc::rex {
namespace {

constexpr double kInterval = 0.05;  // [s]
constexpr int kQpIterations = 60;   // at the limit of friction some thirty are needed
constexpr double kTorquePrice = 0.004;
constexpr double kDamping =
    0.004;  // price of half the square of a torque's change from one solution to the next
constexpr double kMostChange = 4;    // of a torque from one solution to the next [N m]
constexpr double kFinalPrice = 2;    // of the last error, against that of one on the way
constexpr double kSpeedPrice = 1e4;  // of half the square of a speed beyond the limit

/// P. Against a plant of another structure than the model, weights of the pose nine times smaller track seven times worse.
State weights() noexcept {
  State P;
  P << 1800, 1800, 100, 3, 0.5, 1, 0.015, 0.015, 0.015, 0.015;
  return P;
}

std::vector<ocp::Stage> stages(int intervals) {
  std::vector<ocp::Stage> all(static_cast<std::size_t>(intervals) + 1,
                              {.n_x = SkidSteer::n_x, .n_u = SkidSteer::n_u, .bounded_u = {0, 1, 2, 3}});
  all.front().n_x = 0;  // measured
  all.back() = {.n_x = SkidSteer::n_x};
  return all;
}

State reference_state(const PathPoint& point, const PlanarPose& centre) noexcept {
  return state_of({.p = point.p, .v = {point.v, 0, point.w}, .theta_dot = rolling_speeds(point.v, point.w)},
                  centre);
}

State difference(const State& a, const State& b) noexcept {
  State d = a - b;
  d[kHeading] = wrap_angle(d[kHeading]);
  return d;
}

}  // namespace

Nmpc::Nmpc() : qp_(stages(kIntervals), kQpIterations) {
  const Eigen::Matrix4d R = (kTorquePrice + kDamping) * Eigen::Matrix4d::Identity();
  for (int k = 0; k < kIntervals; ++k) qp_.cost(k, {}, {}, R, {}, {});
}

void Nmpc::begin(const edp::EstimatorResult& x) noexcept {
  State rest = State::Zero();
  const PlanarPose p = centre_pose(x.estimate.p, x.centre);
  rest.head<3>() << p.x, p.y, p.phi;
  X_.fill(rest);
  U_.fill(Torques::Zero());
  failures_ = 0;
}

edp::TrackerResult Nmpc::step(const edp::EstimatorResult& x, const Slip& slip, const PerWheel& load,
                              std::span<const PathPoint, kHorizonPoints> reference) noexcept {
  References references;
  for (std::size_t k = 0; k < references.size(); ++k) references[k] = reference_state(reference[k], x.centre);
  const State last = std::exchange(X_[0], state_of(x.estimate, x.centre));
  const SkidSteer model({x.mass, x.centre, load});
  ocp::QpResult solved;
  if (linearise(model, friction_of(slip), references)) solved = qp_.solve();
  const bool improved = solved.ok() && improve();
  failures_ = improved ? 0 : failures_ + 1;
  if (!X_[0].allFinite()) X_[0] = last;
  edp::TrackerResult r = result(x.centre);
  r.health = {.solver_failed = !improved, .iterations = solved.iterations};
  return r;
}

bool Nmpc::linearise(const SkidSteer& model, const Friction& p, const References& references) noexcept {
  bool finite = true;
  for (int k = 0; k < kIntervals; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto next = ocp::integrate(model, X_[i], U_[i], p, kInterval);
    // After a failure, a trajectory that the torques lead along: the last one may have been why.
    if (failures_ > 0 && next.x.allFinite()) X_[i + 1] = next.x;
    const State b = difference(next.x, X_[i + 1]);
    finite =
        finite && b.allFinite() && next.A.allFinite() && next.B.allFinite() && references[i + 1].allFinite();
    qp_.dynamics(k, k > 0 ? ocp::View(next.A) : ocp::View(), next.B, b);
    bound(k);
    price(k + 1, references[i + 1]);
  }
  return finite;
}

void Nmpc::bound(int k) noexcept {
  const auto i = static_cast<std::size_t>(k);
  qp_.cost(k, {}, {}, {}, {}, Torques(kTorquePrice * U_[i]));
  Torques lower, upper;
  for (int wheel = 0; wheel < SkidSteer::n_u; ++wheel) {
    const TorqueRange range = torque_range(X_[i][kWheelSpeed + wheel]);
    lower[wheel] = std::clamp(range.lower - U_[i][wheel], -kMostChange, kMostChange);
    upper[wheel] = std::clamp(range.upper - U_[i][wheel], -kMostChange, kMostChange);
  }
  qp_.bounds_u(k, lower, upper);
}

void Nmpc::price(int k, const State& reference) noexcept {
  const State& x = X_[static_cast<std::size_t>(k)];
  State weight = weights();
  if (k == kIntervals) weight *= kFinalPrice;
  State q = weight.cwiseProduct(difference(x, reference));
  const double beyond = x[kVelocity] - std::clamp(x[kVelocity], -kMaxSpeed, kMaxSpeed);
  if (k == kIntervals && beyond != 0) {
    weight[kVelocity] += kSpeedPrice;
    q[kVelocity] += kSpeedPrice * beyond;
  }
  qp_.cost(k, Eigen::Matrix<double, SkidSteer::n_x, SkidSteer::n_x>(weight.asDiagonal()), {}, {}, q, {});
}

bool Nmpc::improve() noexcept {
  std::array<State, kHorizonPoints - 1> step_of_x;
  std::array<Torques, kHorizonPoints - 1> step_of_u;
  for (int k = 0; k < kIntervals; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!qp_.u(k, step_of_u[i]) || !qp_.x(k + 1, step_of_x[i]) || !step_of_u[i].allFinite() ||
        !step_of_x[i].allFinite())
      return false;
  }
  for (std::size_t i = 0; i < step_of_x.size(); ++i) {
    X_[i + 1] += step_of_x[i];
    U_[i] += step_of_u[i];
  }
  return true;
}

edp::TrackerResult Nmpc::result(const PlanarPose& centre) const noexcept {
  edp::TrackerResult r;
  for (std::size_t k = 0; k < X_.size(); ++k) r.horizon[k] = pose_of(X_[k], centre);
  // Bounds of the programme hold to within its accuracy only, 1e-8 N m; seldom are they passed at all.
  for (std::size_t k = 0; k < U_.size(); ++k) {
    Torques::Map(r.torques[k].data()) = U_[k];
    r.torques[k] = within_limit(r.torques[k]);
  }
  // The solution stands still while time goes on without a new one.
  const int behind = static_cast<int>(failures_ * kPlatformPeriod / kInterval);
  r.torque = r.torques[static_cast<std::size_t>(std::min(behind, kIntervals - 1))];
  return r;
}

}  // namespace mrroc::rex
