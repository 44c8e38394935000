// What is simulated of mobile platforms, as it really is: drivers and kernels believe something else.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/motion_capture_config.hpp"
#include "base/platform_hardware.hpp"
#include "base/platform_path.hpp"
#include "base/room_config.hpp"
#include "base/step_interval.hpp"
#include "robots/skid_steer.hpp"
#include "sim/time_interval.hpp"

namespace mrroc::sim {

/// Duration of a step of the simulation and of an effector driver [s].
inline constexpr double kPlatformStep = kPlatformPeriod / kPlatformSteps;

/// Things that break on purpose, each while its steps last.
struct PlatformFaults {
  int wheel{};                 ///< to which the faults of one wheel happen, 0..3: FL, FR, RL, RR
  StepInterval wheel_blocked;  ///< it does not turn
  StepInterval encoder_stuck;  ///< its encoder counts no increments, and never makes up for them
  StepInterval imu_silent;     ///< imu_valid is false
  StepInterval imu_nan;        ///< the IMU gives numbers that are none
  StepInterval load_stuck;     ///< the load cells repeat their last reading
  StepInterval load_wrong;     ///< the load cell of the wheel shows twice its load
  StepInterval load_silent;    ///< load_valid is false
};

/// Inertial measurement unit.
struct ImuParameters {
  double noise{0.005};     ///< standard deviation of a reading of the rate [rad/s]
  double bias{0.003};      ///< largest offset of the rate at power-up, drawn once per seed [rad/s]
  double bias_walk{2e-5};  ///< growth of its standard deviation [rad/s per root of a second]
};

/// Load cells above the wheels.
struct LoadCellParameters {
  double noise{0.01};  ///< standard deviation of a reading, as a share of the load
  double bias{2};      ///< largest constant offset, drawn once per seed [N]
};

/// One platform.
struct PlatformParameters {
  robots::SkidSteerParameters body;  ///< as this one really is
  std::array<double, 2> centre{};    ///< of mass, x and y in B [m]
  double height{0.2};       ///< of the centre of mass above the ground [m]: loads shift when it accelerates
  double load_time{0.01};   ///< within which they do [s]
  double motor_lag{0.004};  ///< time constant of a drive's torque [s]
  double ripple{0.01};      ///< amplitude of the torque over the turn of a wheel, as a share of it
  PlanarPose start;         ///< of B on M at the beginning
  ImuParameters imu;        ///< its IMU
  LoadCellParameters load_cells;  ///< one per wheel
  PlatformFaults faults;          ///< what breaks
};

/// A box that stands on the ground, and slides when it is pushed.
struct BoxParameters {
  std::string name{};              ///< of its table and channels
  double length{0.5}, width{1.5};  ///< of the outline, along x and y of the box [m]
  double mass{75};                 ///< [kg], its weight lies evenly on the ground
  double friction{0.4};            ///< coefficient of its base on the ground, Coulomb's
  double grip{0.5};    ///< the same of its sides against what touches them; of two boxes the smaller
  PlanarPose start{};  ///< of its middle on M at the beginning
};

/// Friction of a wheel along and across it.
struct Friction {
  double mu_x{0.7};  ///< along
  double mu_y{0.6};  ///< across
};

/// Part of the ground with another friction: a rectangle along the axes of M.
struct GroundPatch {
  RoomPoint lower{}, upper{};  ///< corners [m]
  double scale{1};             ///< of both coefficients
  double from{};               ///< simulated time at which it comes [s]
};

/// The way friction grows with slip.
enum class GroundModel : std::uint8_t {
  sharp,  ///< nearly Coulomb's, and the wheels' loads shift with acceleration: another structure than the kernels have
  smooth,  ///< that of the kernels: over their slip speed, loads as at rest
};

/// The ground.
struct GroundParameters {
  GroundModel model{GroundModel::sharp};  ///< of friction
  double slip_speed{0.01};                ///< v_s of the sharp model [m/s]
  Friction friction;                      ///< where no patch is
  std::vector<GroundPatch> patches;       ///< where they overlap, their scales multiply
};

/// Motion capture as it really is.
struct MotionCaptureParameters {
  MotionCaptureSetup setup;                  ///< as everybody knows it
  std::array<double, 2> noise{0.005, 0.01};  ///< standard deviations of x and y [m], of phi [rad]
  double outliers{};                         ///< share of readings that are wrong
  std::array<double, 2> outlier{0.5, 1};     ///< by how much they are wrong [m, rad]
  TimeIntervals lost;                        ///< when it sees neither platforms nor boxes
  PlanarPose offset;                         ///< error of its frame...
  TimeInterval displaced;                    ///< ...in this time
};

/// Platforms in their room.
struct PlatformWorldParameters {
  std::vector<PlatformParameters> platforms;  ///< one or two
  std::vector<BoxParameters> boxes;           ///< at most kMostBoxes
  GroundParameters ground;                    ///< below them
  Room room;                                  ///< around them
  MotionCaptureParameters motion_capture;     ///< of all of them, and of the boxes
  int micro_steps{10};                        ///< of wheels and slip in a millisecond, at least 1
};

}  // namespace mrroc::sim
