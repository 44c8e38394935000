// Noise that the state estimators of Rex count with. Found against a plant of another structure (sharper friction, heavier,
// its centre of mass elsewhere), with the delays of motion capture and odometry.
#pragma once

namespace mrroc::rex {

/// Standard deviations. Process noise is that of one stage of the window, 20 ms.
struct EstimatorNoise {
  double wheel_speed{0.05};        ///< of a measured wheel speed [rad/s]
  double yaw_rate{0.01};           ///< of the gyro, with what its bias wanders [rad/s]
  double yaw{0.05};                ///< of the IMU's yaw, with what its offset wanders [rad]
  double map_position{0.003};      ///< of a position on the map: at least [m]
  double map_heading{0.004};       ///< of a heading on the map: at least [rad]
  double odometry_position{5e-4};  ///< of a motion between two pictures: at least [m]
  double odometry_scale{
      0.04};  ///< of a motion between two pictures, as a share of it: what a calibration is off
  double odometry_heading{1.5e-4};  ///< of a turn between two pictures: at least [rad]
  double pose_process{7.07e-4};     ///< of x and y [m] and of phi [rad]
  double velocity_process{0.0212};  ///< of vx and vy [m/s] and of w [rad/s]
  double wheel_process{0.0566};     ///< of the wheels' speeds [rad/s]
  double braked_wheel_process{
      1};  ///< of the wheels' speeds while the drives brake: their torque is only believed
  double slip_process{2.83e-3};  ///< of mu_x, mu_y and split while the platform moves; none at rest
  double rest_speed{0.02};       ///< below it the platform is at rest [m/s]
};

/// Standard deviations of what is known at the beginning.
struct EstimatorPrior {
  double velocity{0.0316};  ///< of vx, vy [m/s], w [rad/s]
  double wheel_speed{0.1};  ///< [rad/s]
  double friction{0.3};     ///< of mu_x and mu_y; also the most that they get later
  double split{0.2};        ///< also the most that it gets later
  double pose{0.003};       ///< of x, y [m] and phi [rad]: at least
};

/// Ranges of the slip coefficients. Wheels that hardly slip tell of the ground's stiffness alone: on a straight a stiff one looks
/// like one of any friction, and in the next curve the estimate would have to come down from there. No ground in the room holds better.
struct SlipBounds {
  double least_friction{0.05};  ///< of mu_x and mu_y
  double most_friction{1.0};    ///< of mu_x and mu_y
  double most_split{0.8};       ///< of |split|
};

}  // namespace mrroc::rex
