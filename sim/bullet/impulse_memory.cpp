#include "sim/bullet/impulse_memory.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include <algorithm>
#include <limits>

namespace mrroc::sim {
namespace {

/// @return pose of the link in the world; none where there is no body
btTransform frame(const btMultiBody* body, int link) {
  if (!body) return btTransform::getIdentity();
  const btCollisionObject* collider = link < 0 ? body->getBaseCollider() : body->getLink(link).m_collider;
  return collider->getWorldTransform();
}

}  // namespace

ImpulseMemory::Place ImpulseMemory::place_of(const btMultiBodySolverConstraint& normal) {
  // Bullet leaves the link of what is no multi-body as it was.
  const int link_a = normal.m_multiBodyA ? normal.m_linkA : -1;
  const int link_b = normal.m_multiBodyB ? normal.m_linkB : -1;
  const btVector3& here = contact_point(normal).m_positionWorldOnA;
  return {.a = normal.m_multiBodyA,
          .b = normal.m_multiBodyB,
          .link_a = link_a,
          .link_b = link_b,
          .on_a = frame(normal.m_multiBodyA, link_a).invXform(here),
          .on_b = frame(normal.m_multiBodyB, link_b).invXform(here)};
}

double ImpulseMemory::drive(const btMultiBodySolverConstraint& row) const {
  const auto known = std::ranges::find_if(before_.drives, [&](const Drive& d) {
    return d.of == row.m_orgConstraint && d.row == row.m_orgDofIndex;
  });
  return known == before_.drives.end() ? 0 : known->impulse;
}

void ImpulseMemory::recall(std::span<const btMultiBodySolverConstraint* const> normals,
                           std::vector<Contact>& known) {
  here_.clear();
  for (const auto* normal : normals) here_.push_back(place_of(*normal));
  known.assign(normals.size(), {});
  for (const Kept& kept : before_.contacts) {
    const Place& was = kept.place;
    std::size_t nearest = here_.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < here_.size(); ++k) {
      const Place& is = here_[k];
      if (is.a != was.a || is.b != was.b || is.link_a != was.link_a || is.link_b != was.link_b) continue;
      const double away = is.on_a.distance2(was.on_a);
      if (away >= least) continue;
      least = away;
      nearest = k;
    }
    if (nearest == here_.size()) continue;
    const btTransform A = frame(was.a, was.link_a);
    const btVector3 moved = A * was.on_a - frame(was.b, was.link_b) * was.on_b;
    const btVector3& n = contact_point(*normals[nearest]).m_normalWorldOnB;
    btVector3 shear = A.getBasis() * kept.shear - kept.spring.stiffness * moved;
    shear -= n * n.dot(shear);
    if (kept.spring.stiffness > 0 && shear.length() > kept.spring.most)
      shear *= kept.spring.most / shear.length();
    known[nearest].pressed += kept.pressed;
    known[nearest].shear += shear;
  }
}

void ImpulseMemory::keep_drive(const btMultiBodySolverConstraint& row) {
  now_.drives.push_back({row.m_orgConstraint, row.m_orgDofIndex, row.m_appliedImpulse});
}

void ImpulseMemory::keep_contact(const btMultiBodySolverConstraint& normal, const btVector3& shear,
                                 const Spring& spring) {
  const Place place = place_of(normal);
  const btVector3 turned = shear * frame(place.a, place.link_a).getBasis();
  now_.contacts.push_back({place, normal.m_appliedImpulse, turned, spring});
}

void ImpulseMemory::turn_page() {
  std::swap(before_, now_);
  now_.drives.clear();
  now_.contacts.clear();
}

void ImpulseMemory::forget() {
  turn_page();
  turn_page();
}

}  // namespace mrroc::sim
