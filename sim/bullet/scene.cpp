#include "sim/bullet/scene.hpp"

#include "sim/bullet/convert.hpp"
#include "sim/engine.hpp"

namespace mrroc::sim {
namespace {

constexpr double kTableThickness = 0.05;     // [m]
constexpr double kPedestalThickness = 0.03;  // [m]
/// Of what touches, along its surfaces, as a share of that along the normal: a block of rubber.
constexpr double kShearStiffness = 0.2;

}  // namespace

Scene::Scene(int solver_iterations)
    : dispatcher_(&configuration_), dynamics_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
  dynamics_.setGravity({0, 0, -kGravity});
  dynamics_.getSolverInfo().m_numIterations = solver_iterations;
}

Scene::~Scene() {
  for (const auto& body : bodies_) dynamics_.removeCollisionObject(body.get());
}

void Scene::add_table(const Pose& T_UP, double edge) {
  add_body(std::make_unique<btBoxShape>(btVector3(edge / 2, edge / 2, kTableThickness / 2)),
           T_UP * Pose{Matrix3::Identity(), {0, 0, -kTableThickness / 2}});
}

void Scene::add_artefact(const ArtefactParameters& artefact) {
  for (const Vector3& ball : artefact.balls)
    add_body(std::make_unique<btSphereShape>(artefact.diameter / 2), Pose{Matrix3::Identity(), ball});
}

void Scene::add_pedestal(const Vector3& top, double edge, double opening) {
  const double slat = (edge - opening) / 2;  // width of each of the four around the opening [m]
  const double out = (opening + slat) / 2;
  const auto add_slat = [&](double x, double y, double length_x, double length_y) {
    add_body(std::make_unique<btBoxShape>(btVector3(length_x / 2, length_y / 2, kPedestalThickness / 2)),
             Pose{Matrix3::Identity(), top + Vector3(x, y, -kPedestalThickness / 2)}, kFloorGroup,
             kCubeGroup);
    pedestal_.push_back(bodies_.back().get());
  };
  for (const double side : {-1., 1.}) {
    add_slat(side * out, 0, slat, edge);
    add_slat(0, side * out, opening, slat);
  }
}

void Scene::prepare_for_grasping() {
  constexpr double kEdge = 10;  // [m]
  add_body(std::make_unique<btBoxShape>(btVector3(kEdge / 2, kEdge / 2, kEdge / 2)),
           Pose{Matrix3::Identity(), {0, 0, -kEdge / 2}}, kFloorGroup, kCubeGroup);
  dynamics_.contacts_turn = true;
  dynamics_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  solver_.remember(kShearStiffness);
}

void Scene::add_body(std::unique_ptr<btCollisionShape> shape, const Pose& T_U, int group, int mask) {
  shapes_.push_back(std::move(shape));
  auto body = std::make_unique<btCollisionObject>();
  body->setCollisionShape(shapes_.back().get());
  body->setWorldTransform(to_bullet(T_U));
  body->setFriction(1);
  dynamics_.addCollisionObject(body.get(), group, mask);
  bodies_.push_back(std::move(body));
}

Vector3 Scene::gravity() const { return from_bullet(dynamics_.getGravity()); }

}  // namespace mrroc::sim
