// Makes a painter's constant objects: programs, shapes, canvas, the map of shadows; and the pictures on
// bodies.
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "base/fault.hpp"
#include "sim/camera/meshes.hpp"
#include "sim/camera/painter.hpp"
#include "sim/camera/shaders.hpp"

namespace mrroc::camera {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw FaultError(FaultCode::no_renderer, why); }

}  // namespace

Painter::Painter(const CameraModel& camera, const PaintQuality& quality)
    : camera_(camera), quality_(quality), gl_(context_.gl()) {
  const GlContext::Use use(context_);
  const auto scene_program = [&](const std::string& textured) {
    const std::string head = std::string("#version 330 core\n") +
                             (quality.shadow_size > 0 ? "#define SHADOWS\n" : "") + textured + kSceneLight;
    return program(head + kSceneVertices, head + kScenePixels);
  };
  plain_ = scene_program("");
  textured_ = scene_program("#define TEXTURE\n");
  load_shapes();
  make_canvas();
  if (quality.shadow_size > 0) {
    shadow_ = program(kShadowVertices, kShadowPixels);
    make_shadow_map();
  }
  gl_.Enable(GL_DEPTH_TEST);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

GLuint Painter::shader(GLenum kind, const std::string& text) const {
  const GLuint name = gl_.CreateShader(kind);
  const char* const source = text.c_str();
  gl_.ShaderSource(name, 1, &source, nullptr);
  gl_.CompileShader(name);
  GLint good{};
  gl_.GetShaderiv(name, GL_COMPILE_STATUS, &good);
  if (good != 0) return name;
  std::array<char, 200> log{};
  gl_.GetShaderInfoLog(name, static_cast<GLsizei>(log.size()), nullptr, log.data());
  refuse(std::string("OpenGL refuses a program: ") + log.data());
}

GLuint Painter::program(const std::string& vertices, const std::string& pixels) const {
  const GLuint name = gl_.CreateProgram();
  for (const auto& [kind, text] : {std::pair{GL_VERTEX_SHADER, &vertices}, {GL_FRAGMENT_SHADER, &pixels}}) {
    const GLuint part = shader(static_cast<GLenum>(kind), *text);
    gl_.AttachShader(name, part);
    gl_.DeleteShader(part);  // goes with the program
  }
  gl_.LinkProgram(name);
  GLint good{};
  gl_.GetProgramiv(name, GL_LINK_STATUS, &good);
  if (good == 0) refuse("OpenGL cannot link a program");
  return name;
}

void Painter::load_shapes() {
  for (const Shape shape : {Shape::box, Shape::cylinder, Shape::sphere, Shape::quad}) {
    const Mesh mesh = mesh_of(shape);
    Solid& solid = solids_[static_cast<std::size_t>(shape)];
    solid.corners = static_cast<GLsizei>(mesh.triangles.size());
    gl_.GenVertexArrays(1, &solid.vertices);
    gl_.BindVertexArray(solid.vertices);
    std::array<GLuint, 2> buffers{};
    gl_.GenBuffers(2, buffers.data());
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(Vertex)),
                   mesh.vertices.data(), GL_STATIC_DRAW);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                   static_cast<GLsizeiptr>(mesh.triangles.size() * sizeof(std::uint32_t)),
                   mesh.triangles.data(), GL_STATIC_DRAW);
    const auto attribute = [&](GLuint place, GLint size, std::size_t offset) {
      gl_.EnableVertexAttribArray(place);
      // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes a place in the buffer as a pointer
      const auto* const place_in_buffer = reinterpret_cast<const void*>(offset);
      gl_.VertexAttribPointer(place, size, GL_FLOAT, GL_FALSE, sizeof(Vertex), place_in_buffer);
    };
    attribute(0, 3, offsetof(Vertex, position));
    attribute(1, 3, offsetof(Vertex, normal));
    attribute(2, 2, offsetof(Vertex, texture));
  }
}

void Painter::make_canvas() {
  const auto surface = [&](GLenum place, GLenum format, int samples) {
    GLuint name{};
    gl_.GenRenderbuffers(1, &name);
    gl_.BindRenderbuffer(GL_RENDERBUFFER, name);
    gl_.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, camera_.width, camera_.height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, name);
  };
  const int samples = quality_.samples > 1 ? quality_.samples : 0;
  gl_.GenFramebuffers(1, &canvas_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, canvas_);
  surface(GL_COLOR_ATTACHMENT0, GL_RGBA8, samples);
  surface(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, samples);
  check_framebuffer();
  resolved_ = canvas_;
  if (samples == 0) return;
  gl_.GenFramebuffers(1, &resolved_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, resolved_);
  surface(GL_COLOR_ATTACHMENT0, GL_RGBA8, 0);
  check_framebuffer();
}

void Painter::check_framebuffer() const {
  if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    refuse("OpenGL cannot draw pictures of this size and quality");
}

void Painter::make_shadow_map() {
  gl_.GenTextures(1, &shadow_map_);
  gl_.BindTexture(GL_TEXTURE_2D, shadow_map_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, quality_.shadow_size, quality_.shadow_size, 0,
                 GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl_.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl_.TexParameteri(GL_TEXTURE_2D, side, GL_CLAMP_TO_BORDER);
  constexpr std::array<GLfloat, 4> kLit{1, 1, 1, 1};  // what nothing shades
  gl_.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, kLit.data());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl_.GenFramebuffers(1, &lamp_view_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, lamp_view_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_map_, 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  check_framebuffer();
}

GLuint Painter::texture(const std::shared_ptr<const Image>& image) {
  Texture& t = textures_[image.get()];
  t.used = true;
  if (t.name != 0) return t.name;
  t.image = image;  // kept, so that no other picture comes to the same place
  gl_.GenTextures(1, &t.name);
  gl_.BindTexture(GL_TEXTURE_2D, t.name);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image->width, image->height, 0, GL_BGR, GL_UNSIGNED_BYTE,
                 image->data.data());
  gl_.GenerateMipmap(GL_TEXTURE_2D);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl_.TexParameteri(GL_TEXTURE_2D, side, GL_CLAMP_TO_EDGE);
  constexpr GLenum kAnisotropy = 0x84FE;  // of EXT_texture_filter_anisotropic, which every driver has
  if (quality_.textures_sharp) gl_.TexParameterf(GL_TEXTURE_2D, kAnisotropy, 8);
  return t.name;
}

void Painter::forget_unused_textures() {
  for (auto& [image, t] : textures_)
    if (!t.used) gl_.DeleteTextures(1, &t.name);
  std::erase_if(textures_, [](const auto& entry) { return !entry.second.used; });
  for (auto& [image, t] : textures_) t.used = false;
}

}  // namespace mrroc::camera
