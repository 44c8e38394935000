#include "sim/collision.hpp"

#include <btBulletCollisionCommon.h>

#include "sim/bullet/arm_body.hpp"
#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

struct Solid {
  std::unique_ptr<btConvexShape> shape;
  btCollisionObject object;
  btVector3 low, high;  // of the box around it
};

struct Contact final : btCollisionWorld::ContactResultCallback {
  bool touching{};
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    touching = touching || point.getDistance() <= 0;
    return 0;
  }
};

std::unique_ptr<btConvexShape> solid_of(Shape shape, const Vector3& half) {
  if (shape == Shape::cylinder) return std::make_unique<btCylinderShapeZ>(to_bullet(half));
  if (shape == Shape::sphere) return std::make_unique<btSphereShape>(half.x());
  return std::make_unique<btBoxShape>(to_bullet(half));
}

}  // namespace

struct CollisionSolids::Impl {
  std::size_t add(std::unique_ptr<btConvexShape> shape) {
    auto solid = std::make_unique<Solid>();
    solid->shape = std::move(shape);
    solid->object.setCollisionShape(solid->shape.get());
    solids.push_back(std::move(solid));
    return solids.size() - 1;
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld detection{&dispatcher, &broadphase, &configuration};
  std::vector<std::unique_ptr<Solid>> solids;
};

CollisionSolids::CollisionSolids() : impl_(std::make_unique<Impl>()) {}
CollisionSolids::~CollisionSolids() = default;

std::size_t CollisionSolids::add(Shape shape, const Vector3& size) {
  return impl_->add(solid_of(shape, size / 2));
}

std::size_t CollisionSolids::add_hull(std::span<const Vector3> corners) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(0);
  for (const Vector3& corner : corners) hull->addPoint(to_bullet(corner), false);
  hull->recalcLocalAabb();
  return impl_->add(std::move(hull));
}

void CollisionSolids::place(std::size_t solid, const Pose& T_U) {
  impl_->solids[solid]->object.setWorldTransform(to_bullet(T_U));
}

void CollisionSolids::find_bounds() {
  for (const auto& solid : impl_->solids)
    solid->shape->getAabb(solid->object.getWorldTransform(), solid->low, solid->high);
}

bool CollisionSolids::touch(std::size_t a, std::size_t b) {
  Solid &i = *impl_->solids[a], &j = *impl_->solids[b];
  if (!TestAabbAgainstAabb2(i.low, i.high, j.low, j.high)) return false;
  Contact contact;
  impl_->detection.contactPairTest(&i.object, &j.object, contact);
  return contact.touching;
}

struct LinkChain::Impl {
  Pose T_UB;
  ArmBody body;
  std::vector<BodyShape> shapes;
  std::vector<LinkSolid> solids;
};

LinkChain::LinkChain(const robots::RobotType& type, int model, const Pose& T_UB)
    : impl_(std::make_unique<Impl>()) {
  impl_->T_UB = T_UB;
  const int axes = static_cast<int>(type.motors.size());
  const Chain chain =
      read_chain(type.urdf, lengths_of(type, model), AxisVector::Zero(axes), {}, GripperBodyParameters{});
  impl_->body = build_arm(chain, T_UB);
  for (const BodyShape& s : chain.shapes) {
    if (s.body >= chain.tool) continue;  // what the tool carries
    impl_->shapes.push_back(s);
    impl_->solids.push_back({s.link, s.body + 1, s.shape, s.size});
  }
}

LinkChain::~LinkChain() = default;
LinkChain::LinkChain(LinkChain&&) noexcept = default;
LinkChain& LinkChain::operator=(LinkChain&&) noexcept = default;

const std::vector<LinkSolid>& LinkChain::solids() const { return impl_->solids; }
int LinkChain::joints() const { return impl_->body.joints; }
void LinkChain::set_joints(const AxisVector& joints) { sim::set_joints(*impl_->body.body, joints); }

Pose LinkChain::place(std::size_t solid) const {
  const BodyShape& s = impl_->shapes[solid];
  return (s.body < 0 ? impl_->T_UB : link_pose(*impl_->body.body, s.body)) * s.T_GV;
}

Pose LinkChain::T_UE() const { return link_pose(*impl_->body.body, impl_->body.tool) * impl_->body.T_GE; }

}  // namespace mrroc::sim
