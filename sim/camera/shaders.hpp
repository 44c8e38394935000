// The programs that draw a scene: one pass from the lamp for the shadows, one from the camera.
#pragma once

namespace mrroc::camera {

// Everything is computed in the camera's frame C, so that a distance to the world's origin costs no digits.
inline constexpr const char* kSceneVertices = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texture_place;
uniform mat4 to_camera, to_picture, to_lamp;
uniform mat3 turn;
out vec3 in_camera, normal_in_camera, in_lamp;
out vec2 place;
void main() {
  vec4 p = to_camera * vec4(position, 1.0);
  in_camera = p.xyz;
  normal_in_camera = turn * normal;
  in_lamp = (to_lamp * vec4(position, 1.0)).xyz * 0.5 + 0.5;
  place = texture_place;
  gl_Position = to_picture * p;
})";

// Lambert's law for what comes from the lamp, a little more ambient light from above, highlights after Blinn.
inline constexpr const char* kScenePixels = R"(
in vec3 in_camera, normal_in_camera, in_lamp;
in vec2 place;
uniform vec3 colour, lamp, ambient, lamp_direction, up;
uniform float shine, exposure;
uniform sampler2D picture;
uniform sampler2DShadow shadows;
out vec4 seen;
void main() {
  vec3 surface = colour;
#ifdef TEXTURE
  surface *= texture(picture, place).rgb;
#endif
  vec3 n = normalize(normal_in_camera);
  float lit = max(dot(n, lamp_direction), 0.0);
#ifdef SHADOWS
  lit *= texture(shadows, in_lamp);
#endif
  vec3 half_way = normalize(lamp_direction - normalize(in_camera));
  float highlight = lit > 0.0 ? shine * pow(max(dot(n, half_way), 0.0), 40.0) * lit : 0.0;
  vec3 light = ambient * (0.8 + 0.2 * dot(n, up)) + lamp * lit;
  seen = vec4(exposure * (surface * light + lamp * highlight), 1.0);
})";

inline constexpr const char* kShadowVertices = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 to_lamp;
void main() { gl_Position = to_lamp * vec4(position, 1.0); })";

inline constexpr const char* kShadowPixels = R"(#version 330 core
void main() {})";

}  // namespace mrroc::camera
