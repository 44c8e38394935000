#include "base/cube/symmetry.hpp"

#include <algorithm>

namespace mrroc::cube {
namespace {

using FaceMap = std::array<Face, kFaces>;

/// @return the slot with the faces that a slot's faces are mapped to
template <std::size_t N, std::size_t M>
int image_of(const std::array<std::array<Face, M>, N>& slots, std::size_t slot, const FaceMap& map) {
  std::array<Face, M> wanted;
  std::ranges::transform(slots[slot], wanted.begin(), [&map](Face f) { return map[number(f)]; });
  std::ranges::sort(wanted);
  const auto image = std::ranges::find_if(slots, [&wanted](std::array<Face, M> faces) {
    std::ranges::sort(faces);
    return faces == wanted;
  });
  return static_cast<int>(image - slots.begin());
}

template <std::size_t N, std::size_t M>
void map_slots(const std::array<std::array<Face, M>, N>& slots, const FaceMap& map,
               std::array<std::uint8_t, N>& image, std::array<std::uint8_t, N>& offset) {
  for (std::size_t k = 0; k < N; ++k) {
    image[k] = static_cast<std::uint8_t>(image_of(slots, k, map));
    const std::array<Face, M>& faces = slots[image[k]];
    offset[k] = static_cast<std::uint8_t>(std::ranges::find(faces, map[number(slots[k][0])]) - faces.begin());
  }
}

/// @param axis  where the axes through U, R and F go
/// @param negative  bit a: axis a is reversed
Symmetry make_symmetry(const std::array<int, 3>& axis, int negative) {
  Symmetry s;
  for (int a = 0; a < 3; ++a) {
    const Face to = static_cast<Face>(axis[a] + ((negative >> a) & 1 ? 3 : 0));
    s.faces[a] = to;
    s.faces[a + 3] = opposite(to);
  }
  const bool odd_axes = (axis[0] > axis[1]) != ((axis[0] > axis[2]) != (axis[1] > axis[2]));
  const bool odd_signs = ((negative ^ (negative >> 1) ^ (negative >> 2)) & 1) != 0;
  s.mirrored = odd_axes != odd_signs;
  map_slots(kCornerFaces, s.faces, s.corner, s.corner_offset);
  map_slots(kEdgeFaces, s.faces, s.edge, s.edge_offset);
  return s;
}

struct Group {
  std::array<Symmetry, kSymmetries> members;
  std::array<std::array<std::uint8_t, kSymmetries>, kSymmetries> product;
  std::array<std::uint8_t, kSymmetries> inverse;

  Group() {
    static constexpr std::array<std::array<int, 3>, 6> kAxisOrders{
        {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}}};
    for (int k = 0; k < kSymmetries; ++k) members[k] = make_symmetry(kAxisOrders[k / 8], k % 8);
    for (int a = 0; a < kSymmetries; ++a)
      for (int b = 0; b < kSymmetries; ++b) {
        FaceMap map;
        for (int f = 0; f < kFaces; ++f) map[f] = members[a].faces[number(members[b].faces[f])];
        product[a][b] = static_cast<std::uint8_t>(find(map));
        if (product[a][b] == 0) inverse[a] = static_cast<std::uint8_t>(b);
      }
  }
  [[nodiscard]] int find(const FaceMap& map) const {
    return static_cast<int>(std::ranges::find(members, map, &Symmetry::faces) - members.begin());
  }
};

const Group& group() {
  static const Group g;
  return g;
}

}  // namespace

const Symmetry& symmetry(int s) { return group().members[s]; }

int compose(int a, int b) { return group().product[a][b]; }

int inverse_symmetry(int s) { return group().inverse[s]; }

int axis_rotation(int times) {
  static const int once = group().find({Face::R, Face::F, Face::U, Face::L, Face::B, Face::D});
  int s = 0;
  for (int k = 0; k < times; ++k) s = compose(once, s);
  return s;
}

Symmetry rotation_about(Face face) {
  // Clockwise seen from outside, the corner's faces follow each other: about its first face the second goes
  // to the third.
  for (const auto& [a, b, c] : kCornerFaces) {
    std::array<Face, 3> faces{a, b, c};
    const auto first = std::ranges::find(faces, face);
    if (first == faces.end()) continue;
    std::rotate(faces.begin(), first, faces.end());
    FaceMap map;
    map[number(face)] = face;
    map[number(opposite(face))] = opposite(face);
    map[number(faces[1])] = faces[2];
    map[number(faces[2])] = opposite(faces[1]);
    map[number(opposite(faces[1]))] = opposite(faces[2]);
    map[number(opposite(faces[2]))] = faces[1];
    return symmetry(group().find(map));
  }
  return symmetry(0);
}

Cube conjugate(const Cube& cube, const Symmetry& s) {
  Cube c;
  for (int k = 0; k < kCorners; ++k) {
    const int piece = cube.corners[k] / 3;
    const int twist = cube.corners[k] % 3;
    const int turned = (s.mirrored ? 3 - twist : twist) + s.corner_offset[k] + 3 - s.corner_offset[piece];
    c.corners[s.corner[k]] = static_cast<std::uint8_t>(3 * s.corner[piece] + turned % 3);
  }
  for (int k = 0; k < kEdges; ++k) {
    const int piece = cube.edges[k] / 2;
    const int flip = (cube.edges[k] & 1) ^ s.edge_offset[k] ^ s.edge_offset[piece];
    c.edges[s.edge[k]] = static_cast<std::uint8_t>(2 * s.edge[piece] + flip);
  }
  return c;
}

}  // namespace mrroc::cube
