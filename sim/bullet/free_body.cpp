#include "sim/bullet/free_body.hpp"

#include <algorithm>
#include <utility>

#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

std::unique_ptr<btCollisionShape> shape_of(const FreeBodyParameters& p) {
  if (p.shape == FreeBodyShape::ball) return std::make_unique<btSphereShape>(p.size / 2);
  return std::make_unique<btBoxShape>(btVector3(p.size / 2, p.size / 2, p.size / 2));
}

/// About any axis through the middle [kg m^2].
double inertia_of(const FreeBodyParameters& p) {
  return p.mass * p.size * p.size / (p.shape == FreeBodyShape::ball ? 10 : 6);
}

}  // namespace

FreeBody::FreeBody(const FreeBodyParameters& p, std::vector<PalmBearer> arms, Scene& scene, double h)
    : scene_(scene),
      h_(h),
      p_(p),
      arms_(std::move(arms)),
      pressed_(arms_.size(), Vector3::Zero()),
      shape_(shape_of(p)) {
  scene_.add_pedestal(p.pedestal, p.pedestal_edge, p.pedestal_opening);
  const double inertia = inertia_of(p);
  body_ = std::make_unique<btMultiBody>(0, p.mass, btVector3(inertia, inertia, inertia), false, false);
  body_->setBasePos(to_bullet(Vector3(p.pedestal + Vector3(0, 0, resting_height(p)))));
  body_->setWorldToBaseRot(btQuaternion(0, 0, 0, 1));
  body_->finalizeMultiDof();
  body_->setCanSleep(false);
  body_->setHasSelfCollision(false);
  body_->setUseGyroTerm(true);
  body_->setLinearDamping(0);
  body_->setAngularDamping(0);
  scene_.dynamics().addMultiBody(body_.get());

  collider_ = std::make_unique<btMultiBodyLinkCollider>(body_.get(), -1);
  collider_->setCollisionShape(shape_.get());
  collider_->setFriction(p.friction);
  collider_->setActivationState(DISABLE_DEACTIVATION);
  body_->setBaseCollider(collider_.get());
  scene_.dynamics().addCollisionObject(collider_.get(), kCubeGroup, kGripperGroup | kFloorGroup);
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  body_->forwardKinematics(rotations, origins);
  body_->updateCollisionObjectWorldTransforms(rotations, origins);
  observe();
}

FreeBody::~FreeBody() {
  scene_.dynamics().removeCollisionObject(collider_.get());
  scene_.dynamics().removeMultiBody(body_.get());
}

void FreeBody::begin_step() {
  truth_.press = {};
  truth_.on_pedestal = truth_.on_floor = false;
}

void FreeBody::push() {
  if (p_.shape != FreeBodyShape::ball) return;  // a box lies against a palm with its corners
  constexpr double kSticking = 0.05;            // speed at which the friction is full [rad/s]
  constexpr double kMostDamping = 0.2;          // of what would stop the spin in one integration
  const Vector3 turning = from_bullet(body_->getBaseOmega());
  const double most_damping = kMostDamping * inertia_of(p_) / h_;
  Vector3 moment = Vector3::Zero();
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    const double force = pressed_[arm].norm();
    if (force <= 0) continue;
    const Vector3 normal = pressed_[arm] / force;
    const double most = 2.0 / 3 * p_.friction * arms_[arm].friction * force * p_.patch;
    const double spin = normal.dot(turning - arms_[arm].turning());
    moment -= std::clamp(std::min(most / kSticking, most_damping) * spin, -most, most) * normal;
  }
  body_->addBaseTorque(to_bullet(moment));
}

void FreeBody::follow(double share) {
  btDispatcher& dispatcher = *scene_.dynamics().getDispatcher();
  std::ranges::fill(pressed_, Vector3::Zero());
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    const bool first = manifold.getBody0() == collider_.get();
    if (!first && manifold.getBody1() != collider_.get()) continue;
    const btCollisionObject* other = first ? manifold.getBody1() : manifold.getBody0();
    double force = 0;
    Vector3 pressed = Vector3::Zero();
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      force += point.m_appliedImpulse / h_;
      pressed += point.m_appliedImpulse / h_ * from_bullet(point.m_normalWorldOnB);
    }
    if (force <= 0) continue;
    if (const auto* link = btMultiBodyLinkCollider::upcast(other)) {
      const auto found = std::ranges::find(arms_, link->m_multiBody, &PalmBearer::body);
      const auto arm = static_cast<std::size_t>(found - arms_.begin());
      if (arm < pressed_.size()) pressed_[arm] += pressed;
      if (arm < truth_.press.size()) truth_.press[arm] += share * force;
    } else if (scene_.is_pedestal(other)) {
      truth_.on_pedestal = true;
    } else {
      truth_.on_floor = true;
    }
  }
}

void FreeBody::observe() {
  truth_.T_UO = from_bullet(body_->getBaseWorldTransform());
  truth_.velocity = from_bullet(body_->getBaseVel());
}

}  // namespace mrroc::sim
