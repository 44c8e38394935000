// Decides which contact is stable under law (28): the linear loop of law, force measurement, servo and
// surroundings in discrete time. For design and documents, not for the servo step.
//
// Unlike the ideal plant of MG 8.1.3, whose damping ratio is 1 / (2 B sqrt(K I)), a real loop acts on a force
// that is late: law (28) uses the force of the step before, the reading is a mean over a step, filters delay
// it further, and the servo lags behind its set point. Each of these bounds the stiffness that is stable.
#pragma once
#include <variant>
#include <vector>

#include "base/axes.hpp"
#include "edp/compensating_regulator.hpp"
#include "edp/regulator.hpp"

namespace mrroc::edp {

/// The arm is always where it is set to be.
struct IdealServo {};

/// Servo as a low pass of first or second order, which contact does not push aside:
///
///     1:  x' = w (r - x)
///     2:  x'' = w^2 (r - x) + 2 damping w (feed_forward r' - x')     with w = 2 pi bandwidth
struct LagServo {
  double bandwidth{20};    ///< natural frequency [Hz], > 0
  int order{2};            ///< 1 or 2
  double damping{1};       ///< of order 2, > 0
  double feed_forward{1};  ///< share of the set velocity that is fed forward, order 2, 0..1
};

/// IncrementalRegulator with a voltage-driven motor, which contact also pushes aside:
///
///     w' = (speed_gain u - w) / time_constant - lever F / inertia
struct RegulatedDrive {
  RegulatorCoefficients regulator;  ///< of the position loop
  double increments_per_rad{};      ///< of the encoder on the shaft
  double speed_gain{};              ///< speed of the shaft that a duty cycle of 1/255 leads to [rad/s]
  double time_constant{};           ///< of speed after a step of voltage [s]
  double inertia{};                 ///< of all that turns with the shaft, at the shaft [kg m^2]
  double lever{};                   ///< path of the tip per angle of the shaft [m/rad]; may be negative
};

/// CompensatingRegulator with such a motor. Friction and its compensation are left out: they are not linear, and where
/// they are alike they cancel.
struct CompensatedDrive {
  CompensationCoefficients regulator;  ///< of the position loop
  DriveModel model;                    ///< what the regulator knows of the motor
  double increments_per_rad{};         ///< of the encoder on the shaft
  double inertia{};                    ///< true one of all that turns with the shaft, at the shaft [kg m^2]
  double lever{};                      ///< path of the tip per angle of the shaft [m/rad]; may be negative
};

/// One motor of a WholeArm, with the regulator that it has as a CompensatedDrive.
struct ArmDrive {
  CompensationCoefficients regulator;  ///< of the position loop
  DriveModel model;                    ///< what the regulator knows of the motor
  double increments_per_rad{};         ///< of the encoder on the shaft
  double rotor{};  ///< inertia of all that turns with the shaft without any link [kg m^2], > 0
};

/// All axes of an arm at one pose, whose tip is pushed along one axis of E: as many CompensatedDrives as motors, which
/// the links couple. What a controller may believe of it: edp/whole_arm.hpp.
struct WholeArm {
  std::vector<ArmDrive> drives;  ///< one a joint, 1..kMaxAxes
  AxisMatrix motors_per_joints;  ///< d motors / d joints there
  AxisMatrix mass;               ///< mass matrix of links and tool without rotors [kg m^2], track [kg]
  AxisVector tip;                ///< way of the tip along the contact's normal, of the joints [m/rad]
  double felt{1};  ///< share of the contact's force along the axis: cosine of axis and normal, -1..1, not 0
  AxisVector set;  ///< motion of the joints that the driver sets per way of the tip [rad/m]
  double tool{};   ///< beyond the force sensor [kg], >= 0
  AxisVector tool_centre;  ///< way of its mass centre along the axis, of the joints [m/rad]
  double wheels{0.1};      ///< share of the rotors on the links' side of gears that give way, 0..1
};

/// Any of these servos.
using ServoModel = std::variant<IdealServo, LagServo, RegulatedDrive, CompensatedDrive, WholeArm>;

/// Gears that give way between servo and tip: what the servo moves is a rotor, whose encoder it reads, and a spring pulls
/// the links behind it. A WholeArm has a spring a joint, each as stiff as the inertia that it moves, in a proportion that
/// gives the lowest mode its frequency; it knows its masses by itself.
struct GearMode {
  double frequency{};    ///< of the links on their springs, rotors held [Hz], 0: gears are rigid, else 1..100
  double damping{0.03};  ///< damping ratio of that mode, 0..1
  /// Of the links as felt at the tip, the tool's included, rotors' not [kg], > 0; of a drive's inertia it is a part.
  double mass{10};
  double tool{1.2};  ///< beyond the force sensor, which measures what accelerates it [kg], 0..mass
};

/// One axis under law (28) that presses against a spring. Rotational axes in N m, rad, kg m^2, s/(kg m^2).
struct ContactLoop {
  double inertia{20};            ///< I of law (28) [kg], >= 0
  double mobility{0.005};        ///< B of law (28) [s/kg], > 0
  double dt{0.002};              ///< step of the driver [s]
  int delay{};                   ///< steps by which the force is late beyond law (28) itself, 0..20
  int average{1};                ///< readings in the moving average, 1..20
  double low_pass{};             ///< corner of the force's low pass [Hz], 0: none
  bool mean_of_step{true};       ///< a reading is the mean over its step; false: the force at its end
  double contact_damping{};      ///< damping of the surroundings per stiffness [s]
  ServoModel servo{LagServo{}};  ///< what follows the set point
  GearMode gears{};              ///< between it and the tip
};

/// The least damped mode of a loop.
struct ContactMode {
  double radius{};     ///< largest magnitude of an eigenvalue; the loop is stable below 1
  double damping{};    ///< damping ratio of the least damped mode, below 0: unstable, 1: does not swing
  double frequency{};  ///< of that mode [Hz], 0 when it does not swing
};

/// @throw FaultError out_of_limits a parameter of the loop makes no sense; its text names it
void check_loop(const ContactLoop& loop);

/// @param stiffness of everything in series: surroundings, tool, pen [N/m], [N m/rad], >= 0
/// @throw FaultError out_of_limits a parameter of the loop makes no sense; its text names it
[[nodiscard]] ContactMode contact_mode(const ContactLoop& loop, double stiffness);

/// @return smallest stiffness at which the loop is not stable [N/m]; 0 when no contact is stable, infinite
///         when there is none up to 1e9 N/m
/// @throw FaultError out_of_limits
[[nodiscard]] double stiffness_limit(const ContactLoop& loop);

/// @return largest B with which the contact has at least this damping ratio, everything else equal [s/kg]; 0
///         when there is none from 1e-7 on
/// @throw FaultError out_of_limits
[[nodiscard]] double mobility_for(ContactLoop loop, double stiffness, double damping);

}  // namespace mrroc::edp
