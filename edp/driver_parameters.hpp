// Constants of one effector driver, from the configuration.
#pragma once
#include <array>
#include <optional>

#include "base/axes.hpp"
#include "base/pose.hpp"
#include "base/spatial.hpp"
#include "edp/deceleration.hpp"
#include "edp/gripper.hpp"
#include "edp/limits.hpp"
#include "edp/oscillation.hpp"
#include "edp/servo_coefficients.hpp"

namespace mrroc::edp {

/// Force/torque sensor in the wrist.
struct ForceSensorParameters {
  Pose T_WS;                              ///< sensor in the wrist, constant
  double weight{};                        ///< w, of everything beyond the sensor [N], >= 0
  Vector3 mass_centre = Vector3::Zero();  ///< P = W_G P [m], in W
  Wrench range{{65, 65, 200, 5, 5, 5}};   ///< |reading| from which the sensor is saturated [N], [N m]
  int average{1};  ///< readings in the moving average, 1..4. The original took 2; a reading here is already
                   ///< the mean over its step, and every further one delays the force and costs stable
                   ///< stiffness of contact (docs/stability.md)
  double low_pass{};   ///< corner of a first-order filter behind the average [Hz], 0: none. It costs stable
                       ///< stiffness too
  int fault_after{3};  ///< bad readings (absent, not finite, saturated) in succession that are a fault; until
                       ///< then the last good one stands, so that one shock does not stop a task
  int stuck_after{};   ///< equal readings of one component in succession that are a fault, 0: readings come
                       ///< without noise and may be equal for ever
};

/// When the supervision of the drives calls a fault.
struct SupervisionParameters {
  double over_speed{1.25};      ///< measured motor speed, as a multiple of AxisProperties::max_motor_speed
  double following_error{1.5};  ///< set minus measured motor position [rad] of the shaft
  /// Steps in succession in which a motor that moves the arm may give all the torque that its drive, or its regulator,
  /// allows without gaining speed, >= 1: a jump of the set velocity takes some.
  int torque_steps{25};
};

/// Action of SYNCHRO.
enum class Synchronisation : std::uint8_t {
  known_pose,  ///< believes that the arm stands at synchro_joints: nothing moves
  homing       ///< looks for the switches and zero marks of all axes (edp/homing.hpp)
};

/// Homing of one axis.
struct AxisHoming {
  double coarse{15};  ///< speed of the motor while looking for the switch, which lies towards lower positions
                      ///< [rad/s], positive; 0.03 rad per step
  double fine{3.5};   ///< speed of the motor while leaving it [rad/s], positive; 0.007 rad per step
  double position{0};  ///< of the motor at the first zero mark above the switch [rad]
};

/// Homing of a robot. Source of the figures: the original framework.
struct HomingParameters {
  int first_axis{};  ///< where the order begins; the other axes follow by number, then those before it
  std::array<AxisHoming, kMaxAxes> axis{};  ///< by number of the axis
  int ramp_steps{10};                       ///< of a change between rest and the coarse speed
  int standstill_steps{250};                ///< on the switch
  int settle_steps{25};                     ///< after the zero mark
  bool returns{};  ///< when all positions are known the arm goes back to where it stood before
};

/// Everything that a Driver must know beyond its robot.
struct DriverParameters {
  double dt{0.002};               ///< duration of a step [s]
  int n_s{10};                    ///< steps of a macrostep without a motion command; it replies in step
                                  ///< n_s - 1 (in step 1 when n_s is 1)
  int stop_steps{kMaxStopSteps};  ///< steps of the stop when commands end, 1..kMaxStopSteps
  int start_guard_steps{0};  ///< steps after the start in which every command is refused; 0.25 s / dt when
                             ///< nothing else keeps a left-over sender's commands away
  Synchronisation synchronisation{Synchronisation::known_pose};  ///< what SYNCHRO does
  AxisVector synchro_joints;  ///< joints at which SYNCHRO finds the arm [rad], track [m]; one per axis. Only
                              ///< for known_pose
  HomingParameters homing;    ///< for Synchronisation::homing
  std::optional<GripperParameters> gripper;  ///< none: the robot has no motor-driven jaws
  double jaws{0.074};  ///< distance at which SYNCHRO finds the jaws [m]. Only for known_pose
                       ///< and for jaws_known
  bool
      jaws_known{};  ///< an arm that is homed believes `jaws`, as with known_pose: a hand that holds something must not
                     ///< open its jaws to find their stop
  Pose T_WE;                          ///< tool in the wrist until SET ROBOT_MODEL says otherwise
  ForceSensorParameters force;        ///< of the sensor in the wrist
  Limits limits;                      ///< of commands and set points
  SupervisionParameters supervision;  ///< of measured values
  std::optional<ServoChoice>
      servo;  ///< regulators of all motors at the start; without: those of the robot's table
  OscillationParameters oscillation;  ///< of contacts that swing
};

}  // namespace mrroc::edp
