#include "sim/bullet/cube_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/cube/move.hpp"
#include "sim/bullet/convert.hpp"

namespace mrroc::sim {
namespace {

using cube::Face;

constexpr double kQuarter = std::numbers::pi / 2;
constexpr double kGap = 1e-4;  // between layers [m]
// Largest angle of a layer that is forgotten when layers are chosen anew [rad]: so far may a layer be off its seat
// while another one begins to turn, which straightens it.
constexpr double kStraightened = 0.05;
constexpr int kDebounce = 2;     // steps in which another axis must be wanted ...
constexpr double kMore = 1.3;    // compared with the present axis
constexpr double kWanted = 0.9;  // ... which is that a layer is turned by so much of its breakaway
constexpr std::array kSides{1., -1.};

// Faces out of which the axes of C come, and those opposite.
constexpr std::array<std::array<Face, 2>, 3> kFaces{
    {{Face::R, Face::L}, {Face::B, Face::F}, {Face::U, Face::D}}};

btVector3 box_inertia(double mass, const Vector3& edges, double added) {
  const Vector3 square = edges.cwiseAbs2();
  return to_bullet(
      Vector3(Vector3::Constant(added) + mass / 12 * (Vector3::Constant(square.sum()) - square)));
}

/// @param side  0: in the direction of the axis, 1: against it
Face face(int axis, int side) {
  return kFaces[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
}

/// Bodies that press on the cube, with their forces: a pad may lie on several layers.
struct Pressing {
  const btCollisionObject* by;
  double force;  // [N]
};
constexpr std::size_t kMostPressing = 8;  // two hands with two pads and a palm each, and the floor

/// @return force of that body with what is added
double add(std::array<Pressing, kMostPressing>& all, const btCollisionObject* by, double force) {
  for (Pressing& p : all) {
    if (p.by && p.by != by) continue;
    p.by = by;
    return p.force += force;
  }
  return force;
}

int quarters(double angle) { return static_cast<int>(std::lround(angle / kQuarter)); }

}  // namespace

CubeBody::CubeBody(const CubeParameters& p, const Pose& T_UC, Scene& scene, double h)
    : p_(p),
      scene_(scene),
      h_(h),
      frictions_(face_frictions(p.faces)),
      settled_(p.state),
      faces_{FaceDrive(frictions_[0]), FaceDrive(frictions_[0])} {
  build(T_UC, Vector3::Zero(), Vector3::Zero());
  observe();
}

CubeBody::~CubeBody() { destroy(); }

void CubeBody::build(const Pose& T_UC, const Vector3& velocity, const Vector3& turning) {
  const Vector3 axis = Vector3::Unit(axis_);
  const double layer = p_.edge / 3;
  const double mass = p_.mass / 3;
  Vector3 edges = Vector3::Constant(p_.edge);
  edges[axis_] = layer - kGap;
  const btVector3 inertia = box_inertia(mass, edges, p_.added_inertia);
  const btVector3 to_joint = to_bullet(Vector3(axis * layer / 2));
  const btVector3 to_layer =
      to_bullet(Vector3(axis * (layer + kGap) / 2));  // its outside is that of the cube

  body_ = std::make_unique<btMultiBody>(2, mass, inertia, false, false);
  body_->setBasePos(to_bullet(T_UC.p));
  body_->setWorldToBaseRot(quaternion(T_UC.R.transpose()));
  for (int side = 0; side < 2; ++side) {
    const double out = kSides[static_cast<std::size_t>(side)];
    body_->setupRevolute(side, mass, inertia, -1, btQuaternion(0, 0, 0, 1), to_bullet(Vector3(out * axis)),
                         out * to_joint, out * to_layer, true);
  }
  body_->finalizeMultiDof();
  body_->setBaseVel(to_bullet(velocity));
  body_->setBaseOmega(to_bullet(turning));
  body_->setCanSleep(false);
  body_->setHasSelfCollision(false);
  body_->setUseGyroTerm(true);
  body_->setLinearDamping(0);
  body_->setAngularDamping(0);
  scene_.dynamics().addMultiBody(body_.get());

  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    boxes_[i] = std::make_unique<btBoxShape>(to_bullet(Vector3(edges / 2)));
    colliders_[i] = std::make_unique<btMultiBodyLinkCollider>(body_.get(), k - 1);
    colliders_[i]->setCollisionShape(boxes_[i].get());
    colliders_[i]->setFriction(p_.friction);
    colliders_[i]->setActivationState(DISABLE_DEACTIVATION);
    if (k == 0)
      body_->setBaseCollider(colliders_[i].get());
    else
      body_->getLink(k - 1).m_collider = colliders_[i].get();
    scene_.dynamics().addCollisionObject(colliders_[i].get(), kCubeGroup, kGripperGroup | kFloorGroup);
  }
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  body_->forwardKinematics(rotations, origins);
  body_->updateCollisionObjectWorldTransforms(rotations, origins);

  drives_ = std::make_unique<JointDrives>(*body_, 0, h_);
  scene_.dynamics().addMultiBodyConstraint(drives_.get());
  drives_->finalizeMultiDof();
  for (int side = 0; side < 2; ++side)
    faces_[static_cast<std::size_t>(side)] =
        FaceDrive(frictions_[static_cast<std::size_t>(cube::number(face(axis_, side)))]);
}

void CubeBody::destroy() {
  scene_.dynamics().removeMultiBodyConstraint(drives_.get());
  for (const auto& collider : colliders_) scene_.dynamics().removeCollisionObject(collider.get());
  scene_.dynamics().removeMultiBody(body_.get());
}

void CubeBody::set_friction(Face f, const FaceFriction& friction) {
  frictions_[static_cast<std::size_t>(cube::number(f))] = friction;
  for (int side = 0; side < 2; ++side)
    if (face(axis_, side) == f) faces_[static_cast<std::size_t>(side)].set_friction(friction);
}

bool CubeBody::lay(int axis) {
  observe();
  for (const double angle : truth_.angle)
    if (std::abs(angle) > kStraightened) return false;
  settled_ = truth_.state;
  const Vector3 velocity = from_bullet(body_->getBaseVel());
  const Vector3 turning = from_bullet(body_->getBaseOmega());
  destroy();
  scene_.forget_impulses();
  axis_ = axis;
  asked_ = 0;
  ++truth_.layings;
  build(truth_.T_UC, velocity, turning);
  observe();
  return true;
}

void CubeBody::begin_step() {
  moments_ = {};
  hands_ = {};
  truth_.torque = {};
  truth_.squeeze = 0;
}

void CubeBody::push() {
  for (int side = 0; side < 2; ++side) {
    const FaceDrive::Action action =
        faces_[static_cast<std::size_t>(side)].step(body_->getJointPos(side), body_->getJointVel(side), h_);
    drives_->drive(side, action.speed, -action.positive, action.negative);
    body_->addJointTorque(side, action.torque);
  }
}

void CubeBody::follow(double share) {
  for (int side = 0; side < 2; ++side)
    truth_.torque[static_cast<std::size_t>(side)] += share * std::abs(drives_->given(side));
  add_contacts(share);
}

void CubeBody::add_contacts(double share) {
  btDispatcher& dispatcher = *scene_.dynamics().getDispatcher();
  const btTransform T_CU = body_->getBaseWorldTransform().inverse();
  truth_.on_floor = false;
  std::array<Pressing, kMostPressing> pressing{};
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      const bool first = is_mine(manifold.getBody0());
      if (!first && !is_mine(manifold.getBody1())) continue;
      // The normal points from the second body to the first.
      const btVector3 impulse = point.m_appliedImpulse * point.m_normalWorldOnB +
                                point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                                point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
      const Vector3 force = from_bullet(T_CU.getBasis() * impulse) * ((first ? 1 : -1) / h_);
      const Vector3 place =
          from_bullet(T_CU * (first ? point.getPositionWorldOnA() : point.getPositionWorldOnB()));
      const Vector3 moment = place.cross(force);
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(place[axis]) < p_.edge / 6) continue;
        moments_[static_cast<std::size_t>(axis)][place[axis] > 0 ? 0 : 1] += share * moment[axis];
      }
      const auto* other = first ? manifold.getBody1() : manifold.getBody0();
      if (const auto* link = btMultiBodyLinkCollider::upcast(other)) {
        Twisting& hand = hands_[hands_[0].by && hands_[0].by != link->m_multiBody ? 1 : 0];
        hand.by = link->m_multiBody;
        hand.moment += share * moment;
      }
      truth_.squeeze = std::max(truth_.squeeze, add(pressing, other, point.m_appliedImpulse / h_));
      truth_.on_floor |= other->getBroadphaseHandle()->m_collisionFilterGroup == kFloorGroup;
    }
  }
}

double CubeBody::transmitted(int axis) const {
  return std::min(std::abs(hands_[0].moment[axis]), std::abs(hands_[1].moment[axis]));
}

int CubeBody::wanted_axis() const {
  std::array<double, 3> share{};  // of the breakaway that is nearest to being reached
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const double moment = moments_[static_cast<std::size_t>(axis)][static_cast<std::size_t>(side)];
      const auto number = static_cast<std::size_t>(cube::number(face(axis, side)));
      double& most = share[static_cast<std::size_t>(axis)];
      most = std::max(most, std::min(std::abs(moment), transmitted(axis)) / frictions_[number].breakaway);
    }
  const auto wanted = std::ranges::max_element(share) - share.begin();
  const double least = std::max(kWanted, kMore * share[static_cast<std::size_t>(axis_)]);
  return share[static_cast<std::size_t>(wanted)] > least ? static_cast<int>(wanted) : axis_;
}

void CubeBody::end_step() {
  observe();
  const int wanted = wanted_axis();
  asked_ = wanted != axis_ ? asked_ + 1 : 0;
  if (asked_ >= kDebounce) lay(wanted);
}

void CubeBody::observe() {
  truth_.T_UC = from_bullet(body_->getBaseWorldTransform());
  truth_.axis = axis_;
  truth_.state = settled_;
  for (int side = 0; side < 2; ++side) {
    const double angle = body_->getJointPos(side);
    const int turns = quarters(angle);
    truth_.angle[static_cast<std::size_t>(side)] = angle - turns * kQuarter;
    // A face turned counterclockwise by one quarter is turned clockwise by three.
    const int clockwise = ((-turns) % 4 + 4) % 4;
    if (clockwise) truth_.state = truth_.state * cube::turn({face(axis_, side), clockwise});
  }
}

}  // namespace mrroc::sim
