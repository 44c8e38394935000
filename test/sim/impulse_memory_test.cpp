// Memory of the solver of contacts about the integration before.
#include "sim/bullet/impulse_memory.hpp"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <gtest/gtest.h>

#include <deque>
#include <vector>

namespace mrroc::sim {
namespace {

class Impulses : public testing::Test {
 protected:
  Impulses() {
    hand_.setupFixed(2, 1, {1, 1, 1}, -1, btQuaternion::getIdentity(), {0, 0, 0}, {0, 0, 0});
    hand_.getLink(2).m_collider = &pad_;
    cube_.getLink(0).m_collider = &layer_;
  }
  /// A row of a contact of the two links, with a normal along z. @param at  in the world [m]
  btMultiBodySolverConstraint row(const btVector3& at, double impulse = 0) {
    points_.emplace_back();
    points_.back().m_positionWorldOnA = points_.back().m_positionWorldOnB = at;
    points_.back().m_normalWorldOnB = {0, 0, 1};
    btMultiBodySolverConstraint row;
    row.m_multiBodyA = &hand_;
    row.m_multiBodyB = &cube_;
    row.m_linkA = 2;
    row.m_linkB = 0;
    row.m_originalContactPoint = &points_.back();
    row.m_appliedImpulse = impulse;
    return row;
  }
  ImpulseMemory::Contact recall(const btMultiBodySolverConstraint& here) {
    return recall_all({here}).front();
  }
  std::vector<ImpulseMemory::Contact> recall_all(const std::vector<btMultiBodySolverConstraint>& here) {
    std::vector<const btMultiBodySolverConstraint*> normals;
    for (const auto& r : here) normals.push_back(&r);
    std::vector<ImpulseMemory::Contact> known;
    memory_.recall(normals, known);
    return known;
  }
  static void move(btCollisionObject& body, const btVector3& by) {
    body.getWorldTransform().setOrigin(body.getWorldTransform().getOrigin() + by);
  }

  btMultiBody hand_{3, 1, {1, 1, 1}, false, false}, cube_{1, 1, {1, 1, 1}, false, false};
  btMultiBodyLinkCollider pad_{&hand_, 2}, layer_{&cube_, 0};
  std::deque<btManifoldPoint> points_;
  ImpulseMemory memory_;
};

constexpr ImpulseMemory::Spring kRigid{}, kSpring{.stiffness = 100, .most = 3};
const btVector3 kNone{0, 0, 0};

TEST_F(Impulses, OfAContactGoToTheNearestOne) {
  memory_.keep_contact(row({0, 0, 0}, 3), {0, 1, 0}, kRigid);
  memory_.keep_contact(row({0.05, 0, 0}, 4), {5, 0, 0}, kRigid);
  memory_.turn_page();
  const auto known = recall_all({row({0.049, 0, 0}), row({0.001, 0, 0})});
  EXPECT_EQ(known[0].pressed, 4);
  EXPECT_LT(known[0].shear.distance({5, 0, 0}), 1e-12);
  EXPECT_EQ(known[1].pressed, 3);
  EXPECT_LT(known[1].shear.distance({0, 1, 0}), 1e-12);
}

TEST_F(Impulses, AreNotLostWhenContactsBecomeFewerNorMoreWhenTheyBecomeMore) {
  memory_.keep_contact(row({0, 0, 0}, 3), {0, 1, 0}, kRigid);
  memory_.keep_contact(row({0.05, 0, 0}, 4), {5, 0, 0}, kRigid);
  memory_.turn_page();
  const ImpulseMemory::Contact one = recall(row({0.02, 0, 0}));
  EXPECT_EQ(one.pressed, 7);
  EXPECT_LT(one.shear.distance({5, 1, 0}), 1e-12);
  const auto three = recall_all({row({0, 0, 0}), row({0.02, 0, 0}), row({0.05, 0, 0})});
  EXPECT_EQ(three[0].pressed + three[1].pressed + three[2].pressed, 7);
  EXPECT_EQ(three[1].pressed, 0);
}

TEST_F(Impulses, AlongTheSurfacesTurnWithTheBodies) {
  memory_.keep_contact(row({1, 0, 0}, 3), {1, 0, 0}, kSpring);
  memory_.turn_page();
  for (auto* body : {&pad_, &layer_})
    body->setWorldTransform(btTransform(btQuaternion({0, 0, 1}, SIMD_HALF_PI)));
  EXPECT_LT(recall(row({0, 1, 0})).shear.distance({0, 1, 0}), 1e-12)
      << "nothing has moved along the other, on whatever arc";
}

TEST_F(Impulses, OfASpringAreThoseOfItsPlaceAsFarAsFrictionBearsThem) {
  memory_.keep_contact(row({0, 0, 0}, 3), {1, 0, 0}, kSpring);
  memory_.turn_page();
  move(pad_, {0.005, 0, 0.001});
  EXPECT_LT(recall(row({0, 0, 0})).shear.distance({0.5, 0, 0}), 1e-12)
      << "the pad gave way by 5 mm, along the surface";
  move(layer_, {0.005, 0, 0});
  EXPECT_LT(recall(row({0, 0, 0})).shear.distance({1, 0, 0}), 1e-12) << "the layer has followed";
  move(layer_, {0, 0.1, 0});
  EXPECT_LT(recall(row({0, 0, 0})).shear.distance(kSpring.most * btVector3(1, 10, 0).normalized()), 1e-12)
      << "it slips";
}

TEST_F(Impulses, OfASpringDoNotJumpWhenItsStiffnessBecomesAnother) {
  constexpr ImpulseMemory::Spring kHalf{.stiffness = kSpring.stiffness / 2, .most = kSpring.most};
  memory_.keep_contact(row({0, 0, 0}, 3), {1, 0, 0}, kSpring);
  memory_.turn_page();
  move(pad_, {0.002, 0, 0});
  const btVector3 shear = recall(row({0, 0, 0})).shear;
  EXPECT_LT(shear.distance({0.8, 0, 0}), 1e-12);
  memory_.keep_contact(row({0, 0, 0}, 3), shear, kHalf);
  memory_.turn_page();
  EXPECT_LT(recall(row({0, 0, 0})).shear.distance({0.8, 0, 0}), 1e-12);
  move(pad_, {0.002, 0, 0});
  EXPECT_LT(recall(row({0, 0, 0})).shear.distance({0.7, 0, 0}), 1e-12);
}

TEST_F(Impulses, OfContactsAreThoseOfTheIntegrationBeforeAndOfNoneAfterABodyWasMadeAnew) {
  memory_.keep_contact(row({0, 0, 0}, 3), {1, 0, 0}, kSpring);
  memory_.turn_page();
  EXPECT_EQ(recall(row({0, 0, 0})).pressed, 3);
  memory_.turn_page();
  EXPECT_EQ(recall(row({0, 0, 0})).pressed, 0) << "nothing has touched";
  memory_.keep_contact(row({0, 0, 0}, 3), {1, 0, 0}, kSpring);
  memory_.forget();
  EXPECT_EQ(recall(row({0, 0, 0})).pressed, 0);
  EXPECT_EQ(recall(row({0, 0, 0})).shear.length(), 0);
}

TEST_F(Impulses, OfAContactWithWhatIsNoMultiBodyNeedNoLink) {
  const auto with_floor = [&](int link) {
    btMultiBodySolverConstraint r = row({0, 0, 0}, 3);
    r.m_multiBodyA = nullptr;
    r.m_linkA = link;  // whatever stood there
    return r;
  };
  memory_.keep_contact(with_floor(17), {1, 0, 0}, kSpring);
  memory_.turn_page();
  move(layer_, {0.005, 0, 0});
  const ImpulseMemory::Contact known = recall(with_floor(3));
  EXPECT_EQ(known.pressed, 3);
  EXPECT_LT(known.shear.distance({1.5, 0, 0}), 1e-12);
}

TEST_F(Impulses, OfOtherLinksAreNotTaken) {
  memory_.keep_contact(row({0, 0, 0}, 3), kNone, kRigid);
  memory_.turn_page();
  btMultiBodySolverConstraint other = row({0, 0, 0});
  other.m_linkB = -1;
  cube_.setBaseCollider(&layer_);
  EXPECT_EQ(recall(other).pressed, 0);
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
