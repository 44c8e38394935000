// What the solver of contacts knows of the integration before.
#include "sim/bullet/impulse_memory.hpp"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gtest/gtest.h>

namespace mrroc::sim {
namespace {

class Impulses : public testing::Test {
 protected:
  Impulses() {
    hand_.setupFixed(2, 1, {1, 1, 1}, -1, btQuaternion::getIdentity(), {0, 0, 0}, {0, 0, 0});
    hand_.getLink(2).m_collider = &pad_;
  }
  /// A contact of two links, solved. @param on_a, on_b  where it is on them [m]
  btMultiBodySolverConstraint contact(const btVector3& on_a, const btVector3& on_b, double impulse = 0) {
    point_.m_localPointA = on_a;
    point_.m_localPointB = on_b;
    btMultiBodySolverConstraint row;
    row.m_multiBodyA = &hand_;
    row.m_multiBodyB = &cube_;
    row.m_linkA = 2;
    row.m_linkB = 0;
    row.m_originalContactPoint = &point_;
    row.m_appliedImpulse = impulse;
    return row;
  }

  btMultiBody hand_{3, 1, {1, 1, 1}, false, false}, cube_{1, 1, {1, 1, 1}, false, false};
  btMultiBodyLinkCollider pad_{&hand_, 2};
  btManifoldPoint point_;
  ImpulseMemory memory_;
};

TEST_F(Impulses, OfAContactAreFoundWhereACornerOfEitherBodyStays) {
  memory_.keep_contact(contact({0, 0, 0}, {0.1, 0, 0}, 3), {0, 1, 2});
  memory_.keep_contact(contact({0.05, 0, 0}, {0.15, 0, 0}, 4), {5, 0, 0});
  memory_.turn_page();
  EXPECT_EQ(memory_.contact(contact({0.0001, 0, 0}, {0.3, 0, 0})).pressed, 3) << "it slides on the second";
  EXPECT_EQ(memory_.contact(contact({0.3, 0, 0}, {0.1501, 0, 0})).pressed, 4) << "it slides on the first";
  EXPECT_LT(memory_.contact(contact({0.0001, 0, 0}, {0.1, 0, 0})).shear.distance({0, 1, 2}), 1e-12);
  EXPECT_EQ(memory_.contact(contact({0.025, 0, 0}, {0.125, 0, 0})).pressed, 0) << "nothing was there";
}

TEST_F(Impulses, AlongTheSurfacesTurnWithTheFirstBody) {
  memory_.keep_contact(contact({0, 0, 0}, {0, 0, 0}, 3), {1, 0, 0});
  memory_.turn_page();
  pad_.setWorldTransform(btTransform(btQuaternion({0, 0, 1}, SIMD_HALF_PI)));
  EXPECT_LT(memory_.contact(contact({0, 0, 0}, {0, 0, 0})).shear.distance({0, 1, 0}), 1e-12);
}

TEST_F(Impulses, OfOtherLinksAreNotTaken) {
  memory_.keep_contact(contact({0, 0, 0}, {0, 0, 0}, 3), {0, 0, 0});
  memory_.turn_page();
  btMultiBodySolverConstraint other = contact({0, 0, 0}, {0, 0, 0});
  other.m_linkB = 1;
  EXPECT_EQ(memory_.contact(other).pressed, 0);
}

TEST_F(Impulses, AreThoseOfTheIntegrationBeforeAndOfNoneAfterABodyWasMadeAnew) {
  btMultiBodySolverConstraint drive;
  drive.m_orgDofIndex = 1;
  drive.m_appliedImpulse = 7;
  memory_.keep_drive(drive);
  EXPECT_EQ(memory_.drive(drive), 0) << "the integration is not over";
  memory_.turn_page();
  EXPECT_EQ(memory_.drive(drive), 7);
  drive.m_orgDofIndex = 0;
  EXPECT_EQ(memory_.drive(drive), 0) << "another joint";
  drive.m_orgDofIndex = 1;
  memory_.keep_drive(drive);
  memory_.forget();
  EXPECT_EQ(memory_.drive(drive), 0);
  memory_.turn_page();
  EXPECT_EQ(memory_.drive(drive), 0);
}

}  // namespace
}  // namespace mrroc::sim
