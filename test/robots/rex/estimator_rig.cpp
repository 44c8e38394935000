#include "test/robots/rex/estimator_rig.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <numbers>
#include <tuple>

#include "base/planar.hpp"

namespace mrroc::rex::test {
namespace {

constexpr double kStep = kPlatformPeriod / kPlatformSteps;

/// Sensors with their noise, and readings on their way.
class Sensors {
 public:
  explicit Sensors(const Trial& trial) : trial_(trial), random_(trial.seed) {}

  void see_step(const Plant& plant) {
    yaw_rate_ = plant.v().w + kBias + noise(0.005);
    yaw_ += kStep * yaw_rate_;
    for (std::size_t i = 0; i < kWheels; ++i)
      load_[i] += plant.load()[i] * (1 + noise(0.01)) / kPlatformSteps;
  }

  edp::StageReading reading(std::int64_t step, const Plant& plant, const PerWheel& torque) {
    edp::StageReading reading{.step = step, .theta = plant.theta(), .yaw = yaw_, .yaw_rate = yaw_rate_};
    reading.imu_valid = trial_.imu;
    reading.load = load_;
    reading.torque = torque;
    for (std::size_t i = 0; i < kWheels; ++i) reading.theta_dot[i] = plant.speed()[i] + noise(0.03);
    load_ = {};
    return reading;
  }

  MapPose map(std::int64_t step, const Plant& plant) {
    MapPose pose{.step = step, .valid = true, .p = plant.p()};
    pose.p.x += noise(0.005);
    pose.p.y += noise(0.005);
    pose.p.phi = std::remainder(pose.p.phi + noise(0.01), 2 * std::numbers::pi);
    const double scale = trial_.noise * trial_.noise;
    pose.covariance = {25e-6 * scale, 0, 0, 0, 25e-6 * scale, 0, 0, 0, 1e-4 * scale};
    return pose;
  }

  OdometryReading odometry(std::int64_t before, const PlanarPose& then, std::int64_t step,
                           const PlanarPose& now) {
    const double dx = now.x - then.x, dy = now.y - then.y;
    const double c = std::cos(then.phi), s = std::sin(then.phi);
    const double turn = now.phi - then.phi + noise(0.0007 * trial_.pictures);
    OdometryReading A{.step_before = before, .step = step, .valid = true};
    A.A = {std::cos(turn),
           -std::sin(turn),
           0,
           c * dx + s * dy + noise(0.0015 * trial_.pictures),
           std::sin(turn),
           std::cos(turn),
           0,
           -s * dx + c * dy + noise(0.0015 * trial_.pictures),
           0,
           0,
           1,
           0};
    for (std::size_t i = 0; i < 6; ++i)
      A.covariance[7 * i] = (i < 3 ? 2.25e-6 : 4.9e-7) * trial_.pictures * trial_.pictures;
    return A;
  }

 private:
  static constexpr double kBias = 0.0005;  // of the gyro, that SYNCHRO has not found [rad/s]

  double noise(double deviation) { return trial_.noise * deviation * normal_(random_); }

  const Trial& trial_;
  std::mt19937 random_;
  std::normal_distribution<> normal_;
  double yaw_{}, yaw_rate_{};
  PerWheel load_{};
};

/// A measurement and the step in which it comes.
template <class T>
struct Late {
  std::int64_t due;
  T reading;
};

template <class T>
void deliver(std::deque<Late<T>>& queue, std::int64_t step, edp::Estimator& estimator) {
  for (; !queue.empty() && queue.front().due <= step; queue.pop_front())
    std::ignore = estimator.add(queue.front().reading);
}

/// Drives the platform at the speeds that are wanted, by the true ones: left and right wheels get a torque each.
class SpeedControl {
 public:
  PerWheel torque(const PlanarVelocity& wanted, const PlanarVelocity& v) {
    const double forward = wanted.vx - v.vx;
    const double turn = wanted.w - v.w;
    forward_ += kPlatformPeriod * forward;
    turn_ += kPlatformPeriod * turn;
    const double both = 5 * forward + 5 * forward_ + kBearingFriction * wanted.vx / kWheelRadius;
    const double each = 2 * turn + 10 * turn_ + 4 * std::tanh(wanted.w / 0.1);
    PerWheel torque;
    for (std::size_t i = 0; i < kWheels; ++i)
      torque[i] = std::clamp(both - (kWheelY[i] > 0 ? each : -each), -kMaxTorque, kMaxTorque);
    return torque;
  }

 private:
  double forward_{}, turn_{};  // integrals of the errors [m], [rad]
};

}  // namespace

std::vector<Sample> drive(edp::Estimator& estimator, const Trial& trial) {
  Plant plant(trial.truth);
  Sensors sensors(trial);
  std::deque<Late<MapPose>> maps;
  std::deque<Late<OdometryReading>> motions;
  PlanarPose pictured = plant.p();
  std::vector<Sample> samples;
  SpeedControl control;
  PerWheel torque{};
  estimator.begin({.p = {}, .covariance = {9e-6, 0, 0, 0, 9e-6, 0, 0, 0, 25e-6}, .load = plant.load()});
  const auto stages = std::lround(trial.duration / kPlatformPeriod);
  for (long i = 1; i <= stages; ++i) {
    const double time = static_cast<double>(i) * kPlatformPeriod;
    if (time > trial.changes) plant.set_friction(trial.later);
    for (int k = 0; k < kPlatformSteps; ++k) {
      plant.step(torque, kStep);
      sensors.see_step(plant);
    }
    const std::int64_t step = i * kPlatformSteps;
    const bool lost = time > trial.map_lost[0] && time < trial.map_lost[1];
    if (step % 50 == 0 && !lost) {
      maps.push_back({step + 40, sensors.map(step, plant)});
      if (MapPose& pose = maps.back().reading; time >= trial.map_lost[1])
        pose.p = chained(trial.displacement, pose.p);
    }
    if (step % 40 == 0) {
      if (trial.odometry)
        motions.push_back({step + 70, sensors.odometry(step - 40, pictured, step, plant.p())});
      pictured = plant.p();
    }
    estimator.add(sensors.reading(step, plant, torque));
    deliver(maps, step, estimator);
    deliver(motions, step, estimator);
    samples.push_back({time, plant.p(), plant.v(), estimator.step()});
    torque = control.torque(trial.drive(time), plant.v());
  }
  return samples;
}

Drive winding(double v, double w) {
  return [=](double time) -> PlanarVelocity {
    const double ramp = std::min(time / 2, 1.0);
    return {ramp * v * (1 + 0.2 * std::sin(1.3 * time)), 0,
            ramp * w * std::cos(2 * std::numbers::pi * time / 16)};
  };
}

double position_max(const std::vector<Sample>& run, double from, double to) {
  double most = 0;
  for (const Sample& s : run)
    if (s.time >= from && s.time <= to)
      most = std::max(most, std::hypot(s.result.estimate.p.x - s.p.x, s.result.estimate.p.y - s.p.y));
  return most;
}

double position_rms(const std::vector<Sample>& run, double from) {
  double sum = 0;
  int count = 0;
  for (const Sample& s : run)
    if (s.time >= from) {
      const double error = std::hypot(s.result.estimate.p.x - s.p.x, s.result.estimate.p.y - s.p.y);
      sum += error * error;
      ++count;
    }
  return std::sqrt(sum / count);
}

double heading_max(const std::vector<Sample>& run, double from) {
  double most = 0;
  for (const Sample& s : run)
    if (s.time >= from)
      most =
          std::max(most, std::abs(std::remainder(s.result.estimate.p.phi - s.p.phi, 2 * std::numbers::pi)));
  return most;
}

Slip mean_slip(const std::vector<Sample>& run, double from) {
  Slip sum{0, 0, 0};
  int count = 0;
  for (const Sample& s : run)
    if (s.time >= from) {
      sum.mu_x += s.result.slip.mu_x;
      sum.mu_y += s.result.slip.mu_y;
      sum.split += s.result.slip.split;
      ++count;
    }
  return {sum.mu_x / count, sum.mu_y / count, sum.split / count};
}

double share_in_ellipse(const std::vector<Sample>& run, double from) {
  constexpr double kChiSquare = 5.991;  // 95 % of two numbers
  int inside = 0, count = 0;
  for (const Sample& s : run)
    if (s.time >= from) {
      const PlanarCovariance& P = s.result.estimate.covariance;
      const double ex = s.result.estimate.p.x - s.p.x, ey = s.result.estimate.p.y - s.p.y;
      const double det = P[0] * P[4] - P[1] * P[1];
      inside += (P[4] * ex * ex - 2 * P[1] * ex * ey + P[0] * ey * ey) / det <= kChiSquare;
      ++count;
    }
  return static_cast<double>(inside) / count;
}

}  // namespace mrroc::rex::test
