// An upright prism over a polygon with many corners, as a shape of Bullet.
#pragma once
#include <btBulletDynamicsCommon.h>

#include <vector>

namespace mrroc::sim {

/// Stands for a cylinder over an ellipse. Bullet's hull of the same corners looks at all of them whenever it asks which lies
/// farthest; this one knows where to look, and answers the same, to the bit.
class RoundPrism final : public btConvexInternalShape {
 public:
  /// @param length, width, thickness along x, y, z, centred at the origin [m]  @param corners of the polygon, at least 3, at
  ///        equal shares of a turn from the x axis on
  RoundPrism(double length, double width, double thickness, int corners);

  [[nodiscard]] btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override;
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* farthest,
                                                         int count) const override;
  void getAabb(const btTransform& T, btVector3& low, btVector3& high) const override;
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  [[nodiscard]] const char* getName() const override { return "RoundPrism"; }

 private:
  int n_;                       // corners of the polygon
  btVector3 half_;              // of length, width, thickness
  std::vector<btVector3> all_;  // corners of the prism: of each side the lower one, then the upper one
};

}  // namespace mrroc::sim
