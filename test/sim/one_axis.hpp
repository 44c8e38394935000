// One axis of an arm on its own: the real regulator, motor, encoder and law (28) against a spring.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "base/axis_command.hpp"
#include "edp/control_law.hpp"
#include "edp/regulator.hpp"
#include "edp/robot.hpp"
#include "sim/motor.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// An axis that moves a tip along a line.
struct OneAxis {
  edp::AxisProperties axis;
  MotorParameters motor;
  double inertia;  ///< of all that turns with the shaft, at the shaft [kg m^2]
  double lever;    ///< path of the tip per angle of the shaft [m/rad]
  double load;     ///< constant torque on the shaft, as of gravity [N m]
};

/// Simulates the axis in steps of the driver with substeps of 1 ms. The tip begins at 0.
class OneAxisRig {
 public:
  /// @param algorithm_no of the servo; algorithm 1 knows the load
  OneAxisRig(const OneAxis& axis, int algorithm_no)
      : a_(axis),
        algorithm_no_(algorithm_no),
        incremental_(axis.axis.servo.incremental[0]),
        compensating_(axis.axis.servo.compensating[0], axis.axis.servo.drive, axis.axis.increments_per_rad,
                      kStep),
        encoder_(axis.axis.increments_per_rad, 0.3) {}

  double wall{1};         ///< where the spring begins [m]
  double stiffness{1e4};  ///< [N/m]
  double damping{20};     ///< [N s/m]

  /// One step. @param set_increment  of the tip [m]
  void step(double set_increment) {
    const std::int32_t count = encoder_.count(angle_);
    const double turn = set_increment / a_.lever * a_.axis.increments_per_rad;
    const double pwm = algorithm_no_ == 0 ? incremental_.step(turn, count - count_)
                                          : compensating_.step(turn, set_ - count, a_.load);
    set_ += turn;
    count_ = count;
    force_ = 0;
    for (int k = 0; k < kSubsteps; ++k) {
      const double pressed = angle_ * a_.lever - wall;
      const double push = pressed > 0 ? std::max(0.0, stiffness * pressed + damping * speed_ * a_.lever) : 0;
      const double torque = motor_torque(a_.motor, motor_current(a_.motor, pwm, speed_)) +
                            friction_.step(a_.motor, speed_, kSubstep) - push * a_.lever - a_.load;
      speed_ += kSubstep * torque / a_.inertia;
      angle_ += kSubstep * speed_;
      force_ += push / kSubsteps;
    }
  }

  /// One step under law (28), with the noise and the quantisation of the sensor.
  void step(const AxisCommand& command) {
    const double measured = std::round((force_ + 0.05 * normal_(random_)) / 0.0125) * 0.0125;
    velocity_ = edp::axis_velocity(command, measured, velocity_, kStep);
    step(velocity_ * kStep);
  }

  /// @return force of the tip on the spring, mean over the step [N]
  [[nodiscard]] double force() const { return force_; }
  /// @return [m]
  [[nodiscard]] double tip() const { return angle_ * a_.lever; }
  /// @return of the tip [m/s]
  [[nodiscard]] double speed() const { return speed_ * a_.lever; }

 private:
  static constexpr int kSubsteps = 2;
  static constexpr double kSubstep = kStep / kSubsteps;

  OneAxis a_;
  int algorithm_no_;
  edp::IncrementalRegulator incremental_;
  edp::CompensatingRegulator compensating_;
  Encoder encoder_;
  ShaftFriction friction_{};
  std::mt19937_64 random_{1};
  std::normal_distribution<double> normal_{};
  std::int32_t count_{};
  double set_{};  // [increments]
  double angle_{}, speed_{}, force_{}, velocity_{};
};

}  // namespace mrroc::sim
