// A camera for tests of receptors: pictures of one plane by casting rays through the lens, several for a pixel. Exact
// by construction and without any other code of the framework, so that it can contradict the renderer of the
// simulation.
#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include "base/camera.hpp"
#include "base/image.hpp"

namespace cv {
class Mat;
}

namespace mrroc::test {

/// Effects behind the lens on the pictures of a plane.
struct Exposure {
  double blur{0.5};  ///< standard deviation [pixel]
  double noise{2};   ///< standard deviation [grey levels]
  double gain{1};    ///< of the brightness
  double offset{0};  ///< added to it [grey levels]
  unsigned seed{1};
};

/// Adds noise and lets the picture become one of bytes. @param sum  32-bit floating point, one channel
Image exposed(cv::Mat sum, const Exposure& exposure);

/// Casts rays for one camera.
class PlaneCamera {
 public:
  /// Brightness at x, y of the plane [m], 0..255.
  using Texture = std::function<float(double x, double y)>;

  /// @param samples  rays along either edge of a pixel
  explicit PlaneCamera(const CameraModel& camera, int samples = 3);

  [[nodiscard]] const CameraModel& model() const { return camera_; }
  /// @param T_CG  the plane z = 0 of G in the camera
  /// @return a grey picture; where a ray does not meet the plane in front of the camera it is black
  [[nodiscard]] Image render(const Pose& T_CG, const Texture& texture, const Exposure& exposure = {}) const;

 private:
  CameraModel camera_;
  int samples_;
  std::vector<Eigen::Vector2f> rays_;  // at z = 1, sample by sample, row by row
};

/// @return brightness of a chessboard plate of those inner corners on a table
/// @param columns, rows  inner corners
PlaneCamera::Texture chessboard_texture(int columns, int rows, double square, double margin,
                                        float table = 120);

/// @return brightness of tag `id` of the family 36h11 with a light margin on a table
/// @param edge    of the black border [m]
/// @param margin  [m]
PlaneCamera::Texture tag_texture(int id, double edge, double margin, float table = 120);

/// The camera of most tests: 640 x 480, lens of a web camera.
inline CameraModel web_camera() {
  CameraModel camera;
  camera.distortion = {-0.28, 0.09, 0.0006, -0.0004, 0};
  return camera;
}

/// @return a camera with the lens of web_camera() that casts four rays a pixel
inline const PlaneCamera& web_plane_camera() {
  static const PlaneCamera camera(web_camera(), 2);
  return camera;
}

/// @param distance  of the plane's origin along the optical axis [m]
/// @param tilt      of the plane against facing the camera [rad]
/// @param azimuth   about what axis in the picture it is tilted [rad]
/// @param roll      about its own normal [rad]
/// @param x, y      of its origin in C [m]
/// @return T_CG of a plane that shows its face (z of G) to the camera
Pose facing(double distance, double tilt, double azimuth, double roll, double x = 0, double y = 0);

}  // namespace mrroc::test
