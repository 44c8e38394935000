#include "base/camera.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc {

Vector2 project(const CameraModel& camera, const Vector3& point) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double x = point.x() / point.z();
  const double y = point.y() / point.z();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x);
  const double v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y;
  return {camera.fx * u + camera.cx, camera.fy * v + camera.cy};
}

bool is_proper(const CameraModel& camera) {
  const auto finite = [](double x) { return std::isfinite(x); };
  return camera.width > 0 && camera.height > 0 && camera.fx > 0 && camera.fy > 0 && finite(camera.fx) &&
         finite(camera.fy) && finite(camera.cx) && finite(camera.cy) &&
         std::ranges::all_of(camera.distortion, finite);
}

}  // namespace mrroc
