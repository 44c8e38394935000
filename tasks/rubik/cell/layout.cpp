#include "tasks/rubik/cell/layout.hpp"

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace mrroc::rubik {
namespace {

// The result of the search.
const Vector3 kPlace{0.373, 1.292, 1.281};  // of the cube in the world [m]
constexpr double kAzimuth = 1.105;          // of its axis out of U [rad]
constexpr double kElevation = 0.791;
constexpr double kTurned = 0.230;  // about that axis
const std::array<std::vector<double>, 2> kNear{{{-0.9494, -1.6953, 0.1376, -0.4440, 4.0401, 0.7052},
                                                {0.3916, 1.1953, -1.5479, 0.2417, 0.5134, 1.6346, 3.3068}}};
// The same of the search for a place before the camera.
constexpr double kViewAzimuth = 0.349;  // of the way to the camera [rad]
constexpr double kViewElevation = 0.349;
constexpr double kViewDistance = 0.45;  // [m]
/// Of a face that is looked at again [rad]: by 20 degrees, so that what it mirrors is 40 degrees away. Of eight
/// directions it is the one in which all faces are shown soonest.
const Vector3 kTilt(-0.247, -0.247, 0);

/// @return z in the given direction, x level
Matrix3 level(double azimuth, double elevation) {
  Matrix3 R;
  R.col(2) = Vector3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                     std::sin(elevation));
  R.col(0) = Vector3::UnitZ().cross(R.col(2)).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

}  // namespace

Pose meeting_place() {
  return {level(kAzimuth, kElevation) * rotation_from_angle_axis({0, 0, kTurned}), kPlace};
}

AxisVector meeting_joints(int arm) {
  const auto& near = kNear[static_cast<std::size_t>(arm)];
  return Eigen::Map<const Eigen::VectorXd>(near.data(), static_cast<Eigen::Index>(near.size()));
}

Viewing viewing_place(int reading) {
  const auto face = [](const Matrix3& R) { return Pose{R, kPlace + kEdge / 2 * R.col(2)}; };
  const Matrix3 R = level(kViewAzimuth, kViewElevation);
  return {face(reading == 0 ? R : Matrix3(R * rotation_from_angle_axis(kTilt))), kViewDistance, face(R)};
}

Pose grip(int arm) {
  if (arm == static_cast<int>(index(Hand::track))) return {Matrix3::Identity(), {0, 0, -depth(Hand::track)}};
  return {Eigen::DiagonalMatrix<double, 3>(-1, 1, -1), {0, 0, depth(Hand::postument)}};
}

}  // namespace mrroc::rubik
