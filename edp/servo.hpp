// EDP_SERVO: the position regulators of all motors.
#pragma once
#include <array>

#include "base/hardware.hpp"
#include "edp/robot.hpp"
#include "edp/servo_coefficients.hpp"

namespace mrroc::edp {

/// One regulator per motor, in encoder increments as real numbers: the fractions of a slow motion are not
/// lost. While a set position stands, its regulator does not see the shaft move within kPlay: it would answer
/// every edge of the encoder with a jolt, and the arm would never be at rest. Real-time safe but for the
/// constructor.
class Servo {
 public:
  /// Every motor begins with the standard regulator of the robot's table.
  /// @param robot must live longer than the servo @param dt duration of a step [s]; the coefficients of
  /// algorithm 0 hold for 0.002 s only
  explicit Servo(const Robot& robot, double dt);

  /// @return whether there is such a regulator; any numbers may be asked for
  [[nodiscard]] static constexpr bool known(int algorithm_no, int parameter_set_no) noexcept {
    return algorithm_no >= 0 && algorithm_no < kServoAlgorithms && parameter_set_no >= 0 &&
           parameter_set_no < kServoSets;
  }

  /// Chooses the regulator of one motor, from the next step on. In motion or at rest: the duty cycle goes on
  /// without a step, and no position is lost.
  /// @return false, and nothing changes, when the robot has no such motor or the regulator is not known()
  bool select(int motor, int algorithm_no, int parameter_set_no) noexcept;

  /// @param motor 0..axes()-1 of the robot
  [[nodiscard]] ServoChoice selected(int motor) const noexcept {
    return motors_[static_cast<std::size_t>(motor)].choice;
  }

  /// @return by motor: whether its regulator would have asked for more current than it may in the last step. One
  ///         that does not know its drive (algorithm 0) never says so
  [[nodiscard]] std::array<bool, kMaxAxes> at_limit() const noexcept;

  /// Forgets the past: the motors are where they are set to be. The regulators stay selected.
  void reset() noexcept;

  /// One step. @param set_increment         motion of the set positions in this step [rad]
  /// @param measured_increment    motion of the shafts in the step before [encoder increments]
  /// @param gravity_feed_forward  torques of the motors that hold the known load, Robot::gravity() [N m]
  /// @return duty cycles [1/255 of the supply]; zero beyond the robot's axes
  [[nodiscard]] std::array<double, kMaxAxes> step(const AxisVector& set_increment,
                                                  const AxisVector& measured_increment,
                                                  const AxisVector& gravity_feed_forward) noexcept;

  /// One step in which the brakes hold the shafts: the regulators wait, and hear later how far the shafts
  /// moved.
  void braked(const AxisVector& measured_increment) noexcept;

  /// Motion of a shaft about its place that a standing regulator does not see, to either side [increments].
  static constexpr double kPlay = 1;

 private:
  struct Motor {
    ServoChoice choice;
    double increments_per_rad{};
    std::array<IncrementalRegulator, kServoSets> incremental;
    std::array<CompensatingRegulator, kServoSets> compensating;
    double error{};      // set position minus what the regulator has seen of the shaft [increments]
    double unseen{};     // motion that the regulator has not been told [increments]
    double last_set{};   // set increment of the step before [increments]
    double last_seen{};  // motion seen in the step before [increments]
    bool driven{};       // since the last reset
    double pwm{};        // of the step before
    [[nodiscard]] double see(double set_increment, double measured_increment) noexcept;
    [[nodiscard]] double step(double set_increment, double measured_increment,
                              double gravity_feed_forward) noexcept;
  };

  const Robot* robot_;
  std::array<Motor, kMaxAxes> motors_;
};

}  // namespace mrroc::edp
