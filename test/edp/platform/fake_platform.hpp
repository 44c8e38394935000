// A platform whose wheels never slip, with a perfect estimator and a plain tracker that fail when a test likes.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "base/planar.hpp"
#include "edp/platform/platform.hpp"

namespace mrroc::edp::test {

/// Numbers of the fake platform.
inline constexpr double kRadius = 0.15;      // [m]
inline constexpr double kHalfTrack = 0.3;    // [m]
inline constexpr double kMass = 40;          // [kg]
inline constexpr double kInertia = 2.5;      // [kg m^2]
inline constexpr double kIncrements = 4000;  // per turn
inline constexpr double kBrake = 5;          // [N m s/rad]
inline constexpr double kMaxTorque = 20;     // [N m]
inline constexpr double kBrakingTorque = 7;  // [N m]

/// What goes wrong in the kernel, from now on.
struct FakeFaults {
  bool estimator_fails{};  ///< its solver; the result can be used
  bool estimate_not_finite{};
  bool inconsistent{};  ///< every map pose
  double sd{0.01};      ///< of the position [m]
  double slip_sd{1};
  bool tracker_fails{};  ///< its solver; no result
  bool torque_not_finite{};
  bool torque_too_large{};
  bool wheels_elsewhere{};    ///< the estimated speed of wheel 2 is wrong
  PlanarPose displacement{};  ///< of all that it believes, once
};

/// Dead reckoning, which is exact for wheels that do not slip.
class FakeEstimator : public Estimator {
 public:
  explicit FakeEstimator(const FakeFaults& faults) : faults_(&faults) {}
  void begin(const StandingStill& found) noexcept override {
    r_ = {};
    r_.estimate.p = found.p;
    r_.estimate.theta = found.theta;
    r_.estimate.step = found.step;
    r_.slip = {0.5, 0.4, 0.1};
    for (const double load : found.load) r_.mass += load / 9.81;
    yaw_offset_ = found.yaw_offset;
  }
  void add(const StageReading& reading) noexcept override {
    PlatformEstimate& e = r_.estimate;
    double way = 0;
    double speed = 0;
    for (std::size_t k = 0; k < kWheels; ++k) {
      way += kRadius * (reading.theta[k] - e.theta[k]) / kWheels;
      speed += kRadius * reading.theta_dot[k] / kWheels;
    }
    const double phi = reading.imu_valid ? wrap_angle(reading.yaw + yaw_offset_) : e.p.phi;
    const double middle = e.p.phi + wrap_angle(phi - e.p.phi) / 2;
    e.p = {e.p.x + way * std::cos(middle), e.p.y + way * std::sin(middle), phi};
    e.v = {speed, 0, reading.imu_valid ? reading.yaw_rate : 0};
    e.theta = reading.theta;
    e.theta_dot = reading.theta_dot;
    e.step = reading.step;
  }
  bool add(const OdometryReading& odometry) noexcept override { return in_window(odometry.step_before); }
  bool add(const MapPose& pose) noexcept override {
    map_ = in_window(pose.step);
    return map_;
  }
  EstimatorResult step() noexcept override {
    EstimatorResult r = r_;
    r.estimate.covariance = {faults_->sd * faults_->sd, 0, 0, 0, faults_->sd * faults_->sd, 0, 0, 0, 1e-6};
    r.slip_sd = {faults_->slip_sd, faults_->slip_sd, faults_->slip_sd};
    r.health.solver_failed = faults_->estimator_fails;
    r.health.inconsistent = map_ && faults_->inconsistent;
    r.health.iterations = 3;
    if (faults_->estimate_not_finite) r.estimate.p.x = std::numeric_limits<double>::quiet_NaN();
    if (const PlanarPose& d = faults_->displacement; !displaced_ && (d.x != 0 || d.y != 0 || d.phi != 0)) {
      displaced_ = true;
      r_.estimate.p = r.estimate.p = chained(d, r.estimate.p);
      yaw_offset_ += d.phi;
      r.displacement = d;
    }
    if (faults_->wheels_elsewhere) r.estimate.theta_dot[2] += 2;
    map_ = false;
    return r;
  }

 private:
  [[nodiscard]] bool in_window(std::int64_t step) const {
    return step > r_.estimate.step - 20 * kPlatformSteps && step <= r_.estimate.step;
  }
  const FakeFaults* faults_;
  EstimatorResult r_;
  double yaw_offset_{};
  bool map_{};
  bool displaced_{};
};

/// Speeds of the reference with a correction of the error, reached within a few iterations.
class FakeTracker : public Tracker {
 public:
  explicit FakeTracker(const FakeFaults& faults) : faults_(&faults) {}
  void begin(const EstimatorResult& /*x*/) noexcept override { ++begun; }
  TrackerResult step(const EstimatorResult& x, const Slip& slip, const PerWheel& /*load*/,
                     std::span<const PathPoint, kHorizonPoints> reference) noexcept override {
    used = slip;
    const PathPoint& now = reference[0];
    const PlanarPose& p = x.estimate.p;
    const double along = std::cos(p.phi) * (now.p.x - p.x) + std::sin(p.phi) * (now.p.y - p.y);
    const double across = -std::sin(p.phi) * (now.p.x - p.x) + std::cos(p.phi) * (now.p.y - p.y);
    const double turn = wrap_angle(now.p.phi - p.phi);
    const double v = (now.v + reference[1].v) / 2 + 4 * along;
    const double w = (now.w + reference[1].w) / 2 + 6 * turn + 8 * now.v * across;
    const double a = 10 * (v - x.estimate.v.vx);
    const double alpha = 10 * (w - x.estimate.v.w);
    const double both = kMass * a * kRadius / 4;
    const double difference = kInertia * alpha * kRadius / (4 * kHalfTrack);
    TrackerResult r;
    for (std::size_t k = 0; k < kWheels; ++k)
      r.torque[k] = std::clamp(k % 2 == 0 ? both - difference : both + difference, -kMaxTorque, kMaxTorque);
    r.torques.fill(r.torque);
    for (std::size_t k = 0; k < kHorizonPoints; ++k) r.horizon[k] = reference[k].p;
    r.health.iterations = 5;
    r.health.ok = !faults_->tracker_fails;
    r.health.solver_failed = faults_->tracker_fails;
    if (faults_->torque_not_finite) r.torque[1] = std::numeric_limits<double>::infinity();
    if (faults_->torque_too_large) r.torque[3] = 1.01 * kMaxTorque;
    return r;
  }
  inline static thread_local int begun{};  ///< so often has a tracker begun
  inline static thread_local Slip used{};  ///< by the last one

 private:
  const FakeFaults* faults_;
};

/// The kernel.
class FakePlatform : public Platform {
 public:
  FakeFaults faults;
  PlatformProperties q{.name = "fake",
                       .wheel_radius = kRadius,
                       .half_track = kHalfTrack,
                       .increments_per_turn = kIncrements,
                       .max_torque = kMaxTorque,
                       .brake = kBrake,
                       .braking_torque = kBrakingTorque,
                       .max_wheel_speed = 10,
                       .max_speed = 1,
                       .max_turn_rate = 2.5,
                       .max_lateral_acceleration = 2};

  [[nodiscard]] const PlatformProperties& properties() const noexcept override { return q; }
  [[nodiscard]] std::span<const std::string_view> estimators() const noexcept override { return kKinds; }
  [[nodiscard]] std::span<const std::string_view> trackers() const noexcept override { return kKinds; }
  [[nodiscard]] std::unique_ptr<Estimator> estimator(std::string_view kind) const override {
    check(kind);
    return std::make_unique<FakeEstimator>(faults);
  }
  [[nodiscard]] std::unique_ptr<Tracker> tracker(std::string_view kind) const override {
    check(kind);
    return std::make_unique<FakeTracker>(faults);
  }

 private:
  static void check(std::string_view kind) {
    if (std::ranges::find(kKinds, kind) == kKinds.end()) throw std::invalid_argument("unknown kind");
  }
  static constexpr std::array<std::string_view, 2> kKinds{"plain", "other"};
};

}  // namespace mrroc::edp::test
