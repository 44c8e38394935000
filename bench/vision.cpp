#include "bench/vision.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

#include "base/target/board.hpp"
#include "base/target/tag.hpp"
#include "bench/vision_render.hpp"
#include "sim/camera/cell_scene.hpp"
#include "sim/camera/textures.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::bench {

CameraModel web_camera() {
  CameraModel camera;
  camera.distortion = {-0.28, 0.09, 0.0006, -0.0004, 0};
  return camera;
}

double thread_ms() {
  std::timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

ViewedCell::ViewedCell(Object object, unsigned seed) : object_(object), random_(seed) {
  const sim::WorldParameters parameters = rig::irb6_cell();
  const sim::World world(parameters, 1);
  scene_ = sim::CellScene(parameters).take(world);
  arms_end_ = scene_.bodies.size();
  T_UG_ = parameters.arms[0].T_UB * Pose{Matrix3::Identity(), {1.0, 0.25, 0.95}};
  if (object == Object::board)
    camera::add_board(scene_, {}, T_UG_);
  else
    camera::add_tag(scene_, kTag.id, kTag.edge, T_UG_);
}

Pose ViewedCell::pose(const CameraModel& camera, double nearest, double farthest) {
  const auto uniform = [this](double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); };
  const auto about = [](const Vector3& aa) { return rotation_from_angle_axis(aa); };
  for (;;) {
    const double d = uniform(nearest, farthest);
    const double azimuth = uniform(0, 2 * std::numbers::pi);
    const double tilt = uniform(0, std::numbers::pi / 4);
    Pose T;
    T.R = about(tilt * Vector3(std::cos(azimuth), std::sin(azimuth), 0)) * about({std::numbers::pi, 0, 0}) *
          about({0, 0, uniform(0, 2 * std::numbers::pi)});
    T.p = {uniform(-0.5, 0.5) * d, uniform(-0.4, 0.4) * d, d};
    if (visible(camera, T) && (poses_ % 2 == 0 || shows_arm(camera, T))) {
      ++poses_;
      return T;
    }
  }
}

bool ViewedCell::visible(const CameraModel& camera, const Pose& T_CG) const {
  const bool board = object_ == Object::board;
  const double w = 0.5 * (board ? kBoard.width() : kTag.edge + 2 * kTag.margin);
  const double h = 0.5 * (board ? kBoard.height() : kTag.edge + 2 * kTag.margin);
  const Vector3 eye = this->camera(T_CG).p;
  constexpr int kPoints = 4;
  for (int i = -kPoints; i <= kPoints; ++i)
    for (int j = -kPoints; j <= kPoints; ++j) {
      const Vector3 point(w * i / kPoints, h * j / kPoints, 0);
      const Vector3 q = T_CG * point;
      if (q.z() < 0.1) return false;
      const Vector2 p = project(camera, q);
      if (p.x() < 0 || p.y() < 0 || p.x() > camera.width - 1 || p.y() > camera.height - 1) return false;
      if (hidden(eye, T_UG_ * point)) return false;
    }
  return true;
}

bool ViewedCell::shows_arm(const CameraModel& camera, const Pose& T_CG) const {
  const Pose T_CU = this->camera(T_CG).inverse();
  return std::any_of(scene_.bodies.begin(), scene_.bodies.begin() + static_cast<std::ptrdiff_t>(arms_end_),
                     [&](const camera::Body& body) {
                       if (!belongs_to_an_arm(body)) return false;
                       const Vector3 q = T_CU * body.T_UB.p;
                       if (q.z() < 0.1) return false;
                       const Vector2 p = project(camera, q);
                       return p.x() > 0 && p.y() > 0 && p.x() < camera.width && p.y() < camera.height;
                     });
}

// Floor, paper and tables lie below the plate.
bool ViewedCell::belongs_to_an_arm(const camera::Body& body) const {
  const double height = 0.5 * body.T_UB.R.row(2).cwiseAbs().dot(body.size);
  return body.shape != Shape::quad && body.T_UB.p.z() + height >= T_UG_.p.z();
}

// Whether a body that is not below the plate comes near the ray; bodies are taken as large as the balls around them.
bool ViewedCell::hidden(const Vector3& eye, const Vector3& point) const {
  const Vector3 ray = point - eye;
  return std::any_of(scene_.bodies.begin(), scene_.bodies.begin() + static_cast<std::ptrdiff_t>(arms_end_),
                     [&](const camera::Body& body) {
                       if (!belongs_to_an_arm(body)) return false;
                       const double radius = 0.5 * body.size.norm();
                       const double way =
                           std::clamp(ray.dot(body.T_UB.p - eye) / ray.squaredNorm(), 0.0, 0.97);
                       return (eye + way * ray - body.T_UB.p).norm() < radius;
                     });
}

Figures run_vision_group() {
  Figures all;
  for (const auto part : {visual_servo_figures, run_render_figures, run_pose_figures, run_calibration_figures,
                          run_detection_figures, run_cube_face_figures}) {
    const Figures figures = part();
    all.insert(all.end(), figures.begin(), figures.end());
  }
  return all;
}

}  // namespace mrroc::bench
