// Motor-driven two-jaw gripper: motor, linkage, hard stops, and an object of given width between the jaws.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/hardware.hpp"
#include "robots/gripper/jaws.hpp"
#include "sim/motor.hpp"

namespace mrroc::sim {

/// Constants of the plant. The real motor is not documented; these give a grip of about 100 N at 0.15 A.
struct JawParameters {
  /// Of the jaws, at its shaft.
  MotorParameters motor{.resistance = 60,
                        .rotor_inertia = 5e-7,
                        .friction = 2e-4,
                        .presliding = 0.05,
                        .brake_torque = 5e-3,
                        .torque_constant = 0.015,
                        .supply = 48};
  double stop_stiffness{2e6};    ///< of the hard stops, at the jaws [N/m]
  double object_stiffness{1e5};  ///< of an object and the pads together [N/m]
  double relaxation{0.3};        ///< damping of all contacts over their stiffness [s]: jaws do not bounce
  double damping{1e-7};          ///< at the motor's shaft [N m s/rad]
  double start{0.074};           ///< distance between the jaws after reset [m]
};

/// The jaws of one arm. Deterministic, no allocation.
class Jaws {
 public:
  /// @param p plant @param h integration step [s]
  Jaws(const JawParameters& p, double h) : p_(p), h_(h), motor_(gripper::motor(p.start)), start_(motor_) {}

  /// Puts an object between the jaws, or takes it away. @param width [m], 0: none
  void set_object(double width) { object_ = width; }

  /// Force with which bodies between the pads push the jaws open [N], until the next call.
  void set_load(double force) { load_ = force; }

  /// Begins the mean of the current.
  void begin_step() { current_ = 0; }

  /// One integration step. @param pwm duty cycle @param powered false: the brake holds the shaft
  /// @param share of the integration step in the step's mean
  void step(double pwm, bool powered, double share) {
    const double current = powered ? motor_current(p_.motor, pwm, speed_) : 0;
    current_ += share * current;
    if (!powered) {
      speed_ = 0;
      return;
    }
    const double torque =
        motor_torque(p_.motor, current) + friction_.step(p_.motor, speed_, h_) - p_.damping * speed_;
    speed_ += h_ * torque / p_.motor.rotor_inertia;
    // A turn of the motor moves the jaws by a tenth of a millimetre. Such a gear locks itself: a load resists the motor, and
    // never drives it.
    const double slowed = h_ * gripper::slope(motor_) * force() / p_.motor.rotor_inertia;
    if (slowed * speed_ < 0) speed_ = std::abs(slowed) < std::abs(speed_) ? speed_ + slowed : 0;
    motor_ += h_ * speed_;
  }

  /// @return force that opens the jaws, from object, bodies and stops [N]; negative at the stop of the opening
  [[nodiscard]] double force() const {
    const double d = distance();
    const double opening = gripper::slope(motor_) * speed_;  // [m/s]
    const auto pressed = [&](double depth, double closing) {
      return depth > 0 ? std::max(0.0, depth + p_.relaxation * closing) : 0;
    };
    return load_ + p_.object_stiffness * pressed(object_ - d, -opening) +
           p_.stop_stiffness * (pressed(gripper::distance(gripper::kClosedStop) - d, -opening) -
                                pressed(d - gripper::distance(gripper::kOpenStop), opening));
  }

  /// @return true distance between the jaws [m]
  [[nodiscard]] double distance() const { return gripper::distance(motor_); }
  /// @return turn of the motor since power-up [rad]
  [[nodiscard]] double turned() const { return motor_ - start_; }
  /// @return mean current of the step [A]
  [[nodiscard]] double current() const { return current_; }

 private:
  JawParameters p_;
  double h_;
  double motor_;  // [rad]
  double start_;
  double speed_{};  // [rad/s]
  double current_{};
  double object_{};
  double load_{};
  ShaftFriction friction_;
};

}  // namespace mrroc::sim
