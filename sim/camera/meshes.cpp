#include "sim/camera/meshes.hpp"

#include <cmath>
#include <numbers>

namespace mrroc::camera {
namespace {

constexpr int kRound = 40;  // edges around a cylinder or sphere

Vertex vertex(const Vector3& position, const Vector3& normal, double u = 0, double v = 0) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(position.x()), f(position.y()), f(position.z())},
          {f(normal.x()), f(normal.y()), f(normal.z())},
          {f(u), f(v)}};
}

/// Two triangles over four corners against the clock.
void add_face(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
}

std::uint32_t size_of(const Mesh& mesh) { return static_cast<std::uint32_t>(mesh.vertices.size()); }

/// The square at 0.5 along n, between -0.5 and 0.5 along x and y = n x x.
void add_square(Mesh& mesh, const Vector3& n, const Vector3& x) {
  const Vector3 y = n.cross(x);
  const std::uint32_t first = size_of(mesh);
  for (const auto& [u, v] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
    mesh.vertices.push_back(vertex(n / 2 + u * x + v * y, n, u + 0.5, 0.5 - v));
  add_face(mesh, first, first + 1, first + 2, first + 3);
}

Mesh box() {
  Mesh mesh;
  for (const double side : {-1.0, 1.0})
    for (int axis = 0; axis < 3; ++axis)
      add_square(mesh, side * Vector3::Unit(axis), Vector3::Unit((axis + 1) % 3));
  return mesh;
}

Mesh quad() {
  Mesh mesh;
  add_square(mesh, Vector3::UnitZ(), Vector3::UnitX());
  for (Vertex& v : mesh.vertices) v.position[2] = 0;
  return mesh;
}

Vector3 around(int k) {
  const double angle = 2 * std::numbers::pi * k / kRound;
  return {std::cos(angle), std::sin(angle), 0};
}

Mesh cylinder() {
  Mesh mesh;
  for (int k = 0; k <= kRound; ++k)
    for (const double z : {-0.5, 0.5})
      mesh.vertices.push_back(vertex(around(k) / 2 + z * Vector3::UnitZ(), around(k)));
  for (std::uint32_t k = 0; k < kRound; ++k) add_face(mesh, 2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1);
  for (const double side : {-1.0, 1.0}) {
    const Vector3 n = side * Vector3::UnitZ();
    const std::uint32_t middle = size_of(mesh);
    mesh.vertices.push_back(vertex(n / 2, n));
    for (int k = 0; k <= kRound; ++k) {
      const Vector3 edge = around(side > 0 ? k : kRound - k);
      mesh.vertices.push_back(vertex((edge + n) / 2, n));
    }
    for (std::uint32_t k = 1; k <= kRound; ++k)
      mesh.triangles.insert(mesh.triangles.end(), {middle, middle + k, middle + k + 1});
  }
  return mesh;
}

Mesh sphere() {
  Mesh mesh;
  constexpr int kRings = kRound / 2;
  for (int ring = 0; ring <= kRings; ++ring) {
    const double latitude = std::numbers::pi * (static_cast<double>(ring) / kRings - 0.5);
    for (int k = 0; k <= kRound; ++k) {
      const Vector3 n = std::cos(latitude) * around(k) + std::sin(latitude) * Vector3::UnitZ();
      mesh.vertices.push_back(vertex(n / 2, n));
    }
  }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t k = 0; k < kRound; ++k) {
      const std::uint32_t here = ring * (kRound + 1) + k;
      const std::uint32_t above = here + kRound + 1;
      add_face(mesh, here, here + 1, above + 1, above);
    }
  return mesh;
}

}  // namespace

Mesh mesh_of(Shape shape) {
  switch (shape) {
    case Shape::box:
      return box();
    case Shape::cylinder:
      return cylinder();
    case Shape::sphere:
      return sphere();
    case Shape::quad:
      return quad();
  }
  return {};
}

}  // namespace mrroc::camera
