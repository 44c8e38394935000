// Model-based pose of a flat object from points seen in a picture: the last stage of the receptors' chain (VS
// 41, 42), with the choice between the two poses that a picture of a flat object leaves open.
#pragma once
#include <optional>
#include <span>

#include "base/camera.hpp"

namespace mrroc::vsp {

/// One pose that explains the picture.
struct PlanarPose {
  Pose T_CG;          ///< object in the camera
  double rms_px{};    ///< root mean square distance between seen and projected points [pixel]
  double worst_px{};  ///< the largest of them [pixel]
  Matrix6 covariance = Matrix6::Zero();  ///< of x y z [m], ax ay az [rad], along the camera's axes
};

/// Both minima of the reprojection error of a flat object.
struct PlanarPoses {
  PlanarPose best;                  ///< with the smaller error
  std::optional<PlanarPose> other;  ///< the second minimum, if there is one
  bool ambiguous{};                 ///< the other one differs and explains the picture nearly as well
};

/// Parameters of the computation of poses from pixels.
struct PlanarPoseParameters {
  double noise_px{
      0.02};  ///< least standard deviation of a coordinate of a seen point that is believed [pixel]
  double significance{
      16};  ///< the other pose is refuted when its sum of squares is larger by this many variances
  double same_angle{0.03};  ///< poses closer than this are the same [rad]
};

/// Minimises the reprojection error from both solutions of the infinitesimal plane-based method (Collins and Bartoli,
/// 2014). The covariance is sigma^2 (J^T J)^-1 with J the Jacobian of the projection at the minimum and sigma from the
/// residuals, but at least noise_px.
/// @param points  in G [m], z = 0, at least 4, not on a line
/// @param pixels  where they are seen, as many [pixel]
/// @return nothing when no pose in front of the camera explains the points. Allocates; not for the servo step.
std::optional<PlanarPoses> planar_pose(const CameraModel& camera, std::span<const Vector3> points,
                                       std::span<const Vector2> pixels,
                                       const PlanarPoseParameters& parameters = {});

}  // namespace mrroc::vsp
