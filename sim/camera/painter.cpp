#include "sim/camera/painter.hpp"

#include <Eigen/Geometry>

#include "base/fault.hpp"

namespace mrroc::camera {
namespace {

using Eigen::Matrix4d;

constexpr double kNear = 0.02;  // [m]
constexpr double kFar = 10;     // [m]

Matrix4d matrix(const Pose& T) {
  Matrix4d m = Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = T.R;
  m.topRightCorner<3, 1>() = T.p;
  return m;
}

/// From C to OpenGL's cube. Row 0 of what is drawn is the upper one of the picture; pixel centres are integers in the
/// camera's model and lie half a pixel from the edge for OpenGL.
Matrix4d projection(const CameraModel& c) {
  Matrix4d m = Matrix4d::Zero();
  m(0, 0) = 2 * c.fx / c.width;
  m(0, 2) = 2 * (c.cx + 0.5) / c.width - 1;
  m(1, 1) = 2 * c.fy / c.height;
  m(1, 2) = 2 * (c.cy + 0.5) / c.height - 1;
  m(2, 2) = (kFar + kNear) / (kFar - kNear);
  m(2, 3) = -2 * kFar * kNear / (kFar - kNear);
  m(3, 2) = 1;
  return m;
}

/// From U to the cube that the lamp sees: all that casts a shadow, the nearest to the lamp at z = -1.
Matrix4d lamp_view(const Scene& scene) {
  const Vector3 z = scene.light.direction.normalized();
  const Vector3 x = z.unitOrthogonal();
  Matrix3 R_LU;
  R_LU << x.transpose(), z.cross(x).transpose(), z.transpose();
  Eigen::AlignedBox3d box;
  for (const Body& body : scene.bodies) {
    if (!body.casts_shadow) continue;
    const Vector3 middle = R_LU * body.T_UB.p;
    const Vector3 reach = (R_LU * body.T_UB.R).cwiseAbs() * body.size / 2;
    box.extend(middle - reach);
    box.extend(middle + reach);
  }
  if (box.isEmpty()) box = Eigen::AlignedBox3d(Vector3(-1, -1, -1), Vector3(1, 1, 1));
  const Vector3 scale = 2 * (box.sizes().array() + 1e-3).inverse();
  Matrix4d m = Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = Vector3(scale.x(), scale.y(), -scale.z()).asDiagonal() * R_LU;
  m.topRightCorner<3, 1>() = -Vector3(scale.x(), scale.y(), -scale.z()).cwiseProduct(box.center());
  return m;
}

Matrix4d stretched(const Matrix4d& m, const Body& body) {
  return m * matrix(body.T_UB) * body.size.homogeneous().asDiagonal();
}

Vector3 vector(const Colour& c) { return {c[0], c[1], c[2]}; }

}  // namespace

void Painter::paint(const Scene& scene, const Pose& T_UC, std::span<std::uint32_t> pixels) {
  const GlContext::Use use(context_);
  const Matrix4d to_lamp = lamp_view(scene);
  if (shadow_map_ != 0) draw_shadows(scene, to_lamp);

  gl_.BindFramebuffer(GL_FRAMEBUFFER, canvas_);
  gl_.Viewport(0, 0, camera_.width, camera_.height);
  const auto shade = [&](int k) {
    return static_cast<float>(scene.background[static_cast<std::size_t>(k)] * scene.light.exposure);
  };
  gl_.ClearColor(shade(0), shade(1), shade(2), 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_.Enable(GL_CULL_FACE);
  gl_.FrontFace(GL_CW);  // the picture's y points down: everything is mirrored
  draw_bodies(textured_, scene, T_UC, to_lamp, true);
  draw_bodies(plain_, scene, T_UC, to_lamp, false);
  forget_unused_textures();

  if (resolved_ != canvas_) {
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, canvas_);
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
    gl_.BlitFramebuffer(0, 0, camera_.width, camera_.height, 0, 0, camera_.width, camera_.height,
                        GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  gl_.ReadPixels(0, 0, camera_.width, camera_.height, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels.data());
  if (gl_.GetError() != GL_NO_ERROR)
    throw FaultError(FaultCode::no_renderer, "OpenGL could not draw the scene");
}

void Painter::draw_shadows(const Scene& scene, const Matrix4d& to_lamp) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, lamp_view_);
  gl_.Viewport(0, 0, quality_.shadow_size, quality_.shadow_size);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  gl_.Disable(GL_CULL_FACE);
  gl_.UseProgram(shadow_);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(2, 8);  // a lit surface must not lie in its own shadow
  for (const Body& body : scene.bodies) {
    if (!body.casts_shadow) continue;
    set(shadow_, "to_lamp", stretched(to_lamp, body));
    draw(body);
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

void Painter::draw_bodies(GLuint program, const Scene& scene, const Pose& T_UC, const Matrix4d& to_lamp,
                          bool textured) {
  const Pose T_CU = T_UC.inverse();
  const Light& light = scene.light;
  gl_.UseProgram(program);
  set(program, "to_picture", projection(camera_));
  set(program, "lamp", vector(light.lamp));
  set(program, "ambient", vector(light.ambient));
  set(program, "lamp_direction", Vector3(T_CU.R * light.direction.normalized()));
  set(program, "up", Vector3(T_CU.R * Vector3::UnitZ()));
  set(program, "exposure", light.exposure);
  gl_.Uniform1i(gl_.GetUniformLocation(program, "picture"), 0);
  gl_.Uniform1i(gl_.GetUniformLocation(program, "shadows"), 1);
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.BindTexture(GL_TEXTURE_2D, shadow_map_);
  gl_.ActiveTexture(GL_TEXTURE0);
  const Matrix4d to_camera = matrix(T_CU);
  // Floor and tables come first in a scene: drawn last, they cost nothing where something stands before them.
  for (std::size_t k = scene.bodies.size(); k-- > 0;) {
    const Body& body = scene.bodies[k];
    if ((body.texture != nullptr) != textured) continue;
    set(program, "to_camera", stretched(to_camera, body));
    set(program, "to_lamp", stretched(to_lamp, body));
    set(program, "turn", Matrix3(T_CU.R * body.T_UB.R * body.size.cwiseInverse().asDiagonal()));
    set(program, "colour", vector(body.colour));
    set(program, "shine", body.shine);
    set(program, "gloss", body.gloss);
    if (textured) gl_.BindTexture(GL_TEXTURE_2D, texture(body.texture));
    draw(body);
  }
}

void Painter::draw(const Body& body) const {
  const Solid& solid = solids_[static_cast<std::size_t>(body.shape)];
  gl_.BindVertexArray(solid.vertices);
  gl_.DrawElements(GL_TRIANGLES, solid.corners, GL_UNSIGNED_INT, nullptr);
}

void Painter::set(GLuint program, const char* name, const Matrix4d& value) const {
  const Eigen::Matrix4f m = value.cast<float>();
  gl_.UniformMatrix4fv(gl_.GetUniformLocation(program, name), 1, GL_FALSE, m.data());
}

void Painter::set(GLuint program, const char* name, const Matrix3& value) const {
  const Eigen::Matrix3f m = value.cast<float>();
  gl_.UniformMatrix3fv(gl_.GetUniformLocation(program, name), 1, GL_FALSE, m.data());
}

void Painter::set(GLuint program, const char* name, const Vector3& value) const {
  const Eigen::Vector3f v = value.cast<float>();
  gl_.Uniform3f(gl_.GetUniformLocation(program, name), v.x(), v.y(), v.z());
}

void Painter::set(GLuint program, const char* name, double value) const {
  gl_.Uniform1f(gl_.GetUniformLocation(program, name), static_cast<float>(value));
}

}  // namespace mrroc::camera
