// Divides the stiffness of a body's surface among its points of contact.
#pragma once
#include <btBulletDynamicsCommon.h>

#include <algorithm>

namespace mrroc::sim {

/// A surface is as stiff as it is however many points of contact Bullet has found. Call after contacts have been found.
/// @param stiffness  of the surface [N/m] @param relaxation  damping over stiffness [s]
inline void share_contact_stiffness(btDispatcher& dispatcher, const btCollisionObject* surface,
                                    double stiffness, double relaxation) {
  const auto each_point = [&](auto take) {
    for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
      btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
      if (manifold.getBody0() != surface && manifold.getBody1() != surface) continue;
      for (int i = 0; i < manifold.getNumContacts(); ++i) take(manifold.getContactPoint(i));
    }
  };
  int touching = 0;
  each_point([&](const btManifoldPoint& point) { touching += point.getDistance() < 0; });
  const double share = stiffness / std::max(touching, 1);
  each_point([&](btManifoldPoint& point) {
    point.m_combinedContactStiffness1 = share;
    point.m_combinedContactDamping1 = share * relaxation;
  });
}

}  // namespace mrroc::sim
