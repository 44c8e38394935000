// The model of a camera with its lens, and the reading that a virtual receptor gives of an object.
// Kornuta & Zielinski, VS, sec. 3.
#pragma once
#include <array>
#include <cstdint>

#include "base/pose.hpp"

namespace mrroc {

using Vector2 = Eigen::Vector2d;              ///< two numbers, mostly a place in a picture [pixel]
using Matrix6 = Eigen::Matrix<double, 6, 6>;  ///< of six components in the order of Axis, mostly a covariance

/// Pinhole camera with radial and tangential distortion: the papers' intrinsics M and lens L. Frame C: z forward along
/// the optical axis, x right, y down in the picture. Pixels are counted from the centre of the first one, u right,
/// v down (the convention of OpenCV).
struct CameraModel {
  int width{640};                      ///< [pixel], > 0
  int height{480};                     ///< [pixel], > 0
  double fx{600};                      ///< focal length over width of a pixel [pixel], > 0
  double fy{600};                      ///< focal length over height of a pixel [pixel], > 0
  double cx{319.5};                    ///< where the optical axis meets the picture [pixel]
  double cy{239.5};                    ///< [pixel]
  std::array<double, 5> distortion{};  ///< k1, k2, p1, p2, k3

  friend bool operator==(const CameraModel&, const CameraModel&) = default;
};

/// @param point  in C [m], z > 0
/// @return where the point is seen [pixel], also when that is outside of the picture. Real-time safe.
Vector2 project(const CameraModel& camera, const Vector3& point);

/// @return whether numbers are finite and sizes positive
bool is_proper(const CameraModel& camera);

/// Reading of a virtual receptor r_1,k from one frame. There is one for every frame, also when nothing was
/// seen.
struct CameraReading {
  std::int64_t frame{};  ///< 0, 1, 2... of the camera
  std::int64_t step{};   ///< of the effector drivers at which the picture was taken
  double t{};            ///< when it was taken: simulated time, or from the beginning of a film [s]
  bool seen{};           ///< the object was found, and the pose may be used
  bool ambiguous{};      ///< two poses explain the picture alike; then not seen
  Pose T_CG;             ///< object G in the camera C; identity when not seen
  Matrix6 covariance = Matrix6::Zero();  ///< of the error's components x y z [m], ax ay az [rad], along C
  double reprojection_px{};              ///< root mean square over the points used [pixel]
};

}  // namespace mrroc
