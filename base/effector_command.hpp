// The messages between a control subsystem and its effector driver: y_ce and x_ce (MG 7, fig. 7-10).
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "base/axes.hpp"
#include "base/axis_command.hpp"
#include "base/fault.hpp"
#include "base/hardware.hpp"

namespace mrroc {

/// Instructions of the effector driver. SET, GET, SET_GET, SYNCHRO and QUERY are the papers'; reset
/// acknowledges a fault; keep and release are what a control subsystem says in a macrostep in which it
/// commands nothing.
enum class Instruction : std::uint8_t { keep, set, get, set_get, synchro, query, reset, release };

/// Parts that SET sets and GET gets; a bit mask.
enum class Part : std::uint8_t { arm = 1, robot_model = 2, io = 4, force_bias = 8 };
constexpr std::uint8_t operator|(Part a, Part b) {
  return static_cast<std::uint8_t>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
/// @param mask  of Part bits  @return whether the part is in it
constexpr bool has(std::uint8_t mask, Part p) { return (mask & static_cast<std::uint8_t>(p)) != 0; }

/// Interpolation mu of the macrostep (MG fig. 8).
/// mim: between motor positions; tcim: in the task frame, towards a pose or with the velocities of its rows.
enum class Interpolation : std::uint8_t { mim, tcim_pose, tcim_velocity };

/// Representation of a pose (MG tab. 1): how EffectorCommand::arm.pose is to be read.
/// motors [rad] and joints [rad, m]: one number per axis; frame: 4x4 homogeneous matrix, row by row;
/// xyz_euler_zyz and xyz_angle_axis: x, y, z [m] and three angles [rad].
enum class Representation : std::uint8_t { motors, joints, frame, xyz_euler_zyz, xyz_angle_axis };

/// Whether a pose is given from the base or from the present set pose (MG tab. 1).
enum class Reference : std::uint8_t { absolute, relative };

/// Which value a reply carries: measured by the encoders, or set for step n_Q (edp.md, feedback variants 1
/// and 2).
enum class Feedback : std::uint8_t { measured, set_value };

/// Sixteen numbers that hold a pose in any representation.
using PoseNumbers = std::array<double, 16>;

/// SET ARM: one macrostep of motion.
struct ArmCommand {
  Interpolation mu{Interpolation::tcim_velocity};        ///< how the driver makes steps of the macrostep
  Representation representation{Representation::frame};  ///< of pose; ignored in TCIM-VELOCITY
  Reference reference{Reference::absolute};              ///< of pose; ignored in TCIM-VELOCITY
  PoseNumbers pose{};                                    ///< desired pose, ignored in TCIM-VELOCITY
  TaskFrameCommand
      frame{};  ///< behaviour, F_d, r'_d, I, B per axis of E; ignored in MIM; r'_d is ignored in TCIM-POSE
  std::uint16_t n_s{10};  ///< number_of_steps of the macrostep, 1..kMaxSteps
  std::uint16_t n_Q{9};   ///< value_in_step_no: the step of the reply, 1..n_s + 1
  double gripper{};       ///< g_gd, desired distance between the jaws [m]; 0: as they are. Robots without a
                          ///< gripper ignore it
};
/// Largest n_s.
inline constexpr std::uint16_t kMaxSteps = 1000;

/// ROBOT_MODEL (MG fig. 8, 10): SET uses the parts that are marked; a reply to GET has all of them.
struct RobotModel {
  bool set_tool{};                                            ///< TOOL: use the tool below
  Representation tool_representation{Representation::frame};  ///< frame, xyz_euler_zyz or xyz_angle_axis
  PoseNumbers tool{};                                         ///< T_WE, the tool in the wrist
  bool set_kinematic_model{};          ///< KINEMATIC_MODEL: use the set below; only at standstill
  std::uint16_t kinematic_model{};     ///< parameter_set_no, of those that the robot has; 0: nominal
  std::uint8_t set_servo_algorithm{};  ///< SERVO_ALGORITHM: bit k: use the numbers of motor k below
  std::array<std::uint8_t, kMaxAxes> servo_algorithm{};      ///< algorithm_no per motor
  std::array<std::uint8_t, kMaxAxes> servo_parameter_set{};  ///< algorithm_parameter_set_no per motor
  bool set_force_tool{};                ///< FORCE_TOOL: use the numbers below; biases anew at once
  double weight{};                      ///< w [N], >= 0, of everything beyond the sensor
  std::array<double, 3> mass_centre{};  ///< P = W_G P [m], in W
};

/// y_ce: one message of a control subsystem to its effector driver. Trivially copyable.
struct EffectorCommand {
  std::int64_t session{};  ///< of the sender; a driver obeys one session at a time
  std::int64_t
      number{};  ///< sequence number 1, 2, 3...; keep and release have the number of the last command
  std::int64_t macrostep{};  ///< stamp: the macrostep in which the command is to be executed
  Instruction instruction{Instruction::keep};                     ///< what the driver is to do
  std::uint8_t set{};                                             ///< Part mask for SET and SET_GET
  std::uint8_t get{};                                             ///< Part mask for GET and SET_GET
  Representation get_representation{Representation::frame};       ///< of EffectorReply::pose
  Representation get_tool_representation{Representation::frame};  ///< of EffectorReply::robot_model.tool
  Feedback feedback{Feedback::measured};                          ///< of EffectorReply::pose
  std::int64_t queried{};    ///< QUERY: number of the command whose reply is wanted
  ArmCommand arm{};          ///< for SET with Part::arm
  RobotModel robot_model{};  ///< for SET with Part::robot_model
  std::uint16_t outputs{};   ///< OUTPUTS: binary output lines of the robot controller
};

/// State of an effector driver.
enum class DriverState : std::uint8_t {
  not_synchronised,  ///< the positions of the motors are unknown, the arm stands
  homing,            ///< SYNCHRO looks for the positions
  ready,             ///< stands since SYNCHRO or a reset
  executing,         ///< follows a SET ARM
  decelerating,      ///< comes to rest: no command followed, or the macrostep failed
  holding,           ///< at rest
  faulted,           ///< braked by a fatal fault, waits for a reset
  jogging            ///< not synchronised, and moves by relative motor positions or comes to rest
};
/// Number of states.
inline constexpr std::size_t kDriverStates = 8;
/// @return name of the state, as in logs
std::string_view to_string(DriverState s);

/// Currents of the motors over all steps since the reply before, one number per motor.
struct CurrentStatistics {
  std::array<double, kMaxAxes> mean{};      ///< [A]
  std::array<double, kMaxAxes> least{};     ///< [A]
  std::array<double, kMaxAxes> greatest{};  ///< [A]
  std::array<double, kMaxAxes> rms{};       ///< root of the mean square [A]: what heats the motor
};

/// Result of a command.
/// none: there was none; failed: it was taken, and its macrostep could not go on.
enum class Verdict : std::uint8_t { none, executed, refused, failed };

/// x_ce: the answer, sent in step n_Q. Trivially copyable. "Measured" values are of that step.
struct EffectorReply {
  std::int64_t session{};    ///< of the command; without one that of the owner, 0: the driver has none
  std::int64_t number{};     ///< of the command that it answers; 0: no command was there in this macrostep
  std::int64_t macrostep{};  ///< stamp: x_ce of that macrostep (the command's stamp + 1)
  std::int64_t step{};       ///< step of the reading
  std::int64_t expected{};   ///< next number that the driver will execute
  Verdict verdict{Verdict::none};                    ///< on the command
  Fault fault{};                                     ///< why it was refused or failed
  DriverState state{DriverState::not_synchronised};  ///< when it answers
  std::uint8_t parts{};  ///< Part mask of what was got: arm (pose), robot_model, io (inputs, analog)
  Representation representation{Representation::frame};  ///< of pose
  PoseNumbers pose{};  ///< E in the base, measured or set value as asked, in the representation asked for
  std::array<double, 6> T_0E{};           ///< measured pose of E in the base, x y z [m], angle-axis [rad]
  Wrench F_a{};                           ///< adjusted force in E (MG 45)
  std::array<double, kMaxAxes> joints{};  ///< measured [rad], track [m]
  std::array<double, kMaxAxes> motors{};  ///< measured [rad]
  double gripper{};                       ///< g_gm, measured distance between the jaws [m]
  bool blocked{};                         ///< g_b, the jaws hold something
  CurrentStatistics current{};            ///< of the motors since the reply before
  RobotModel robot_model{};               ///< GET ROBOT_MODEL: what the driver works with
  std::uint16_t inputs{};                 ///< GET INPUTS: binary input lines of the robot controller
  std::array<double, kAnalogInputs> analog{};  ///< GET INPUTS: analog lines [V]
  bool position_known{};  ///< the motors have been synchronised: joints and poses mean something
  bool
      at_rest{};  ///< the robot rests: brakes closed or set point standing, and its encoders have stood for 0.2 s
};

/// One step's proprioceptive reading, for virtual sensors that aggregate them (MS 27).
struct StepSample {
  std::array<double, 6> T_0E{};  ///< measured pose of E in the base, x y z [m], angle-axis [rad]
  Wrench F_a{};                  ///< adjusted force in E
};

}  // namespace mrroc
