// Triangles of the simple shapes, each of size 1.
#pragma once
#include <cstdint>
#include <vector>

#include "sim/camera/scene.hpp"

namespace mrroc::camera {

/// A corner of a triangle, as OpenGL takes it.
struct Vertex {
  float position[3];  ///< in the frame of the body, whose size is 1
  float normal[3];    ///< outwards, of length 1
  float texture[2];   ///< place in a picture, 0..1 from its upper left corner
};

/// Seen from outside, the corners of a triangle follow each other against the clock.
struct Mesh {
  std::vector<Vertex> vertices;          ///< shared by triangles where place, normal and texture agree
  std::vector<std::uint32_t> triangles;  ///< three indices each
};

/// @return the shape, from -0.5 to 0.5 along each axis
Mesh mesh_of(Shape shape);

}  // namespace mrroc::camera
