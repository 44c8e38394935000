// A platform that the kernels of Rex are tried on, with dynamics of its own.
#pragma once
#include "base/platform_command.hpp"
#include "robots/rex/parameters.hpp"

namespace mrroc::rex::test {

/// What is true of the platform. As it stands, it has the structure of the kernels' model.
struct Truth {
  double mass{kMass};                ///< [kg]
  double inertia{kInertia};          ///< about the mass centre [kg m^2]
  double centre_x{};                 ///< of mass in B [m]
  double centre_y{};                 ///< [m]
  double height{};                   ///< of the mass centre above the ground: how much load wanders [m]
  double slip_speed{kSlipSpeed};     ///< how sharp friction is [m/s]
  double bearing{kBearingFriction};  ///< [N m s]
  Slip friction{};
};

/// Sharper friction, heavier, its mass centre in front, load that wanders: no model has that structure.
[[nodiscard]] inline Truth another_structure() noexcept {
  return {.mass = 44, .inertia = 2.9, .centre_x = 0.04, .height = 0.2, .slip_speed = 0.01, .bearing = 0.6};
}

/// Body on four wheels that slip, in steps of 0.1 ms. Its B begins at the origin of M, at rest.
class Plant {
 public:
  explicit Plant(const Truth& truth) noexcept;

  /// @param torque  at the wheels [N m], constant for the duration [s]
  void step(const PerWheel& torque, double duration) noexcept;
  void set_friction(const Slip& friction) noexcept { truth_.friction = friction; }

  [[nodiscard]] PlanarPose p() const noexcept;      ///< of B, phi unwrapped
  [[nodiscard]] PlanarVelocity v() const noexcept;  ///< of B
  [[nodiscard]] const PerWheel& theta() const noexcept { return theta_; }
  [[nodiscard]] const PerWheel& speed() const noexcept { return speed_; }
  [[nodiscard]] PerWheel load() const noexcept;

 private:
  void micro_step(const PerWheel& torque) noexcept;

  Truth truth_;
  double x_, y_, phi_{};      // of the mass centre
  double vx_{}, vy_{}, w_{};  // of the mass centre
  PerWheel theta_{}, speed_{};
  double ax_{}, ay_{};  // smoothed accelerations, for the loads
};

}  // namespace mrroc::rex::test
