// The scene that a simulated camera sees: bodies of simple shapes with their poses, and the light. A value:
// it can be made in the simulator's thread and be used in another.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/image.hpp"
#include "base/pose.hpp"
#include "base/shape.hpp"

namespace mrroc::camera {

/// Share of the light that is reflected, or its strength: red, green, blue; 1 is white.
using Colour = std::array<double, 3>;

/// One rigid body.
struct Body {
  Shape shape{Shape::box};        ///< form
  Vector3 size{Vector3::Ones()};  ///< lengths along its own x, y, z [m], > 0; a quad has no third one
  Pose T_UB;                      ///< its middle in the world
  Colour colour{0.6, 0.6, 0.6};   ///< of the whole surface
  double shine{0.2};              ///< strength of highlights, 0: dull
  double gloss{40};               ///< their sharpness: Blinn's exponent
  bool casts_shadow{true};        ///< what lies flat on another body needs to cast none
  /// Picture on a quad, 3 channels: its first row lies at +y, its first column at -x. Multiplied by the colour.
  /// None: of one colour. What it shows must not change any more; another picture is another object.
  std::shared_ptr<const Image> texture{};
};

/// The light: a lamp far away, and what comes from everywhere.
struct Light {
  Vector3 direction{0.35, 0.25, 0.9};  ///< towards the lamp, in the world; any length but zero
  Colour lamp{0.62, 0.62, 0.62};       ///< of the lamp on what faces it
  Colour ambient{0.40, 0.40, 0.40};    ///< of what comes from everywhere
  double exposure{1};  ///< of the camera: everything is multiplied by it and cut off at white, > 0
};

/// Everything that can be seen at one instant.
struct Scene {
  std::vector<Body> bodies;             ///< in any order
  Light light;                          ///< on all of them
  Colour background{0.62, 0.66, 0.70};  ///< where there is no body
};

}  // namespace mrroc::camera
