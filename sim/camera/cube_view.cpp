#include "sim/camera/cube_view.hpp"

#include <string>
#include <string_view>

#include "base/cube/face_view.hpp"
#include "base/cube/facelets.hpp"
#include "sim/camera/bodies.hpp"

namespace mrroc::sim {
namespace {

using camera::Body;
using camera::Colour;

constexpr double kSlit = 4e-4;       // between pieces [m]
constexpr double kThickness = 1e-4;  // of a sticker [m]

constexpr Colour kRubber{0.14, 0.14, 0.15};

/// Angle by which the layer of a place has been turned from its seat.
/// @param place  in C [m]
Pose turned(const CubeTruth& truth, const Vector3& place, double layer) {
  const double along = place[truth.axis];
  if (std::abs(along) < layer / 2) return truth.T_UC;
  const double angle = along > 0 ? truth.angle[0] : -truth.angle[1];
  return truth.T_UC * Pose{rotation_from_angle_axis(angle * Vector3::Unit(truth.axis)), Vector3::Zero()};
}

void add_pieces(std::vector<camera::Body>& bodies, const CubeTruth& truth, double layer,
                const StickerLook& look) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vector3 place = layer * Vector3(x, y, z);
        bodies.push_back(body(Shape::box, Vector3::Constant(layer - kSlit),
                              at(turned(truth, place, layer), place), look.plastic, 0.1));
      }
}

}  // namespace

void add_cube(std::vector<camera::Body>& bodies, const CubeTruth& truth, const CubeFaceShape& shape,
              const StickerLook& look) {
  const double layer = shape.edge / 3;
  add_pieces(bodies, truth, layer, look);
  const std::string facelets = cube::to_facelets(truth.state);
  for (int f = 0; f < cube::kFaces; ++f) {
    const Matrix3 R = cube::facelet_frame(static_cast<cube::Face>(f));
    for (int k = 0; k < kStickers; ++k) {
      const Vector3 place = R * (shape.middle(k) + Vector3(0, 0, layer));  // of the piece
      const Vector3 out = R.col(2) * ((layer - kSlit) / 2 + kThickness);
      const std::size_t letter =
          std::string_view("URFDLB").find(facelets[static_cast<std::size_t>(kStickers * f + k)]);
      Body sticker =
          body(Shape::quad, {shape.sticker, shape.sticker, 1},
               turned(truth, place, layer) * Pose{R, place + out}, look.colours[letter], look.shine);
      sticker.gloss = look.gloss;
      sticker.casts_shadow = false;
      bodies.push_back(sticker);
    }
  }
}

void add_gripper(std::vector<camera::Body>& bodies, const GripperBodyParameters& g, const Pose& T_UE,
                 double jaws) {
  constexpr double kPalm = 0.02;     // thickness [m]
  constexpr double kHousing = 0.03;  // likewise
  constexpr double kFinger = 0.008;  // likewise, of what carries a pad
  const double back = -g.palm - kPalm;
  bodies.push_back(
      body(Shape::box, {g.palm_width, g.palm_width, kPalm}, at(T_UE, {0, 0, back + kPalm / 2}), kRubber, 0));
  bodies.push_back(
      body(Shape::box, {g.pad_width, 0.13, kHousing}, at(T_UE, {0, 0, back - kHousing / 2}), kDark, 0.3));
  for (const double side : {-1.0, 1.0}) {
    const double pad = side * (jaws + g.pad_thickness) / 2;
    bodies.push_back(
        body(Shape::box, {g.pad_width, g.pad_thickness, g.pad_depth}, at(T_UE, {0, pad, 0}), kRubber, 0.05));
    const double finger = pad + side * (g.pad_thickness + kFinger) / 2;
    const double front = g.pad_depth / 2;
    bodies.push_back(body(Shape::box, {g.pad_width, kFinger, front - back},
                          at(T_UE, {0, finger, (front + back) / 2}), kSteel, 0.3));
  }
}

}  // namespace mrroc::sim
