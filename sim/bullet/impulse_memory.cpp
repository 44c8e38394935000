#include "sim/bullet/impulse_memory.hpp"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <algorithm>

namespace mrroc::sim {
namespace {

/// A contact is the same when it has moved by less on one of its bodies [m]: a corner stays where it is on its body.
constexpr double kSame = 1e-3;

/// @return rotation of the first body, of the second where the first one is none
btMatrix3x3 turned(const btMultiBodySolverConstraint& row) {
  const auto of = [](const btMultiBody& body, int link) {
    const btCollisionObject* collider = link < 0 ? body.getBaseCollider() : body.getLink(link).m_collider;
    return collider->getWorldTransform().getBasis();
  };
  return row.m_multiBodyA ? of(*row.m_multiBodyA, row.m_linkA) : of(*row.m_multiBodyB, row.m_linkB);
}

}  // namespace

ImpulseMemory::Place ImpulseMemory::place_of(const btMultiBodySolverConstraint& normal) {
  const auto& point = *static_cast<const btManifoldPoint*>(normal.m_originalContactPoint);
  // Bullet leaves the link of what is no multi-body as it was.
  return {.a = normal.m_multiBodyA,
          .b = normal.m_multiBodyB,
          .link_a = normal.m_multiBodyA ? normal.m_linkA : -1,
          .link_b = normal.m_multiBodyB ? normal.m_linkB : -1,
          .on_a = point.m_localPointA,
          .on_b = point.m_localPointB,
          .contact = {}};
}

double ImpulseMemory::drive(const btMultiBodySolverConstraint& row) const {
  const auto known = std::ranges::find_if(before_.drives, [&](const Drive& d) {
    return d.of == row.m_orgConstraint && d.row == row.m_orgDofIndex;
  });
  return known == before_.drives.end() ? 0 : known->impulse;
}

ImpulseMemory::Contact ImpulseMemory::contact(const btMultiBodySolverConstraint& normal) const {
  const Place here = place_of(normal);
  const Place* nearest = nullptr;
  double least = kSame * kSame;
  for (const Place& p : before_.places) {
    if (p.a != here.a || p.b != here.b || p.link_a != here.link_a || p.link_b != here.link_b) continue;
    const double moved = std::min(p.on_a.distance2(here.on_a), p.on_b.distance2(here.on_b));
    if (moved >= least) continue;
    least = moved;
    nearest = &p;
  }
  if (!nearest) return {};
  return {nearest->contact.pressed, turned(normal) * nearest->contact.shear};
}

void ImpulseMemory::keep_drive(const btMultiBodySolverConstraint& row) {
  now_.drives.push_back({row.m_orgConstraint, row.m_orgDofIndex, row.m_appliedImpulse});
}

void ImpulseMemory::keep_contact(const btMultiBodySolverConstraint& normal, const btVector3& shear) {
  now_.places.push_back(place_of(normal));
  now_.places.back().contact = {normal.m_appliedImpulse, shear * turned(normal)};
}

void ImpulseMemory::turn_page() {
  std::swap(before_, now_);
  now_.drives.clear();
  now_.places.clear();
}

void ImpulseMemory::forget() {
  turn_page();
  turn_page();
}

}  // namespace mrroc::sim
