// EDP_SERVO of a motor-driven two-jaw gripper: distance of the jaws in, duty cycle out.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "base/fault.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// One gripper. The motor of the jaws stands behind those of the axes in HardwareReading and HardwareCommand.
struct GripperParameters {
  double (*distance)(double motor) noexcept {};  ///< distance between the jaws [m] at a motor position [rad]
  double (*motor)(double distance) noexcept {};  ///< motor position [rad] at a legal distance [m]
  Range legal;                                   ///< distances that may be commanded [m]
  double open_stop{};           ///< motor position at the stop that limits the opening [rad]: homing finds it
  double open_direction{-1};    ///< sign of the motor's motion that opens the jaws
  double increments_per_rad{};  ///< of the encoder
  double speed{};               ///< of the set point when the jaws close [rad/s] of the motor, positive
  double opening_speed{};       ///< the same when they open and there is nothing to be met
  double acceleration{};        ///< of the set point [rad/s^2], positive
  double homing_speed{};        ///< [rad/s], positive
  double max_current{};         ///< desired current never exceeds it: the force of the grip [A]
  double stiffness{};           ///< desired current per error of position [A/rad]
  double damping{};             ///< desired current per error of speed [A s/rad]
  double current_gain{};        ///< change of the duty cycle per step and error of current [1/255 per A]
  double over_current{};        ///< measured current that is a malfunction [A]
  double blocked_current{};     ///< the jaws are blocked when the current stays above this [A] ...
  double blocked_motion{};      ///< ... while the motor moves by less than this [rad] ...
  int blocked_steps{};          ///< ... over so many steps, 1..Gripper::kMostBlockedSteps
};

/// The gripper of one robot: set point with limited speed and acceleration, position control around a current
/// control (so that jaws that are held press with a limited, known force), and the decision whether the jaws
/// are blocked: g_b, from the motor's current and the jaws' displacement together. Current alone is also that
/// of an acceleration, standstill alone also that of jaws that are where they should be. Real-time safe.
class Gripper {
 public:
  static constexpr int kMostBlockedSteps = 64;  ///< steps in the ring of positions

  /// @param dt duration of a step [s]
  /// @throws FaultError bad_configuration
  Gripper(const GripperParameters& parameters, double dt);

  /// Looks for the stop of the opening, from an unknown position.
  void start_homing() noexcept;
  /// The jaws are known to be at this distance [m] now. @param count of the encoder
  void believe(double distance, std::int32_t count) noexcept;
  /// @return whether distances are known
  [[nodiscard]] bool known() const noexcept { return known_; }
  /// @return whether the stop of the opening is being looked for
  [[nodiscard]] bool homing() const noexcept { return homing_; }

  /// New desired distance g_gd [m], within the legal range.
  void set_distance(double distance) noexcept { goal_ = p_.motor(distance); }

  /// Takes the readings of a step. @param count of the encoder @param current [A]
  /// @return over_current, or synchro_switch_missing when homing does not find the stop
  [[nodiscard]] std::optional<Fault> measure(std::int32_t count, double current) noexcept;

  /// @return duty cycle of the step [1/255 of the supply]
  [[nodiscard]] double step() noexcept;
  /// One step without power: the set point stays where the jaws are. Jaws that held something press again
  /// when the power is back; others stay where they are.
  void braked() noexcept;

  /// @return g_gm, measured distance [m]; 0 while it is not known
  [[nodiscard]] double distance() const noexcept { return known_ ? p_.distance(motor_) : 0; }
  /// @return g_b
  [[nodiscard]] bool blocked() const noexcept { return blocked_; }
  /// @return set position of the motor [rad]
  [[nodiscard]] double set_motor() const noexcept { return set_; }
  /// @return as it was made with
  [[nodiscard]] const GripperParameters& parameters() const noexcept { return p_; }

 private:
  void move_set_point() noexcept;
  void judge_blocked() noexcept;

  GripperParameters p_;
  double dt_;
  std::int32_t last_count_{};
  bool counted_{};
  double motor_{};       // measured [rad]
  double last_motor_{};  // in the step before
  double current_{};     // measured [A]
  double set_{};         // [rad]
  double set_speed_{};   // [rad/s]
  double goal_{};        // [rad]
  double pwm_{};
  bool known_{};
  bool homing_{};
  bool blocked_{};
  std::array<double, kMostBlockedSteps> past_{};  // positions, a ring
  int steps_{};                                   // in the ring
  int homing_steps_{};
  int pressing_{};  // steps in succession with the current of a grip
};

/// @return what is wrong with a commanded distance of the jaws [m]; 0 leaves them as they are
[[nodiscard]] std::optional<Fault> check_distance(const GripperParameters& gripper, double distance) noexcept;

}  // namespace mrroc::edp
