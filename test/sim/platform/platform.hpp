// A platform of round numbers for tests of the simulation.
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/platform_hardware.hpp"
#include "sim/platform/parameters.hpp"
#include "sim/platform/platform_world.hpp"

namespace mrroc::sim::test {

/// A platform whose motors and sensors are ideal, mass 40 kg in the middle.
inline PlatformParameters ideal_platform() {
  PlatformParameters p;
  p.body = {.mass = 40,
            .inertia = 2.5,
            .wheel_radius = 0.15,
            .half_wheelbase = 0.25,
            .half_track = 0.30,
            .wheel_inertia = 0.1,
            .bearing_friction = 0.5,
            .slip_speed = 0.04,
            .max_torque = 20,
            .full_torque_speed = 14,
            .no_torque_speed = 18,
            .brake = 1.5,
            .quick_stop = 8,
            .increments_per_turn = 4000,
            .torque_constant = 2,
            .length = 0.8,
            .width = 0.66};
  p.motor_lag = 0;
  p.ripple = 0;
  p.imu = {.noise = 0, .bias = 0, .bias_walk = 0};
  p.load_cells = {.noise = 0, .bias = 0};
  return p;
}

/// One such platform in an empty hall.
inline PlatformWorldParameters ideal_world() {
  PlatformWorldParameters w;
  w.platforms = {ideal_platform()};
  w.ground.friction = {.mu_x = 0.7, .mu_y = 0.7};
  w.room = {.lower = {-50, -50}, .upper = {50, 50}, .obstacles = {}};
  w.motion_capture.noise = {0, 0};
  return w;
}

/// @return a drive with these torques [N m]
inline PlatformDrive drive(const PerWheel& torque) { return {.step = 0, .torque = torque, .enabled = true}; }

/// Torques that turn the platform on the spot, counter-clockwise [N m].
inline PerWheel turning(double torque) { return {-torque, torque, -torque, torque}; }

/// Gives one platform the same drive for a time. @param duration [s]
inline void run(PlatformWorld& world, const PlatformDrive& d, double duration) {
  const auto steps = static_cast<std::int64_t>(std::lround(duration / kPlatformStep));
  for (std::int64_t k = 0; k < steps; ++k) world.step({&d, 1});
}

}  // namespace mrroc::sim::test
