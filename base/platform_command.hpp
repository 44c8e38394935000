// The messages between the control subsystem of a platform and its effector driver: y_ce and x_ce (paper REX, sec. 4 and
// 5), and what they are made of.
#pragma once
#include <array>
#include <cstdint>

#include "base/effector_command.hpp"
#include "base/platform_hardware.hpp"
#include "base/platform_path.hpp"

namespace mrroc {

/// Covariance of x, y [m], phi [rad], row by row.
using PlanarCovariance = std::array<double, 9>;

/// A position of the platform on the map, e_y_c1,1[map]. Trivially copyable.
struct MapPose {
  std::int64_t step{};            ///< at which it was measured; it comes later
  bool valid{};                   ///< there is one; else the rest means nothing
  PlanarPose p;                   ///< of B on M, phi wrapped
  PlanarCovariance covariance{};  ///< symmetric, positive
};

/// Relative motion between two pictures, e_y_c1,1[A]: what visual odometry has measured. Trivially copyable.
struct OdometryReading {
  std::int64_t step_before{};           ///< at which the first pair of pictures was taken
  std::int64_t step{};                  ///< at which the second was taken, > step_before
  bool valid{};                         ///< there is a measurement; else the rest means nothing
  std::array<double, 12> A{};           ///< rows of [R P]: B at `step` in B at `step_before` [m]
  std::array<double, 36> covariance{};  ///< of x y z [m], ax ay az [rad] along B, row by row
};

/// Change of the pace in an iteration at most, when a pause begins or ends.
inline constexpr double kPaceChange = 0.1;
/// What a pause and its end change the speed by at most [m/s^2]: what tyres can give on slippery ground, too. Up to 0.6 m/s a
/// stop is gentler; the platform is at rest in about 200 steps then.
inline constexpr double kPaceAcceleration = 2;

/// y_ce of a platform. Trivially copyable. What stands behind `fragment` is not numbered: it goes with every message, also
/// with keep, and the newest counts.
struct PlatformCommand {
  std::int64_t session{};    ///< as EffectorCommand has it
  std::int64_t number{};     ///< as EffectorCommand has it
  std::int64_t macrostep{};  ///< stamp: the macrostep in which the command is to be executed
  Instruction instruction{Instruction::keep};  ///< set hands the fragment over; get and set_get are refused
  std::int64_t queried{};                      ///< QUERY: number of the command whose reply is wanted
  Fragment fragment{};                         ///< for SET
  double pace{1};              ///< of the fragment's time, 0 stands .. 1 as planned; not numbered
  OdometryReading odometry{};  ///< not numbered
  MapPose map{};               ///< not numbered
};

/// What the state estimator says. Trivially copyable.
struct PlatformEstimate {
  std::int64_t step{};            ///< of the reading of the newest stage
  PlanarPose p;                   ///< q^: of B on M, phi wrapped
  PlanarVelocity v;               ///< of B, along B
  PerWheel theta{};               ///< turned by the wheels since power-up [rad]
  PerWheel theta_dot{};           ///< speeds of the wheels [rad/s]
  PlanarCovariance covariance{};  ///< of p
};

/// Slip coefficients p of the wheels on the ground. Trivially copyable.
struct Slip {
  double mu_x{0.7};  ///< friction along the wheel, > 0
  double mu_y{0.6};  ///< friction across it, > 0
  double split{};    ///< left wheels have mu (1 + split), right ones mu (1 - split), within (-1, 1)
};

/// x_ce of a platform, sent in step n_Q. Trivially copyable.
struct PlatformReply {
  std::int64_t session{};                            ///< as EffectorReply has it
  std::int64_t number{};                             ///< as EffectorReply has it
  std::int64_t macrostep{};                          ///< as EffectorReply has it
  std::int64_t step{};                               ///< of the reading with which it was made
  std::int64_t expected{};                           ///< next number that the driver will execute
  Verdict verdict{Verdict::none};                    ///< on the command
  Fault fault{};                                     ///< why it was refused or failed
  DriverState state{DriverState::not_synchronised};  ///< when it answers
  std::int64_t accepted{};                           ///< number of the last fragment taken; 0: none
  std::int64_t notified{};    ///< number of the last fragment that has reached its notify; 0: none
  std::int64_t executing{};   ///< number of the fragment under way; 0: none
  std::int32_t iteration{};   ///< of that fragment, 0..steps
  std::int32_t remaining{};   ///< iterations to the end of the queue
  PlatformEstimate estimate;  ///< q~, q~'
  Slip slip;                  ///< as estimated
  Slip slip_sd{0, 0, 0};      ///< standard deviations of the three
  PerWheel torque{};          ///< commanded last [N m]
  PerWheel load{};            ///< of the wheels, as the kernels use them [N]
  bool adapting{};            ///< the tracker uses the estimated slip, not the nominal one
  bool position_known{};      ///< SYNCHRO has found where the platform is
  bool at_rest{};             ///< as EffectorReply has it
  std::int32_t
      late_odometry{};      ///< readings dropped because they were older than the estimator's window, so far
  std::int32_t late_map{};  ///< map poses dropped for that, so far
  std::int32_t rejected{};  ///< odometry and map poses dropped because they were no proper numbers, so far
  std::int32_t solver_failures{};  ///< iterations in which a solver failed, so far
};

/// Points of the tracker's horizon with the present one.
inline constexpr std::size_t kHorizonPoints = 21;

/// What the driver thinks, for viewers and figures. Trivially copyable.
struct PlatformTelemetry {
  std::int64_t step{};                                 ///< of the reading with which it was made
  std::array<PlanarPose, kHorizonPoints> reference{};  ///< from now on, where the platform is to be
  std::array<PlanarPose, kHorizonPoints> horizon{};    ///< where the tracker expects it
  std::array<PerWheel, kHorizonPoints - 1> torque{};   ///< that it expects to give [N m]
  std::int32_t tracker_iterations{};                   ///< of its solver
  std::int32_t estimator_iterations{};                 ///< of its solver
};

}  // namespace mrroc
