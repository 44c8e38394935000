#include "sim/camera/cell_scene.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "sim/camera/bodies.hpp"
#include "sim/camera/cube_view.hpp"

namespace mrroc::sim {
namespace {

using camera::Body;
using camera::Colour;
using camera::Scene;

constexpr Colour kFloor{0.45, 0.46, 0.48};
constexpr Colour kWood{0.55, 0.47, 0.38};
constexpr Colour kPaper{0.88, 0.88, 0.86};
constexpr Colour kOrange{0.92, 0.42, 0.08};  // that of the IRb-6

constexpr double kFloorEdge = 8;
constexpr double kTableEdge = 0.6;
constexpr double kTableThickness = 0.05;
constexpr double kPenLength = 0.03;  // beyond its holder

void add_table(std::vector<Body>& bodies, const ArmParameters& arm) {
  const Pose T_UP = arm.T_UB * arm.paper.T_0P;
  bodies.push_back(body(Shape::box, {kTableEdge, kTableEdge, kTableThickness},
                        at(T_UP, {0, 0, -kTableThickness / 2}), kWood));
  const double leg = T_UP.p.z() - kTableThickness;
  for (const double x : {-0.45, 0.45})
    for (const double y : {-0.45, 0.45})
      bodies.push_back(body(Shape::box, {0.05, 0.05, leg},
                            at(T_UP, {x * kTableEdge, y * kTableEdge, -kTableThickness - leg / 2}), kDark));
  Body sheet = body(Shape::quad, {arm.paper.size, arm.paper.size, 1}, at(T_UP, {0, 0, 2e-4}), kPaper, 0);
  sheet.casts_shadow = false;
  bodies.push_back(sheet);
  const PlateParameters& plate = arm.plate;
  if (plate.shape == PlateShape::none) return;
  const Shape shape = plate.shape == PlateShape::ellipse ? Shape::cylinder : Shape::box;
  bodies.push_back(body(shape, {plate.length, plate.width, plate.thickness},
                        at(T_UP, {0, plate.distance, plate.thickness / 2}), kSteel, 0.3));
}

bool is_dark(std::string_view link) {
  constexpr std::array<std::string_view, 4> kDarkLinks{"base", "track", "wrist", "tool"};
  return std::ranges::find(kDarkLinks, link) != kDarkLinks.end();
}

void add_arm(std::vector<Body>& bodies, const World& world, int arm, const ArmParameters& parameters) {
  for (const LinkShape& s : world.shapes(arm))
    bodies.push_back(body(s.shape, s.size, s.T_UV, is_dark(s.link) ? kDark : kOrange, 0.35));
  const ArmTruth& truth = world.truth(arm);
  const Pose T_UE = parameters.T_UB * truth.T_0E;
  if (parameters.jaws && parameters.gripper) {
    add_gripper(bodies, *parameters.gripper, T_UE, truth.jaws);
    return;
  }
  if (!parameters.jaws) {
    bodies.push_back(
        body(Shape::cylinder, {0.008, 0.008, kPenLength}, at(T_UE, {0, 0, -kPenLength / 2}), kSteel, 0.3));
    return;
  }
  const Vector3 jaw(0.03, 0.012, 0.06);
  bodies.push_back(body(Shape::box, {0.04, 0.13, 0.02}, at(T_UE, {0, 0, -jaw.z() - 0.01}), kDark, 0.3));
  for (const double side : {-0.5, 0.5})
    bodies.push_back(
        body(Shape::box, jaw, at(T_UE, {0, side * (truth.jaws + jaw.y()), -jaw.z() / 2}), kSteel, 0.3));
}

}  // namespace

CellScene::CellScene(const WorldParameters& world) : arms_(world.arms) {
  if (world.cube) shape_.edge = world.cube->edge;
  Body floor = body(Shape::quad, {kFloorEdge, kFloorEdge, 1}, Pose{}, kFloor, 0);
  floor.casts_shadow = false;
  still_.push_back(floor);
  for (const ArmParameters& arm : arms_) add_table(still_, arm);
  if (!world.artefact) return;
  for (const Vector3& ball : world.artefact->balls)
    still_.push_back(body(Shape::sphere, Vector3::Constant(world.artefact->diameter),
                          {Matrix3::Identity(), ball}, kSteel, 0.5));
}

Scene CellScene::take(const World& world) const {
  Scene scene;
  scene.bodies = still_;
  for (int arm = 0; arm < world.arms(); ++arm)
    add_arm(scene.bodies, world, arm, arms_[static_cast<std::size_t>(arm)]);
  if (const CubeTruth* const cube = world.cube()) add_cube(scene.bodies, *cube, shape_);
  return scene;
}

}  // namespace mrroc::sim
