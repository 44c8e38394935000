// Aggregates the errors that two cameras see into one (VS 3.5.5).
#pragma once
#include "base/camera.hpp"
#include "base/pose.hpp"

namespace mrroc::visual_servo {

/// Method of aggregating the errors.
enum class Aggregation : std::uint8_t {
  mean,       ///< with equal weights: the paper's choice
  switching,  ///< the smaller one
  weights,    ///< each as far as its camera is sure of it: inverse covariance
};

/// Error seen by one camera.
struct CameraError {
  Pose e;  ///< desired displacement of E, in E
  Matrix6
      covariance;  ///< of xi in e exp(xi): x y z [m], ax ay az [rad] along and about the axes of the desired E;
                   ///< positive definite
};

/// The length of an error that switching compares [m]: a radian counts as much as kLever.
inline constexpr double kLever = 0.2;
/// @return length of the error so measured [m]
[[nodiscard]] double length_of(const Pose& e);

/// E C of VS (53), on SE(3). The order of a and b makes no difference with mean and switching, and with weights none
/// to first order of their distance. Pure and real-time safe.
/// @return error and its covariance, as if those of a and b were independent
[[nodiscard]] CameraError aggregate(Aggregation method, const CameraError& a, const CameraError& b);

}  // namespace mrroc::visual_servo
