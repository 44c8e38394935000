// Plates as convex bodies of the scene.
#include "sim/bullet/convert.hpp"
#include "sim/bullet/round_prism.hpp"
#include "sim/bullet/scene.hpp"

namespace mrroc::sim {
namespace {

/// Corners of the polygon that stands for an ellipse: its sides are off by 2 micrometres.
constexpr int kCorners = 360;

std::unique_ptr<btCollisionShape> outline(const PlateParameters& p) {
  if (p.shape == PlateShape::rectangle) {
    auto box = std::make_unique<btBoxShape>(btVector3(p.length / 2, p.width / 2, p.thickness / 2));
    box->setMargin(0);  // it would round the corners
    return box;
  }
  return std::make_unique<RoundPrism>(p.length, p.width, p.thickness, kCorners);
}

}  // namespace

void Scene::add_plate(const Pose& T_UP, const PlateParameters& plate) {
  if (plate.shape == PlateShape::none) return;
  add_body(outline(plate), T_UP * Pose{Matrix3::Identity(), {0, plate.distance, plate.thickness / 2}});
}

}  // namespace mrroc::sim
