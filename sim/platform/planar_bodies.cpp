#include "sim/platform/planar_bodies.hpp"

#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mrroc::sim {
namespace {

constexpr double kHeight = 1;     // of everything; all of it is level [m]
constexpr double kWall = 1;       // thickness [m]
constexpr double kMargin = 1e-3;  // by which Bullet rounds polygons [m]

/// Bullet multiplies the coefficients of two bodies, which is no grip that a box has against everything.
class World final : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;
  std::vector<std::optional<double>> grips;  ///< of the bodies, by their user index

  void performDiscreteCollisionDetection() override {
    btDiscreteDynamicsWorld::performDiscreteCollisionDetection();
    for (int k = 0; k < getDispatcher()->getNumManifolds(); ++k) {
      btPersistentManifold& m = *getDispatcher()->getManifoldByIndexInternal(k);
      constexpr double kNone = std::numeric_limits<double>::infinity();
      const double both = std::min(grip(*m.getBody0()).value_or(kNone), grip(*m.getBody1()).value_or(kNone));
      if (both == kNone) continue;
      for (int n = 0; n < m.getNumContacts(); ++n) m.getContactPoint(n).m_combinedFriction = both;
    }
  }

 private:
  [[nodiscard]] std::optional<double> grip(const btCollisionObject& object) const {
    return object.getUserIndex() < 0 ? std::nullopt : grips[static_cast<std::size_t>(object.getUserIndex())];
  }
};

}  // namespace

struct PlanarBodies::Impl {
  explicit Impl(const Room& room)
      : dispatcher(&configuration), world(&dispatcher, &broadphase, &solver, &configuration) {
    world.setGravity({0, 0, 0});
    add_walls(room);
    for (const Obstacle& each : room.obstacles) add_obstacle(each);
  }
  ~Impl() {
    for (const auto& body : bodies) world.removeRigidBody(body.get());
    for (const auto& fixed : statics) world.removeCollisionObject(fixed.get());
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void add_walls(const Room& room) {
    const double x = (room.lower[0] + room.upper[0]) / 2, y = (room.lower[1] + room.upper[1]) / 2;
    const btVector3 along_x((room.upper[0] - room.lower[0]) / 2 + kWall, kWall / 2, kHeight / 2);
    const btVector3 along_y(kWall / 2, (room.upper[1] - room.lower[1]) / 2 + kWall, kHeight / 2);
    add_static(std::make_unique<btBoxShape>(along_x), x, room.lower[1] - kWall / 2);
    add_static(std::make_unique<btBoxShape>(along_x), x, room.upper[1] + kWall / 2);
    add_static(std::make_unique<btBoxShape>(along_y), room.lower[0] - kWall / 2, y);
    add_static(std::make_unique<btBoxShape>(along_y), room.upper[0] + kWall / 2, y);
  }

  void add_obstacle(const Obstacle& obstacle) {
    auto shape = std::make_unique<btConvexHullShape>();
    for (const RoomPoint& corner : obstacle.corner)
      for (const double z : {-kHeight / 2, kHeight / 2}) shape->addPoint({corner[0], corner[1], z}, false);
    shape->recalcLocalAabb();
    shape->setMargin(kMargin);
    add_static(std::move(shape), 0, 0);
  }

  void add_static(std::unique_ptr<btCollisionShape> shape, double x, double y) {
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(shape.get());
    object->setWorldTransform(btTransform(btQuaternion::getIdentity(), {x, y, 0}));
    object->setFriction(1);
    world.addCollisionObject(object.get(), btBroadphaseProxy::StaticFilter, btBroadphaseProxy::DefaultFilter);
    shapes.push_back(std::move(shape));
    statics.push_back(std::move(object));
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  World world;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btCollisionObject>> statics;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
};

PlanarBodies::PlanarBodies(const Room& room) : impl_(std::make_unique<Impl>(room)) {}
PlanarBodies::~PlanarBodies() = default;

int PlanarBodies::add(const PlanarBody& body, const PlanarState& state) {
  Impl& w = *impl_;
  auto outline = std::make_unique<btBoxShape>(btVector3(body.length / 2, body.width / 2, kHeight / 2));
  auto shape = std::make_unique<btCompoundShape>();
  shape->addChildShape(btTransform(btQuaternion::getIdentity(), {body.middle[0], body.middle[1], 0}),
                       outline.get());
  // Only the turn about z is free: the other two moments mean nothing.
  btRigidBody::btRigidBodyConstructionInfo info(body.mass, nullptr, shape.get(),
                                                {body.inertia, body.inertia, body.inertia});
  info.m_startWorldTransform = btTransform(btQuaternion({0, 0, 1}, state.phi), {state.x, state.y, 0});
  info.m_friction = kOutlineFriction;
  auto made = std::make_unique<btRigidBody>(info);
  made->setLinearVelocity({state.vx, state.vy, 0});
  made->setAngularVelocity({0, 0, state.w});
  made->setLinearFactor({1, 1, 0});
  made->setAngularFactor({0, 0, 1});
  made->setActivationState(DISABLE_DEACTIVATION);
  made->setUserIndex(static_cast<int>(w.bodies.size()));
  w.world.grips.push_back(body.grip);
  w.world.addRigidBody(made.get());
  w.shapes.push_back(std::move(outline));
  w.shapes.push_back(std::move(shape));
  w.bodies.push_back(std::move(made));
  return static_cast<int>(w.bodies.size()) - 1;
}

void PlanarBodies::push(int body, const PlanarForce& force) {
  btRigidBody& b = *impl_->bodies.at(static_cast<std::size_t>(body));
  b.applyCentralForce({force.x, force.y, 0});
  b.applyTorque({0, 0, force.moment});
}

void PlanarBodies::integrate(double h) { impl_->world.stepSimulation(h, 0, h); }

PlanarState PlanarBodies::state(int body) const {
  const btRigidBody& b = *impl_->bodies.at(static_cast<std::size_t>(body));
  const btTransform& T = b.getWorldTransform();
  const btVector3 v = b.getLinearVelocity();
  const btMatrix3x3& R = T.getBasis();
  return {.x = T.getOrigin().x(),
          .y = T.getOrigin().y(),
          .phi = std::atan2(R[1][0], R[0][0]),
          .vx = v.x(),
          .vy = v.y(),
          .w = b.getAngularVelocity().z()};
}

}  // namespace mrroc::sim
