// The shaders that draw a scene: one pass from the lamp for the shadows, one from the camera.
#pragma once

namespace mrroc::camera {

/// Comes before vertices and pixels. With SHADOWS light is computed for each pixel; without, at the corners of the
/// triangles, where it is exact on flat faces and costs a third.
inline constexpr const char* kSceneLight = R"(
uniform vec3 lamp, ambient, lamp_direction, up;
vec3 light_on(vec3 n, float lit) {
  return ambient * (0.8 + 0.2 * dot(n, up)) + lamp * lit;
})";

/// Everything is computed in the camera's frame C, so that a distance to the world's origin costs no digits.
inline constexpr const char* kSceneVertices = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texture_place;
uniform mat4 to_camera, to_picture, to_lamp;
uniform mat3 turn;
out vec2 place;
#ifdef SHADOWS
out vec3 in_camera, normal_in_camera, in_lamp;
#else
out vec3 light;
#endif
void main() {
  vec4 p = to_camera * vec4(position, 1.0);
  place = texture_place;
  gl_Position = to_picture * p;
#ifdef SHADOWS
  in_camera = p.xyz;
  normal_in_camera = turn * normal;
  in_lamp = (to_lamp * vec4(position, 1.0)).xyz * 0.5 + 0.5;
#else
  vec3 n = normalize(turn * normal);
  light = light_on(n, max(dot(n, lamp_direction), 0.0));
#endif
})";

/// Lambert's law for what comes from the lamp, a little more ambient light from above, highlights after Blinn.
inline constexpr const char* kScenePixels = R"(
in vec2 place;
uniform vec3 colour;
uniform float shine, gloss, exposure;
uniform sampler2D picture;
out vec4 seen;
#ifdef SHADOWS
in vec3 in_camera, normal_in_camera, in_lamp;
uniform sampler2DShadow shadows;
#else
in vec3 light;
#endif
void main() {
  vec3 surface = colour;
#ifdef TEXTURE
  surface *= texture(picture, place).rgb;
#endif
#ifdef SHADOWS
  vec3 n = normalize(normal_in_camera);
  float lit = max(dot(n, lamp_direction), 0.0) * texture(shadows, in_lamp);
  vec3 half_way = normalize(lamp_direction - normalize(in_camera));
  float highlight = lit > 0.0 ? shine * pow(max(dot(n, half_way), 0.0), gloss) * lit : 0.0;
  seen = vec4(exposure * (surface * light_on(n, lit) + lamp * highlight), 1.0);
#else
  seen = vec4(exposure * surface * light, 1.0);
#endif
})";

/// The shadows' pass: corners as the lamp sees them.
inline constexpr const char* kShadowVertices = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 to_lamp;
void main() { gl_Position = to_lamp * vec4(position, 1.0); })";

/// Depth alone is kept.
inline constexpr const char* kShadowPixels = R"(#version 330 core
void main() {})";

}  // namespace mrroc::camera
