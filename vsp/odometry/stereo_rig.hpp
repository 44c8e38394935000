// A pair of cameras on a platform, and the rectified frame in which both see a point in the same row.
#pragma once
#include <vector>

#include "base/camera.hpp"

namespace mrroc::vsp {

/// One camera of a pair.
struct RigCamera {
  CameraModel model;
  Pose T_BC;  ///< where it is on the platform B
};

/// Two cameras side by side that look the same way. The rectified frame S has its origin in the left camera, x along the
/// baseline and z along the mean of the optical axes. A rectified place is f (x/z, y/z) of a ray in S or, for the right
/// camera, in S moved to it [pixel]: the row is the same for both, and their columns differ by f baseline / z.
class StereoRig {
 public:
  /// @throws FaultError bad_configuration: a model is not proper, the pictures are of different sizes, the baseline is
  ///         below 1 cm, the right camera is not to the right, or they look in directions that differ by more than 0.3 rad
  StereoRig(const RigCamera& left, const RigCamera& right);

  [[nodiscard]] const CameraModel& left() const { return left_.model; }
  /// @return distance of the cameras [m]
  [[nodiscard]] double baseline() const { return baseline_; }
  /// @return focal length of the rectified places [pixel]
  [[nodiscard]] double f() const { return left_.model.fx; }
  /// @return S on the platform
  [[nodiscard]] const Pose& T_BS() const { return T_BS_; }

  /// @param pixels  in the left camera's picture @return their rectified places
  [[nodiscard]] std::vector<Vector2> rectified_left(const std::vector<Vector2>& pixels) const;
  /// The same for the right camera.
  [[nodiscard]] std::vector<Vector2> rectified_right(const std::vector<Vector2>& pixels) const;
  /// @param left, right  rectified places of one point, left.x() > right.x(); the row is the mean of both
  /// @return the point in S [m]
  [[nodiscard]] Vector3 point(const Vector2& left, const Vector2& right) const;

 private:
  [[nodiscard]] std::vector<Vector2> rectified(const RigCamera& camera,
                                               const std::vector<Vector2>& pixels) const;

  RigCamera left_, right_;
  double baseline_;
  Pose T_BS_;
};

}  // namespace mrroc::vsp
