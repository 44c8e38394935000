// What the kernel of a platform gives to its effector driver: properties, state estimators and trajectory trackers
// (paper REX: the virtual effector e_1,1 with its model-based controller and its state estimator). Every step() and add()
// is real-time safe: no allocation, no lock, no exception, bounded work; the same inputs give the same bits.
#pragma once
#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "base/platform_command.hpp"

namespace mrroc::edp {

/// Constant properties of a platform.
struct PlatformProperties {
  std::string_view name;              ///< for messages and the configuration
  double wheel_radius{};              ///< [m]
  double half_track{};                ///< from the middle to a wheel's plane [m]
  double increments_per_turn{};       ///< of a wheel's encoder
  double max_torque{};                ///< of a drive, at the wheel [N m]
  double brake{};                     ///< torque of a short-circuited motor against its speed [N m s/rad]
  double braking_torque{};            ///< of a drive that brakes while it moves, at the wheel [N m]; 0: never
  double max_wheel_speed{};           ///< [rad/s]
  double max_speed{};                 ///< |v| of a fragment [m/s]
  double max_turn_rate{};             ///< |w| of a fragment [rad/s]
  double max_lateral_acceleration{};  ///< |v w| of a fragment [m/s^2]
  double horizon_period{0.05};        ///< between points of the tracker's reference [s]

  /// @return what no wheel can turn at [rad/s]: an encoder that tells more is wrong
  [[nodiscard]] constexpr double impossible_wheel_speed() const noexcept { return 1.5 * max_wheel_speed; }
};

/// What SYNCHRO has found at rest, for the estimator to begin with. Trivially copyable.
struct StandingStill {
  std::int64_t step{};            ///< of the last reading
  PlanarPose p;                   ///< of B on M, from the map
  PlanarCovariance covariance{};  ///< of p
  double yaw_offset{};            ///< heading on the map minus yaw of the IMU [rad]
  double gyro_bias{};             ///< [rad/s]
  PerWheel load{};                ///< means of the load cells [N]
  PerWheel theta{};               ///< turned by the wheels since power-up [rad]
};

/// Measurements of one stage: of the reading at a boundary. Trivially copyable.
struct StageReading {
  std::int64_t step{};   ///< of the reading, a multiple of kPlatformSteps
  PerWheel theta{};      ///< turned by the wheels since power-up [rad]
  PerWheel theta_dot{};  ///< [rad/s] at the reading: not the mean of a macrostep, which lags by half of it
  double yaw{};          ///< of the IMU [rad]
  double yaw_rate{};     ///< of the IMU [rad/s]
  bool imu_valid{};      ///< yaw and yaw_rate mean something
  PerWheel load{};       ///< mean over the last macrostep [N]
  PerWheel torque{};     ///< commanded since the stage before, mean [N m]
  bool enabled{
      true};  ///< false: the drives braked since the stage before: torque is what the brake is believed to give
};

/// Health of a solver's or filter's step.
struct Health {
  bool ok{true};              ///< the result can be used
  bool solver_failed{};       ///< a QP was not solved; the result is the best guess without it
  bool inconsistent{};        ///< a map pose of this step was beyond the 99.9 % ellipse of the estimate
  std::int32_t iterations{};  ///< of the solver
};

/// Result of an estimator's step.
struct EstimatorResult {
  PlatformEstimate estimate;  ///< of the newest stage
  Slip slip;                  ///< estimated: mu_x, mu_y > 0, |split| < 1
  Slip slip_sd{0, 0, 0};      ///< standard deviations
  double mass{};              ///< weighed at SYNCHRO [kg]
  PlanarPose centre;          ///< centre of mass in B, weighed; phi is not used
  Health health;              ///< of this step
  /// By how much all that it believes was moved in this step, since the map contradicted the pose alone: p became
  /// chained(displacement, p). How the platform moves has not changed.
  PlanarPose displacement{};
};

/// State estimator (MHE, or another).
class Estimator {
 public:
  virtual ~Estimator() = default;
  /// Begins anew with what SYNCHRO has found; weighs the platform. May be called again.
  virtual void begin(const StandingStill& found) noexcept = 0;
  /// A new stage; the oldest leaves the window. Stages come every kPlatformSteps steps without a gap.
  virtual void add(const StageReading& reading) noexcept = 0;
  /// @return false: it is not between two stages of the window, and is ignored
  virtual bool add(const OdometryReading& odometry) noexcept = 0;
  /// @return false: it is not of a stage of the window, and is ignored. Steps between stages are interpolated
  virtual bool add(const MapPose& pose) noexcept = 0;
  /// @return the state of the newest stage, with everything that has been added
  virtual EstimatorResult step() noexcept = 0;
};

/// Result of a tracker's step.
struct TrackerResult {
  PerWheel torque{};                                   ///< for the next macrostep [N m], within the limit
  std::array<PlanarPose, kHorizonPoints> horizon{};    ///< where it expects B
  std::array<PerWheel, kHorizonPoints - 1> torques{};  ///< that it expects to give
  Health health;                                       ///< of this step
};

/// Trajectory tracker (NMPC, or another).
class Tracker {
 public:
  virtual ~Tracker() = default;
  /// Forgets what it has; the platform is at rest there.
  virtual void begin(const EstimatorResult& x) noexcept = 0;
  /// @param x          state, weighed mass and centre
  /// @param slip       to be used: estimated or nominal
  /// @param load       of the wheels to be used [N]
  /// @param reference  kHorizonPoints points, properties().horizon_period apart, the first is for now; phi unwrapped, not
  ///                   necessarily near that of x
  virtual TrackerResult step(const EstimatorResult& x, const Slip& slip, const PerWheel& load,
                             std::span<const PathPoint, kHorizonPoints> reference) noexcept = 0;
};

/// A kind of platform. It never changes.
class Platform {
 public:
  virtual ~Platform() = default;
  /// @return constants; live as long as this object
  [[nodiscard]] virtual const PlatformProperties& properties() const noexcept = 0;
  /// @return names of the estimators and trackers that it has; the first is the default
  [[nodiscard]] virtual std::span<const std::string_view> estimators() const noexcept = 0;
  [[nodiscard]] virtual std::span<const std::string_view> trackers() const noexcept = 0;
  /// @param kind  one of estimators() @return never null
  /// @throws std::invalid_argument  of another kind
  [[nodiscard]] virtual std::unique_ptr<Estimator> estimator(std::string_view kind) const = 0;
  /// @param kind  one of trackers() @return never null
  /// @throws std::invalid_argument  of another kind
  [[nodiscard]] virtual std::unique_ptr<Tracker> tracker(std::string_view kind) const = 0;
};

}  // namespace mrroc::edp
