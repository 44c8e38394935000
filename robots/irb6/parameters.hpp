// All numbers of the two IRb-6 arms: one table per arm.
//
// Source of the nominal and calibrated figures: the original framework (MRROC++, modified IRp-6 arms). The
// world's z = 0 is the floor, hence the height of the shoulder among the lengths.
#pragma once
#include <array>
#include <numbers>
#include <string_view>

#include "base/axes.hpp"
#include "edp/robot.hpp"

namespace mrroc::irb6 {

/// Rotary axes of an arm, without the track.
inline constexpr int kArmAxes = 6;
/// Axes of the arm on the track, the longest table.
inline constexpr int kMostAxes = 7;

/// Lengths of the kinematic chain [m].
struct Lengths {
  double z_offset;  ///< height of the shoulder axis above the floor
  double a2;        ///< shoulder to elbow
  double a3;        ///< elbow to wrist pitch axis
  double d5;        ///< wrist pitch axis to the origin of the wrist frame W
};

/// Ball screw that moves a pitch axis over a four-bar linkage, by the length l of its side [mm] and the
/// absolute angle theta of the link [rad]:  l^2 = sl + mi cos(theta) - ni sin(theta).
/// The usable half of the motion is the one where l grows with theta.
struct Linkage {
  double sl;  ///< [mm^2]
  double mi;  ///< [mm^2]
  double ni;  ///< [mm^2]
};

/// Gear between a motor and what it moves:  motor = synchro + gear (output - theta0).
struct Drive {
  double gear;     ///< [rad of the motor per unit of output]
  double synchro;  ///< motor position at which the output is theta0 [rad]
  double theta0;   ///< output [rad; screws: length in mm; track: m]
};

/// One axis: what the effector driver must know, and its gear.
struct AxisTable {
  edp::AxisProperties properties;  ///< ranges, encoder, regulators
  Drive drive;                     ///< between motor and axis
};

/// Rule for the position of the track when a pose is given. The arm on the track has one axis more than a
/// pose has degrees of freedom, so something must.
///
/// Whichever rule: joints that realise the pose already are its solution, so a path never jumps, and where
/// the rule is ill-conditioned, ends beyond the track's limits or beyond the reach, the track stays (or goes
/// only to its limit) and the arm does the rest. A pose that the arm reaches without its track is reached.
enum class TrackRule : std::uint8_t {
  kept,            ///< the track is a parameter: it stays where it is
  last_axis_kept,  ///< N stays, so the hand's direction says where the arm's plane stands. As in the original.
                   ///< Ill-conditioned with the hand upright and with the hand along the track
  column_kept      ///< the column stays, and the track carries the arm along y. Ill-conditioned only with the
                   ///< column along the track, and that it stays out of by itself
};

/// Everything about one arm.
struct ArmParameters {
  std::string_view name;                   ///< as in the configuration
  bool on_track;                           ///< axis 0 is the track, along y of the base
  Lengths lengths;                         ///< of the chain
  Linkage lower_arm, upper_arm;            ///< linkages of the two ball screws
  std::array<AxisTable, kMostAxes> axes;   ///< axis_count() of them are used
  std::array<double, kMostAxes> front;     ///< joints of the usual initial pose [rad, track m]
  std::array<double, 6> sensor_in_wrist;   ///< T_WS as angle-axis pose [m, rad]
  std::array<double, 6> tool_in_wrist;     ///< T_WE of the default tool as angle-axis pose [m, rad]
  double tool_weight;                      ///< of everything beyond the sensor, default tool [N]
  std::array<double, 3> tool_mass_centre;  ///< of the same, in W [m]
  std::array<double, 6> force_limit;       ///< largest contact force along and about the axes of E [N, N m]
  TrackRule track_rule{TrackRule::kept};   ///< for an arm on a track

  /// @return number of axes, 6 or 7
  [[nodiscard]] constexpr int axis_count() const { return kArmAxes + (on_track ? 1 : 0); }
  /// @return index of the column, the first of the six rotary axes
  [[nodiscard]] constexpr int first() const { return on_track ? 1 : 0; }
};

/// Which set of lengths, linkages and zero positions an arm uses.
enum class ParameterSet : std::uint8_t {
  nominal,  ///< the drawings of the arm
  /// Measured on the original's arms: lengths differ from nominal by up to 10 mm, E at the same joints by up to 20 mm.
  /// Joints at the same motors differ by up to 0.07 rad, and E then by up to 80 mm.
  calibrated
};

namespace table {

/// One degree and one turn [rad].
inline constexpr double kDegree = std::numbers::pi / 180;
inline constexpr double kTurn = 2 * std::numbers::pi;
/// A servo step of 2 ms may turn a motor by at most 0.5 rad.
inline constexpr double kMaxMotorSpeed = 0.5 / 0.002;
/// Increments of the encoders: 4000 per turn of the motor [1/rad].
inline constexpr double kIncrements = 4000 / kTurn;
/// Ball screws of the arms: 5 mm per turn [rad/mm].
inline constexpr double kScrew = kTurn / 5;
/// Screw of the track: 8 mm per turn behind a belt of 2 : 1 [rad/m].
inline constexpr double kTrackScrew = 2 * kTurn * 1000 / 8;

/// Of the current at which a drive's supervision trips: where the drive limits it.
inline constexpr double kLimitShare = 0.9;

/// The regulators of one motor. Set 0 of each algorithm is the usual one. Algorithm 0: the original's, set 1
/// without its second integral, what the original called algorithm 1: it gives way under load. Algorithm 1:
/// set 1 is softer. docs/plant.md tells where the drives' figures come from.
constexpr edp::ServoCoefficients servo(const edp::RegulatorCoefficients& original, edp::DriveModel drive) {
  edp::RegulatorCoefficients proportional = original;
  proportional.epsilon = 0;
  drive.current_limit = kLimitShare * drive.max_current;
  return {.standard = {1, 0},
          .incremental = {original, proportional},
          .compensating = {{{.bandwidth = 100, .observer = 150}, {.bandwidth = 60, .observer = 120}}},
          .drive = drive};
}

// The motor limits are the legal range. The joint limits add only what the motors cannot know: how far the
// linkages let the arm fold (q3, q4). Those of the other joints lie outside the motor limits.
constexpr AxisTable track(double synchro) {
  return {{"track",
           {-0.13, 1.22},
           {-200, 1900},
           kIncrements,
           kMaxMotorSpeed,
           servo({.epsilon = 0.010, .a = 0.412429378531, .b0 = 1.5569592, .b1 = 1.5028614},
                 {.resistance = 2.9, .inertia = 2.15e-4, .friction = 0.025, .max_current = 25})},
          {kTrackScrew, synchro, 0}};
}
constexpr AxisTable column(double synchro) {
  return {{"column",
           {-170 * kDegree, 170 * kDegree},
           {-470, 450},
           kIncrements,
           kMaxMotorSpeed,
           servo({.epsilon = 0.010, .a = 0.412429378531, .b0 = 1.5569592, .b1 = 1.5028614},
                 {.resistance = 0.9, .inertia = 6.9e-4, .friction = 0.025, .max_current = 15})},
          {-158, synchro, 0}};
}
constexpr AxisTable lower_arm(double synchro) {
  return {{"lower arm",
           {-130 * kDegree, -50 * kDegree},
           {-110, 100},
           kIncrements,
           kMaxMotorSpeed,
           servo({.epsilon = 0.008, .a = 0.655629139073, .b0 = 0.6181068, .b1 = 0.5916852},
                 {.resistance = 1.3, .inertia = 3.9e-4, .friction = 0.025, .max_current = 18})},
          {kScrew, synchro, 220.3374}};
}
constexpr AxisTable upper_arm(double synchro) {
  return {{"upper arm",
           {-25 * kDegree, 40 * kDegree},
           {-80, 100},
           kIncrements,
           kMaxMotorSpeed,
           servo({.epsilon = 0.008, .a = 0.315789473684, .b0 = 1.1984784, .b1 = 1.1424828},
                 {.resistance = 1.4, .inertia = 3.3e-4, .friction = 0.025, .max_current = 10})},
          {kScrew, synchro, 183.8348}};
}
constexpr AxisTable wrist_T(double synchro) {
  return {{"T",
           {-90 * kDegree, 92 * kDegree},
           {-70, 380},
           kIncrements,
           kMaxMotorSpeed,
           servo({.epsilon = 0.010, .a = 0.548946716233, .b0 = 0.6305064, .b1 = 0.5874396},
                 {.resistance = 1.6, .inertia = 1.91e-4, .friction = 0.025, .max_current = 10})},
          {-128, synchro, 0}};
}
constexpr AxisTable wrist_V(double synchro) {
  return {{"V",
           {-10.5, 10.5},
           {-80, 490},
           kIncrements,
           kMaxMotorSpeed,
           servo({.epsilon = 0.020, .a = 0.391982182628, .b0 = 0.4458592, .b1 = 0.4085392},
                 {.resistance = 7.2, .inertia = 3.5e-5, .friction = 0.005, .max_current = 10})},
          {-128 * 0.6, synchro, 0}};
}
constexpr AxisTable wrist_N(double synchro) {
  return {{"N",
           {-6.3, 7.8},
           {-1000, 3000},
           kIncrements / 2,
           kMaxMotorSpeed,
           servo({.epsilon = 0.005, .a = 0.3, .b0 = 0.5456, .b1 = 0.5056},
                 {.resistance = 19, .inertia = 1.51e-5, .friction = 0.005, .max_current = 10})},
          {288.8845, synchro, 0}};
}

/// The original's calibration counts V from a quarter of a turn beside the zero of the nominal sets, which no error of
/// theirs explains. Here all count from the same one [rad of the motor].
inline constexpr double kQuarterOfV = 128 * 0.6 * std::numbers::pi / 2;

/// @param synchro motor positions at synchronisation [rad]
/// @param theta0  outputs there [rad; screws: mm]
constexpr void set_zero(std::array<AxisTable, kMostAxes>& axes, const std::array<double, kMostAxes>& synchro,
                        const std::array<double, kMostAxes>& theta0) {
  for (std::size_t k = 0; k < axes.size(); ++k) {
    axes[k].drive.synchro = synchro[k];
    axes[k].drive.theta0 = theta0[k];
  }
}

}  // namespace table

/// The arm on the pedestal, nominal.
inline constexpr ArmParameters kPostument{
    .name = "irb6_postument",
    .on_track = false,
    .lengths = {.z_offset = 0.95, .a2 = 0.455, .a3 = 0.67, .d5 = 0.19},
    .lower_arm = {.sl = 77895.25, .mi = 60902.55, .ni = -29346.68},
    .upper_arm = {.sl = 77895.25, .mi = -44100, .ni = -51240},
    .axes = {table::column(-15.9), table::lower_arm(-5), table::upper_arm(-8.527), table::wrist_T(151.31),
             table::wrist_V(435.25), table::wrist_N(791.0)},
    .front = {0, -1.57, 0, 1.56, 1.57, -1.57},
    .sensor_in_wrist = {0, 0, 0.09, 0, 0, std::numbers::pi},
    .tool_in_wrist = {0, 0, 0.25, 0, 0, 0},
    .tool_weight = 10.8,
    .tool_mass_centre = {0.004, 0, 0.156},
    .force_limit = {58, 58, 130, 4.5, 4.5, 4.5},
};

/// The arm on the track, nominal.
inline constexpr ArmParameters kTrack{
    .name = "irb6_track",
    .on_track = true,
    .lengths = kPostument.lengths,
    .lower_arm = kPostument.lower_arm,
    .upper_arm = kPostument.upper_arm,
    .axes = {table::track(0), table::column(-10.819), table::lower_arm(-4.012), table::upper_arm(-6.219),
             table::wrist_T(158.997), table::wrist_V(479.5), table::wrist_N(769.7)},
    .front = {0, 0, -1.57, 0, 1.56, 1.57, -1.57},
    .sensor_in_wrist = {0, 0, 0.09, 0, 0, -std::numbers::pi / 2},
    .tool_in_wrist = {0, 0, 0.25, 0, 0, 0},
    .tool_weight = 13.18,
    .tool_mass_centre = {0.004, 0, 0.130},
    .force_limit = {58, 58, 130, 4.5, 4.5, 4.5},
};

/// The arm on the pedestal, as calibrated.
inline constexpr ArmParameters kPostumentCalibrated = [] {
  ArmParameters p = kPostument;
  p.lengths = {.z_offset = 0.95, .a2 = 0.4596, .a3 = 0.6729, .d5 = 0.1903};
  p.lower_arm = {.sl = 78379.4388, .mi = 60059.3311, .ni = -32453.0983};
  p.upper_arm = {.sl = 78379.4388, .mi = -42863.8177, .ni = -53294.4762};
  table::set_zero(p.axes, {-7.7597, -8.7537, -7.5355, 153.1366, 309.5910 + table::kQuarterOfV, 796.0265},
                  {0.0111, 211.8108, 187.6529, 0, 0.0903, 0.0209});
  return p;
}();

/// The arm on the track, as calibrated.
inline constexpr ArmParameters kTrackCalibrated = [] {
  ArmParameters p = kTrack;
  p.lengths = {.z_offset = 0.95, .a2 = 0.4647, .a3 = 0.6748, .d5 = 0.1967};
  p.lower_arm = {.sl = 79744.63, .mi = 65788.63, .ni = -22524.88};
  p.upper_arm = {.sl = 79744.63, .mi = -44612.77, .ni = -52925.22};
  table::set_zero(p.axes,
                  {-0.0117, -7.185, -23.7333, -4.0065, 153.6764, 356.0929 + table::kQuarterOfV, 791.4409},
                  {0, 0.004989, 223.9765, 189.1123, 0, 0.000898, 0.005605});
  return p;
}();

}  // namespace mrroc::irb6
