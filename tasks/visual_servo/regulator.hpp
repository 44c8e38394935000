// The pose regulator R_T of VS 3.5.3.
#pragma once
#include "base/camera.hpp"
#include "base/pose.hpp"

namespace mrroc::visual_servo {

/// Gains and clips of R_T. Rates are of the displacement of one control step over its duration.
struct RegulatorParameters {
  double gain{0.3};           ///< share of X, Y, Z that one control step makes up for, 0 < gain <= 1
  double angular_gain{0.3};   ///< share of the angle
  double quiet{0.25};         ///< share of both gains that is left for an error that noise alone can explain
  double significance{3};     ///< standard deviations from which an error is more than noise
  double speed{0.2};          ///< clip of the correction's [X Y Z] [m/s]
  double angular_speed{0.5};  ///< clip of the correction's angle [rad/s]
  double top_speed{0.4};      ///< clip of correction and feed-forward together [m/s]
  double top_angular_speed{0.6};   ///< the same [rad/s]
  double acceleration{2};          ///< clip of the change between two control steps [m/s^2]
  double angular_acceleration{8};  ///< the same [rad/s^2]
};

/// @param ease  0..1
/// @return the same with that share of all speeds: for a robot that cannot follow as fast where it is
[[nodiscard]] RegulatorParameters eased(const RegulatorParameters& k, double ease);

/// An error that the cameras' noise could explain is made up for slowly, so that the arm averages over it.
/// @param covariance  of the error, see CameraError
/// @return the regulator with the gains for this error: its own for one of many standard deviations
[[nodiscard]] RegulatorParameters quieted(const RegulatorParameters& k, const Pose& e,
                                          const Matrix6& covariance);

/// R_T: e -> [X Y Z | axis, angle], axis kept, X Y Z and angle multiplied by the gain and clipped, the clip along the
/// direction of [X Y Z]. Pure and real-time safe.
/// @param e         desired displacement of E, in E
/// @param duration  of the control step [s]
/// @return the displacement of one control step
[[nodiscard]] Pose regulate(const RegulatorParameters& k, const Pose& e, double duration);

/// Keeps the displacements of successive control steps so near to one another that the arm moves smoothly.
/// @param wanted    displacement of the next control step, in E
/// @param previous  that of the one before; identity when the arm stood
/// @return the wanted one, clipped in its speed and in the change of its [X Y Z] and angle times axis
[[nodiscard]] Pose smooth(const RegulatorParameters& k, const Pose& wanted, const Pose& previous,
                          double duration);

}  // namespace mrroc::visual_servo
