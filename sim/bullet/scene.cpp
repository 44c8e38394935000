#include "sim/bullet/scene.hpp"

#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

constexpr double kGravity = 9.81;         // [m/s^2]
constexpr double kTableThickness = 0.05;  // [m]

}  // namespace

Scene::Scene(int solver_iterations)
    : dispatcher_(&configuration_), dynamics_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
  dynamics_.setGravity({0, 0, -kGravity});
  dynamics_.getSolverInfo().m_numIterations = solver_iterations;
}

Scene::~Scene() {
  for (const auto& table : tables_) dynamics_.removeCollisionObject(table.get());
}

void Scene::add_table(const Pose& T_UP, double edge) {
  shapes_.push_back(std::make_unique<btBoxShape>(btVector3(edge / 2, edge / 2, kTableThickness / 2)));
  auto table = std::make_unique<btCollisionObject>();
  table->setCollisionShape(shapes_.back().get());
  table->setWorldTransform(to_bullet(T_UP * Pose{Matrix3::Identity(), {0, 0, -kTableThickness / 2}}));
  table->setFriction(1);
  dynamics_.addCollisionObject(table.get(), kPaperGroup, kPenGroup);
  tables_.push_back(std::move(table));
}

Vector3 Scene::gravity() const { return from_bullet(dynamics_.getGravity()); }

}  // namespace mrroc::sim
