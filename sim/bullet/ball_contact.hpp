// Keeps a ball to one point of contact with a body.
#pragma once
#include <btBulletDynamicsCommon.h>

namespace mrroc::sim {

/// A ball that slides while it is pressed deep into a surface leaves Bullet a point of contact where it has been, as
/// deep as the new one, and both would push. Call after contacts have been found: the newest point of each body stays.
inline void keep_newest_contact(btDispatcher& dispatcher, const btCollisionObject* ball) {
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
    if (manifold.getBody0() != ball && manifold.getBody1() != ball) continue;
    while (manifold.getNumContacts() > 1) {
      const bool first =
          manifold.getContactPoint(0).getLifeTime() > manifold.getContactPoint(1).getLifeTime();
      manifold.removeContactPoint(first ? 0 : 1);
    }
  }
}

}  // namespace mrroc::sim
