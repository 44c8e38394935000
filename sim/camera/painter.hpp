// Draws scenes as a pinhole camera sees them, with OpenGL.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "base/camera.hpp"
#include "sim/camera/gl.hpp"
#include "sim/camera/scene.hpp"

namespace mrroc::camera {

/// A painter's effort for a picture; as in RenderProfile.
struct PaintQuality {
  /// As in RenderProfile.
  int samples{};
  int shadow_size{};
  bool textures_sharp{};
};

/// Used by one thread at a time.
class Painter {
 public:
  /// @param camera  without distortion @throws FaultError no_renderer
  Painter(const CameraModel& camera, const PaintQuality& quality);
  /// What OpenGL holds goes with its context.
  ~Painter() = default;
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// @param pixels  width * height words: blue in the lowest byte, then green, then red
  void paint(const Scene& scene, const Pose& T_UC, std::span<std::uint32_t> pixels);

 private:
  struct Solid {
    GLuint vertices{};
    GLsizei corners{};
  };
  struct Texture {
    std::shared_ptr<const Image> image;
    GLuint name{};
    bool used{};
  };

  void load_shapes();
  void make_canvas();
  void make_shadow_map();
  [[nodiscard]] GLuint program(const std::string& vertices, const std::string& pixels) const;
  [[nodiscard]] GLuint shader(GLenum kind, const std::string& text) const;
  void check_framebuffer() const;
  [[nodiscard]] GLuint texture(const std::shared_ptr<const Image>& image);
  void forget_unused_textures();

  void draw_shadows(const Scene& scene, const Eigen::Matrix4d& to_lamp);
  void draw_bodies(GLuint program, const Scene& scene, const Pose& T_UC, const Eigen::Matrix4d& to_lamp,
                   bool textured);
  void draw(const Body& body) const;
  void set(GLuint program, const char* name, const Eigen::Matrix4d& value) const;
  void set(GLuint program, const char* name, const Matrix3& value) const;
  void set(GLuint program, const char* name, const Vector3& value) const;
  void set(GLuint program, const char* name, double value) const;

  CameraModel camera_;
  PaintQuality quality_;
  GlContext context_;
  const Gl& gl_;
  std::array<Solid, 4> solids_{};  // by Shape
  std::map<const Image*, Texture> textures_;
  GLuint plain_{}, textured_{}, shadow_{};  // programs
  GLuint canvas_{};                         // what is drawn on
  GLuint resolved_{};                       // one sample per pixel; the canvas itself when that has no more
  GLuint lamp_view_{}, shadow_map_{};
};

}  // namespace mrroc::camera
