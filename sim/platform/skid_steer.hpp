// Wheels of a platform on the ground: their motors, their slip and the forces that it makes.
#pragma once
#include <array>
#include <cstdint>

#include "base/platform_hardware.hpp"
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// A body in the plane: its centre of mass on M.
struct PlanarState {
  double x{}, y{};    ///< [m]
  double phi{};       ///< [rad]
  double vx{}, vy{};  ///< along the axes of M [m/s]
  double w{};         ///< [rad/s]
};

/// Force and moment on a body's centre of mass, along the axes of M.
struct PlanarForce {
  double x{}, y{};  ///< [N]
  double moment{};  ///< [N m]
};

/// What drives the wheels.
struct WheelDrive {
  PerWheel torque{};  ///< asked for [N m]
  bool enabled{};     ///< false: the motors are short-circuited
  int blocked{-1};    ///< wheel that cannot turn; none: -1
};

/// The contacts of the wheels as they were last.
struct WheelContacts {
  std::array<std::array<double, 2>, kWheels> slip{};  ///< speed over the ground, along and across [m/s]
  PerWheel load{};                                    ///< [N]
  PerWheel torque{};                                  ///< of the motor at the wheel, ripple included [N m]
};

/// Four wheels that are driven by torques and slip: Coulomb's friction as an ellipse, smoothed over a small slip speed, after
///
///     s_x = v_x - b_i w - r Omega    s_y = v_y + a_i w    n = sqrt(s_x^2 + s_y^2 + v_s^2)
///     F_x = -mu_x N s_x / n    F_y = -mu_y N s_y / n    J Omega' = tau - r F_x - f Omega
///
/// with wheel i at (a_i, b_i) from the centre of mass. That is stiff, so it makes short steps of its own, in which the body
/// moves on, too. Deterministic; allocates nothing.
class SkidSteer {
 public:
  /// @param platform  as it is @param ground  its model counts, not its coefficients  @param seed  of the ripple's phases
  SkidSteer(const PlatformParameters& platform, const GroundParameters& ground, std::uint64_t seed);

  /// Turns the wheels on.
  /// @param body      at the beginning
  /// @param friction  of the ground below each wheel
  /// @param h         duration [s]
  /// @param steps     so many are made of it, at least 1
  /// @return mean force of the wheels on the body during that time
  PlanarForce step(const PlanarState& body, const WheelDrive& drive,
                   const std::array<Friction, kWheels>& friction, double h, int steps);

  /// @param body  its state @param wheel  0..3 @return where that wheel stands on M [m]
  [[nodiscard]] RoomPoint place(const PlanarState& body, std::size_t wheel) const;
  /// @return turned by the wheels since the beginning [rad], forward positive
  [[nodiscard]] const PerWheel& turned() const { return turned_; }
  /// @return their speeds [rad/s]
  [[nodiscard]] const PerWheel& speed() const { return speed_; }
  /// @return their contacts at the end of the last step
  [[nodiscard]] const WheelContacts& contacts() const { return contacts_; }

  /// Calls visit(double) for every number of the state.
  template <class Visit>
  void visit_state(Visit visit) const {
    for (const PerWheel* each : {&turned_, &speed_, &torque_}) std::ranges::for_each(*each, visit);
    for (const double each : acceleration_) visit(each);
  }

 private:
  struct Slipping;  // forces at one moment

  [[nodiscard]] PerWheel loads() const;
  [[nodiscard]] double motor_torque(std::size_t wheel, const WheelDrive& drive) const;
  Slipping slip(const PlanarState& body, const std::array<Friction, kWheels>& friction);
  void turn(const WheelDrive& drive, const PerWheel& along, double h);

  PlatformParameters k_;
  double slip_speed_;                      // [m/s]
  double height_;                          // of the centre of mass as far as it shifts loads [m]
  std::array<double, kWheels> a_{}, b_{};  // places of the wheels from the centre of mass [m]
  PerWheel phase_{};                       // of the ripple [rad]
  PerWheel turned_{}, speed_{};            // [rad, rad/s]
  PerWheel torque_{};                      // of the drives, behind their lag [N m]
  std::array<double, 2> acceleration_{};   // of the body along B, that has come to the loads [m/s^2]
  WheelContacts contacts_;
};

}  // namespace mrroc::sim
