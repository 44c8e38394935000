#include "test/robots/rex/plant.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::rex::test {
namespace {

constexpr double kMicro = 1e-4;  // [s]

}  // namespace

Plant::Plant(const Truth& truth) noexcept : truth_(truth), x_(truth.centre_x), y_(truth.centre_y) {}

void Plant::step(const PerWheel& torque, double duration) noexcept {
  const auto count = std::lround(duration / kMicro);
  for (long i = 0; i < count; ++i) micro_step(torque);
}

PerWheel Plant::load() const noexcept {
  const double weight = truth_.mass * kGravity;
  PerWheel load;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double along = (truth_.centre_x - truth_.height * ax_ / kGravity) / kWheelX[i];
    const double across = (truth_.centre_y - truth_.height * ay_ / kGravity) / kWheelY[i];
    load[i] = std::max(weight / 4 * (1 + along) * (1 + across), 0.0);
  }
  return load;
}

void Plant::micro_step(const PerWheel& torque) noexcept {
  constexpr double kSmoothing = 0.01;
  const PerWheel N = load();
  double F_x = 0, F_y = 0, M = 0;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double a = kWheelX[i] - truth_.centre_x;
    const double b = kWheelY[i] - truth_.centre_y;
    const double along = vx_ - b * w_ - kWheelRadius * speed_[i];
    const double across = vy_ + a * w_;
    const double n = std::sqrt(along * along + across * across + truth_.slip_speed * truth_.slip_speed);
    const double side = kWheelY[i] > 0 ? 1 + truth_.friction.split : 1 - truth_.friction.split;
    const double f_x = -truth_.friction.mu_x * side * N[i] * along / n;
    const double f_y = -truth_.friction.mu_y * side * N[i] * across / n;
    F_x += f_x;
    F_y += f_y;
    M += a * f_y - b * f_x;
    speed_[i] += kMicro * (torque[i] - kWheelRadius * f_x - truth_.bearing * speed_[i]) / kWheelInertia;
    theta_[i] += kMicro * speed_[i];
  }
  ax_ += kSmoothing * (F_x / truth_.mass - ax_);
  ay_ += kSmoothing * (F_y / truth_.mass - ay_);
  const double forward = vx_ + kMicro * (F_x / truth_.mass + vy_ * w_);
  vy_ += kMicro * (F_y / truth_.mass - vx_ * w_);
  vx_ = forward;
  w_ += kMicro * M / truth_.inertia;
  x_ += kMicro * (vx_ * std::cos(phi_) - vy_ * std::sin(phi_));
  y_ += kMicro * (vx_ * std::sin(phi_) + vy_ * std::cos(phi_));
  phi_ += kMicro * w_;
}

PlanarPose Plant::p() const noexcept {
  const double c = std::cos(phi_), s = std::sin(phi_);
  return {x_ - c * truth_.centre_x + s * truth_.centre_y, y_ - s * truth_.centre_x - c * truth_.centre_y,
          phi_};
}

PlanarVelocity Plant::v() const noexcept {
  return {vx_ + w_ * truth_.centre_y, vy_ - w_ * truth_.centre_x, w_};
}

}  // namespace mrroc::rex::test
