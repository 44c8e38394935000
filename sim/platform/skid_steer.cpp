#include "sim/platform/skid_steer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mrroc::sim {
namespace {

constexpr double kGravity = 9.81;       // [m/s^2]
constexpr double kRipplesPerTurn = 12;  // of a wheel
constexpr std::array<double, kWheels> kFront{1, 1, -1, -1};
constexpr std::array<double, kWheels> kLeft{1, -1, 1, -1};

}  // namespace

struct SkidSteer::Slipping {
  PerWheel along{};           // force on the body along each wheel [N]
  double x{}, y{}, moment{};  // on the centre of mass, along B [N, N m]
};

SkidSteer::SkidSteer(const PlatformParameters& platform, const GroundParameters& ground, std::uint64_t seed)
    : k_(platform),
      slip_speed_(ground.model == GroundModel::smooth ? platform.body.slip_speed : ground.slip_speed),
      height_(ground.model == GroundModel::smooth ? 0 : platform.height) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
  for (std::size_t i = 0; i < kWheels; ++i) {
    a_[i] = kFront[i] * k_.body.half_wheelbase - k_.centre[0];
    b_[i] = kLeft[i] * k_.body.half_track - k_.centre[1];
    phase_[i] = phase(random);
  }
  contacts_.load = loads();
}

/// The part that statics leave open is shared in proportion. What the wheels carry is the weight, always.
PerWheel SkidSteer::loads() const {
  const double ahead = (k_.centre[0] - acceleration_[0] * height_ / kGravity) / k_.body.half_wheelbase;
  const double left = (k_.centre[1] - acceleration_[1] * height_ / kGravity) / k_.body.half_track;
  const double x = std::clamp(ahead, -1.0, 1.0), y = std::clamp(left, -1.0, 1.0);
  PerWheel load{};
  for (std::size_t i = 0; i < kWheels; ++i)
    load[i] = k_.body.mass * kGravity / 4 * (1 + kFront[i] * x) * (1 + kLeft[i] * y);
  return load;
}

RoomPoint SkidSteer::place(const PlanarState& body, std::size_t wheel) const {
  const double c = std::cos(body.phi), s = std::sin(body.phi);
  return {body.x + c * a_[wheel] - s * b_[wheel], body.y + s * a_[wheel] + c * b_[wheel]};
}

/// What a drive is asked for, as far as it can give it: faster wheels are driven with less.
double SkidSteer::motor_torque(std::size_t wheel, const WheelDrive& drive) const {
  const auto& m = k_.body;
  const double asked = std::clamp(drive.torque[wheel], -m.max_torque, m.max_torque);
  if (asked * speed_[wheel] <= 0) return asked;
  const double left =
      (m.no_torque_speed - std::abs(speed_[wheel])) / (m.no_torque_speed - m.full_torque_speed);
  const double most = m.max_torque * std::clamp(left, 0.0, 1.0);
  return std::clamp(asked, -most, most);
}

SkidSteer::Slipping SkidSteer::slip(const PlanarState& body, const std::array<Friction, kWheels>& friction) {
  const double c = std::cos(body.phi), s = std::sin(body.phi);
  const double vx = c * body.vx + s * body.vy, vy = c * body.vy - s * body.vx;
  contacts_.load = loads();
  Slipping f;
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double x = vx - b_[i] * body.w - k_.body.wheel_radius * speed_[i];
    const double y = vy + a_[i] * body.w;
    const double per_speed = contacts_.load[i] / std::sqrt(x * x + y * y + slip_speed_ * slip_speed_);
    const double across = -friction[i].mu_y * per_speed * y;
    f.along[i] = -friction[i].mu_x * per_speed * x;
    f.x += f.along[i];
    f.y += across;
    f.moment += a_[i] * across - b_[i] * f.along[i];
    contacts_.slip[i] = {x, y};
  }
  return f;
}

void SkidSteer::turn(const WheelDrive& drive, const PerWheel& along, double h) {
  const double follows = k_.motor_lag > 0 ? 1 - std::exp(-h / k_.motor_lag) : 1;
  for (std::size_t i = 0; i < kWheels; ++i) {
    torque_[i] = drive.enabled ? torque_[i] + follows * (motor_torque(i, drive) - torque_[i]) : 0;
    const double ripple = 1 + k_.ripple * std::sin(kRipplesPerTurn * turned_[i] + phase_[i]);
    contacts_.torque[i] = drive.enabled ? ripple * torque_[i] : -k_.body.brake * speed_[i];
    const double rest =
        contacts_.torque[i] - k_.body.wheel_radius * along[i] - k_.body.bearing_friction * speed_[i];
    speed_[i] = drive.blocked == static_cast<int>(i) ? 0 : speed_[i] + h * rest / k_.body.wheel_inertia;
    turned_[i] += h * speed_[i];
  }
}

PlanarForce SkidSteer::step(const PlanarState& body, const WheelDrive& drive,
                            const std::array<Friction, kWheels>& friction, double h, int steps) {
  const double micro = h / steps;
  const double shifts = k_.load_time > 0 ? 1 - std::exp(-micro / k_.load_time) : 1;
  PlanarState b = body;
  PlanarForce sum;
  for (int step = 0; step < steps; ++step) {
    const Slipping f = slip(b, friction);
    turn(drive, f.along, micro);
    acceleration_[0] += shifts * (f.x / k_.body.mass - acceleration_[0]);
    acceleration_[1] += shifts * (f.y / k_.body.mass - acceleration_[1]);
    const double c = std::cos(b.phi), s = std::sin(b.phi);
    const double x = c * f.x - s * f.y, y = s * f.x + c * f.y;
    b.vx += micro * x / k_.body.mass;
    b.vy += micro * y / k_.body.mass;
    b.w += micro * f.moment / k_.body.inertia;
    b.phi += micro * b.w;
    sum.x += x / steps;
    sum.y += y / steps;
    sum.moment += f.moment / steps;
  }
  return sum;
}

}  // namespace mrroc::sim
