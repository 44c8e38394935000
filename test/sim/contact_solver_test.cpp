// The solver of contacts against Bullet's own, whose forces it promises, and what it does with a memory.
#include "sim/bullet/contact_solver.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <memory>
#include <random>
#include <vector>

namespace mrroc::sim {
namespace {

constexpr double kHalf = 0.03;  // edge of the box, halved [m]
constexpr double kStep = 5e-4;  // [s]
constexpr double kMass = 0.15;  // of the box and its lid [kg]
constexpr double kSoft = 2e5;   // of each body at a point of contact [N/m], as pads are

/// Where the box is and how it moves, and the jaws' places.
struct Seen {
  btVector3 place, velocity, turning;
  double left{}, right{};
  int touching{};  ///< points of contact
};

/// Where the box is at the beginning.
enum class Begin { flying, gripped };

/// A box with a turning lid between two driven jaws on a base, above a floor; all multi-bodies but the floor.
template <std::derived_from<btMultiBodyConstraintSolver> Solver>
class Hold {
 public:
  /// @param rough  factor of all friction
  explicit Hold(std::uint64_t seed, Begin begin = Begin::flying, double rough = 1)
      : random_(seed), rough_(rough) {
    const bool gripped = begin == Begin::gripped;
    dynamics_.setGravity({0, 0, -9.81});
    dynamics_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    floor_.setCollisionShape(&ground_);
    floor_.setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, 0, -1}));
    dynamics_.addCollisionObject(&floor_, btBroadphaseProxy::StaticFilter, btBroadphaseProxy::DefaultFilter);

    box_.setBasePos({0, 0, gripped ? 0.1 : drawn(0.05, 0.2)});
    box_.setupRevolute(0, 0.05, {1e-4, 1e-4, 1e-4}, -1, btQuaternion::getIdentity(), {0, 0, 1}, {0, 0, kHalf},
                       {0, 0, 0.01});
    add(box_, {&cube_, &lid_}, 1);
    if (!gripped) {
      box_.setBaseVel({drawn(-0.1, 0.1), drawn(-0.1, 0.1), drawn(-0.1, 0)});
      box_.setBaseOmega({drawn(-1, 1), drawn(-1, 1), drawn(-1, 1)});
    }

    hand_.setBasePos({0, 0, 0.1});
    for (int jaw = 0; jaw < 2; ++jaw) {
      const double side = jaw == 0 ? -1 : 1;
      hand_.setupPrismatic(jaw, 0.3, {1e-3, 1e-3, 1e-3}, -1, btQuaternion::getIdentity(), {-side, 0, 0},
                           {side * (gripped ? kHalf + 0.01 : drawn(0.05, 0.07)), 0, 0}, {0, 0, 0}, true);
    }
    add(hand_, {nullptr, &pad_, &pad_}, 2);
    const double grip = drawn(0.01, 0.03);
    for (int jaw = 0; jaw < 2; ++jaw) {
      motors_.push_back(
          std::make_unique<btMultiBodyJointMotor>(&hand_, jaw, 0.2, gripped ? grip : drawn(0.01, 0.03)));
      motors_.back()->finalizeMultiDof();
      dynamics_.addMultiBodyConstraint(motors_.back().get());
    }
  }

  ~Hold() {
    for (const auto& motor : motors_) dynamics_.removeMultiBodyConstraint(motor.get());
    for (btMultiBody* body : {&box_, &hand_}) dynamics_.removeMultiBody(body);
    for (const auto& collider : colliders_) dynamics_.removeCollisionObject(collider.get());
    dynamics_.removeCollisionObject(&floor_);
  }

  Seen step() {
    dynamics_.stepSimulation(kStep, 0, kStep);
    Seen seen{box_.getBasePos(), box_.getBaseVel(), box_.getBaseOmega(), hand_.getJointPos(0),
              hand_.getJointPos(1)};
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m)
      seen.touching += dispatcher_.getManifoldByIndexInternal(m)->getNumContacts();
    return seen;
  }

  Solver& solver() { return solver_; }
  void set_iterations(int n) { dynamics_.getSolverInfo().m_numIterations = n; }
  void set_weight(double share) { dynamics_.setGravity({0, 0, -9.81 * share}); }

 private:
  double drawn(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }

  /// @param shapes  of base and links; null: none
  void add(btMultiBody& body, const std::vector<btCollisionShape*>& shapes, int group) {
    body.finalizeMultiDof();
    body.setLinearDamping(0);
    body.setAngularDamping(0);
    dynamics_.addMultiBody(&body, 1 << (5 + group));
    btAlignedObjectArray<btQuaternion> turned;
    btAlignedObjectArray<btVector3> moved;
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      if (!shapes[k]) continue;
      const int link = static_cast<int>(k) - 1;
      colliders_.push_back(std::make_unique<btMultiBodyLinkCollider>(&body, link));
      btMultiBodyLinkCollider& collider = *colliders_.back();
      collider.setCollisionShape(shapes[k]);
      collider.setFriction(rough_ * drawn(0.3, 1));
      collider.setContactStiffnessAndDamping(kSoft, 0.002 * kSoft);
      if (link < 0)
        body.setBaseCollider(&collider);
      else
        body.getLink(link).m_collider = &collider;
      const int own = 1 << (5 + group);
      dynamics_.addCollisionObject(&collider, own, ~own);
    }
    body.forwardKinematics(turned, moved);
    body.updateCollisionObjectWorldTransforms(turned, moved);
  }

  std::mt19937_64 random_;
  double rough_;
  btBoxShape ground_{btVector3(1, 1, 1)}, cube_{btVector3(kHalf, kHalf, kHalf)},
      lid_{btVector3(kHalf, kHalf, 0.01)}, pad_{btVector3(0.01, 0.02, 0.02)};
  btCollisionObject floor_;
  btMultiBody box_{1, 0.1, {6e-5, 6e-5, 6e-5}, false, false}, hand_{2, 1, {1, 1, 1}, true, false};
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders_;
  std::vector<std::unique_ptr<btMultiBodyJointMotor>> motors_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  Solver solver_;
  btMultiBodyDynamicsWorld dynamics_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

// Contacts make neighbouring ways part, so rounding is compared over a short time, in many situations. What slips does
// it otherwise than with Bullet's own (SlidingOnAnyEngine).
TEST(ContactSolver, MovesBodiesThatTouchWithoutFrictionAsBulletsOwnSolverDoes) {
  constexpr double kSmooth = 0;
  int touching = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Hold<ContactSolver> ours(seed, Begin::flying, kSmooth);
    Hold<btMultiBodyConstraintSolver> bullets(seed, Begin::flying, kSmooth);
    for (int step = 0; step < 200; ++step) {
      const Seen a = ours.step(), b = bullets.step();
      ASSERT_LT(a.place.distance(b.place), 1e-9) << "seed " << seed << ", step " << step;
      ASSERT_LT(a.velocity.distance(b.velocity), 1e-6) << "seed " << seed << ", step " << step;
      ASSERT_LT(a.turning.distance(b.turning), 1e-4) << "seed " << seed << ", step " << step;
      ASSERT_NEAR(a.left, b.left, 1e-9);
      ASSERT_NEAR(a.right, b.right, 1e-9);
      touching += a.touching;
    }
  }
  EXPECT_GT(touching, 40 * 100) << "too little contact for a comparison";
}

constexpr double kShear = 0.2;

/// @return how far a box that is gripped creeps in half a second with few iterations per integration [m]
double crept(std::uint64_t seed, bool remembers) {
  Hold<ContactSolver> hold(seed, Begin::gripped);
  hold.set_iterations(4);
  if (remembers) hold.solver().remember(kShear);
  const auto height = [&](int steps) {
    for (int step = 1; step < steps; ++step) hold.step();
    return hold.step().place.z();
  };
  const double before = height(200);
  return std::abs(before - height(1000));
}

TEST(ContactSolver, ThatRemembersHoldsWithFewIterationsWhatCreepsOutOfTheGripOtherwise) {
  double with = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    with = std::max(with, crept(seed, true));
    without = std::max(without, crept(seed, false));
  }
  EXPECT_LT(with, 1e-8);
  EXPECT_GT(without, 5e-4) << "there is nothing to be cured";
}

TEST(ContactSolver, ThatRemembersLetsSoftSurfacesGiveWayAlongThemselvesAndComeBack) {
  Hold<ContactSolver> hold(1, Begin::gripped);
  hold.solver().remember(kShear);
  const auto rest = [&](double weight) {
    hold.set_weight(weight);
    for (int step = 1; step < 400; ++step) hold.step();
    return hold.step();
  };
  const Seen before = rest(1), loaded = rest(2), after = rest(1);
  const double stiffness = kShear * kSoft / 2 * before.touching;  // two soft bodies, one after the other
  const double expected = kMass * 9.81 / stiffness;
  EXPECT_NEAR(before.place.z() - loaded.place.z(), expected, 0.02 * expected);
  EXPECT_NEAR(before.place.z() - after.place.z(), 0, 0.02 * expected);
}

/// A box that slides through the grip under a load, and is unloaded again.
struct Slid {
  double friction{};   ///< while it slides [N]
  double remaining{};  ///< way from where it was held to where it stays [m]
  double speed{};      ///< there [m/s]
};

Slid slide(std::uint64_t seed, double weight) {
  Hold<ContactSolver> hold(seed, Begin::gripped);
  hold.solver().remember(kShear);
  const auto after = [&](int steps) {
    for (int step = 1; step < steps; ++step) hold.step();
    return hold.step();
  };
  const double held = after(400).place.z();
  hold.set_weight(weight);
  const double before = after(2).velocity.z();
  const double speed = after(2).velocity.z();
  hold.set_weight(1);
  const Seen stopped = after(400);
  return {kMass * (9.81 * weight + (speed - before) / (2 * kStep)), held - stopped.place.z(),
          stopped.velocity.length()};
}

TEST(ContactSolver, ThatRemembersLetsABoxSlideWithTheFrictionOfItsGripAndStayWhereItStops) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const double friction = slide(seed, 200).friction;
    EXPECT_GT(friction, 1) << "seed " << seed;
    EXPECT_NEAR(slide(seed, 150).friction, friction, 0.02 * friction) << "whatever the load, seed " << seed;
    const Slid gently = slide(seed, 2 * friction / (kMass * 9.81));
    EXPECT_LT(gently.speed, 1e-3) << "seed " << seed;
    EXPECT_GT(gently.remaining, 5e-5) << "seed " << seed;
  }
}

}  // namespace
}  // namespace mrroc::sim
