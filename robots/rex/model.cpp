#include "robots/rex/model.hpp"

#include <skid_steer.h>

#include <cmath>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex {
namespace {

struct Offset {
  double x, y;
};

/// From B to the mass centre, along M.
Offset turned(const PlanarPose& centre, double phi) noexcept {
  const double c = std::cos(phi);
  const double s = std::sin(phi);
  return {c * centre.x - s * centre.y, s * centre.x + c * centre.y};
}

}  // namespace

PerWheel standing_load(double mass, const PlanarPose& centre) noexcept {
  PerWheel load;
  for (std::size_t i = 0; i < kWheels; ++i)
    load[i] = mass * kGravity / 4 * (1 + centre.x / kWheelX[i]) * (1 + centre.y / kWheelY[i]);
  return load;
}

SkidSteer::SkidSteer(const Load& load) noexcept
    : data_{load.mass,     kInertia * load.mass / kMass,
            load.centre.x, load.centre.y,
            kHalfBase,     kHalfTrack,
            kWheelRadius,  kWheelInertia,
            kSlipSpeed,    kBearingFriction,
            load.wheel[0], load.wheel[1],
            load.wheel[2], load.wheel[3]} {}

ocp::Derivative<SkidSteer::n_x, SkidSteer::n_u, SkidSteer::n_p> SkidSteer::derivative(
    const State& x, const Torques& u, const Friction& p) const noexcept {
  ocp::Derivative<n_x, n_u, n_p> d;
  std::array<const double*, skid_steer_SZ_ARG> arguments{x.data(), u.data(), p.data(), data_.data()};
  std::array<double*, skid_steer_SZ_RES> results{d.f.data(), d.f_x.data(), d.f_u.data(), d.f_p.data()};
  static_assert(skid_steer_SZ_IW == 0 && skid_steer_SZ_W == 0, "the model works without memory of its own");
  skid_steer(arguments.data(), results.data(), nullptr, nullptr, 0);
  return d;
}

PlanarPose centre_pose(const PlanarPose& p, const PlanarPose& centre) noexcept {
  const Offset o = turned(centre, p.phi);
  return {p.x + o.x, p.y + o.y, p.phi};
}

State state_of(const PlatformEstimate& estimate, const PlanarPose& centre) noexcept {
  const PlanarPose p = centre_pose(estimate.p, centre);
  const PlanarVelocity& v = estimate.v;
  State x;
  x << p.x, p.y, p.phi, v.vx - v.w * centre.y, v.vy + v.w * centre.x, v.w,
      Torques::Map(estimate.theta_dot.data());
  return x;
}

PlanarPose pose_of(const State& x, const PlanarPose& centre) noexcept {
  const Offset o = turned(centre, x[kHeading]);
  return {x[0] - o.x, x[1] - o.y, x[kHeading]};
}

PlanarVelocity velocity_of(const State& x, const PlanarPose& centre) noexcept {
  const double w = x[kTurnRate];
  return {x[kVelocity] + w * centre.y, x[kVelocity + 1] - w * centre.x, w};
}

}  // namespace mrroc::rex
