// Bodies of an arm in an engine, without drives.
#include "sim/engine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "sim/simulated_arm.hpp"
#include "test/rig/engines.hpp"
#include "test/rig/irb6_cell.hpp"

namespace mrroc::sim {
namespace {

/// The arm on its track, far above its paper.
class Bodies {
 public:
  explicit Bodies(PhysicsEngine engine, int substeps = 2) : h(kStep / substeps) {
    WorldParameters p = rig::irb6_cell();
    p.arms.erase(p.arms.begin());
    p.arms[0].start = {0.1, 0.2, -1.7, 0.1, 0.3, 0.4, -0.5};
    p.substeps = substeps;
    plans.push_back(plan_arm(p.arms[0]));
    engine_ = engine == PhysicsEngine::mujoco ? mujoco_engine(p, plans) : bullet_engine(p, plans);
    arm().open_brakes();
  }

  ArmMechanics& arm() { return engine_->arm(0); }
  Engine& engine() { return *engine_; }
  void integrate() {
    engine_->integrate();
    felt = arm().follow(Vector3::Zero());
  }
  [[nodiscard]] int joints() const { return plans[0].chain.joints; }

  /// @return speeds after one integration from rest in which this torque turns one joint, over its duration
  AxisVector acceleration(int pushed, double torque) {
    arm().push_joint(pushed, torque);
    integrate();
    AxisVector a(joints());
    for (int k = 0; k < joints(); ++k) a[k] = arm().speed(k) / h;
    return a;
  }

  double h;  // [s]
  std::vector<ArmPlan> plans;
  Wrench felt;

 private:
  std::unique_ptr<Engine> engine_;
};

std::vector<Pose> links_of(Bodies& bodies) {
  std::vector<Pose> links;
  for (std::size_t k = 0; k < bodies.plans[0].chain.links.size(); ++k)
    links.push_back(bodies.arm().link(static_cast<int>(k)));
  return links;
}

struct Energy {
  double kinetic{};
  double potential{};
};

/// Of all links, from where they were before, are, and will be.
Energy energy(const Chain& chain, const std::array<std::vector<Pose>, 3>& links, double h) {
  Energy e;
  for (std::size_t k = 0; k < chain.links.size(); ++k) {
    const ChainLink& link = chain.links[k];
    const Vector3 v = (links[2][k].p - links[0][k].p) / (2 * h);
    const Eigen::AngleAxisd turn(links[0][k].R.transpose() * links[2][k].R);
    const Vector3 w = turn.angle() * turn.axis() / (2 * h);
    e.kinetic += (link.mass * v.squaredNorm() + w.cwiseAbs2().dot(link.inertia)) / 2;
    e.potential += link.mass * kGravity * links[1][k].p.z();
  }
  return e;
}

class EngineOf : public testing::TestWithParam<PhysicsEngine> {};
INSTANTIATE_TEST_SUITE_P(Engines, EngineOf, testing::ValuesIn(rig::engines()), rig::engine_name);

TEST_P(EngineOf, AnArmThatFallsKeepsItsEnergy) {
  Bodies bodies(GetParam(), 20);
  std::array<std::vector<Pose>, 3> links{links_of(bodies), links_of(bodies), links_of(bodies)};
  double first = 0, least = 0, most = 0, fastest = 0;
  for (int k = 0; k < 4000; ++k) {
    bodies.integrate();
    std::rotate(links.begin(), links.begin() + 1, links.end());
    links[2] = links_of(bodies);
    const Energy e = energy(bodies.plans[0].chain, links, bodies.h);
    if (k == 2) first = least = most = e.kinetic + e.potential;
    if (k < 2) continue;
    fastest = std::max(fastest, e.kinetic);
    least = std::min(least, e.kinetic + e.potential);
    most = std::max(most, e.kinetic + e.potential);
  }
  EXPECT_GT(fastest, 30) << "it did not fall [J]";
  EXPECT_LT(std::max(most - first, first - least), 0.01 * fastest);
}

TEST_P(EngineOf, AClosedBrakeHoldsUntilItSlips) {
  Bodies bodies(GetParam());
  constexpr int kTrack = 0;  // nothing else moves when it is pushed
  const AxisMatrix motors_per_joints = bodies.plans[0].robot->motors_per_joints(bodies.plans[0].start);
  bodies.arm().close_brakes(motors_per_joints);
  const double slips =
      rig::irb6_cell().arms[1].motors[kTrack].brake_torque * std::abs(motors_per_joints(kTrack, kTrack));
  for (int k = 0; k < 100; ++k) bodies.acceleration(kTrack, 0.98 * slips);
  EXPECT_LT(std::abs(bodies.arm().speed(kTrack)), 1e-9);
  for (int k = 0; k < 100; ++k) bodies.acceleration(kTrack, 1.05 * slips);
  EXPECT_GT(bodies.arm().speed(kTrack), 1e-3);
}

TEST_P(EngineOf, TheSensorFeelsAForceOnTheTipBesideTheWeight) {
  Bodies bodies(GetParam());
  bodies.arm().close_brakes(bodies.plans[0].robot->motors_per_joints(bodies.plans[0].start));
  bodies.integrate();
  const Wrench weight = bodies.arm().weight();
  for (const Axis a : kAxes) EXPECT_NEAR(bodies.felt[a], weight[a], 1e-6);
  const Vector3 force(1, -2, 3);
  bodies.arm().push_tip(force);
  bodies.engine().integrate();
  const Wrench felt = bodies.arm().follow(force);
  const Pose T_SE = bodies.plans[0].chain.T_GS.inverse() * bodies.plans[0].chain.T_GE;
  const Vector3 force_E = (bodies.arm().tool().T_UG.R * bodies.plans[0].chain.T_GE.R).transpose() * force;
  const Wrench expected = weight + xi_F(T_SE, Wrench::from(force_E, Vector3::Zero()));
  for (const Axis a : kAxes) EXPECT_NEAR(felt[a], expected[a], 1e-3);
}

TEST(Engines, AgreeAboutInertiaAndGravity) {
  if (!has_mujoco()) GTEST_SKIP() << "this build has no MuJoCo";
  for (int pushed = 0; pushed < 7; ++pushed) {
    Bodies bullet(PhysicsEngine::bullet), mujoco(PhysicsEngine::mujoco);
    const AxisVector a = bullet.acceleration(pushed, 10), b = mujoco.acceleration(pushed, 10);
    EXPECT_GT(a.norm(), 1);
    EXPECT_LT((a - b).norm(), 1e-9 * a.norm()) << a.transpose() << "\n" << b.transpose();
  }
}

TEST(Engines, AgreeAboutTheFirstTenthOfASecondOfAFall) {
  if (!has_mujoco()) GTEST_SKIP() << "this build has no MuJoCo";
  Bodies bullet(PhysicsEngine::bullet), mujoco(PhysicsEngine::mujoco);
  for (int k = 0; k < 100; ++k) {
    bullet.integrate();
    mujoco.integrate();
  }
  EXPECT_GT(std::abs(bullet.arm().position(2) - bullet.plans[0].start[2]), 0.005);
  for (int k = 0; k < bullet.joints(); ++k)
    EXPECT_NEAR(bullet.arm().position(k), mujoco.arm().position(k), 1e-6) << k;
}

TEST(Engines, WithoutMujocoRefuseToBeIt) {
  if (has_mujoco()) GTEST_SKIP() << "this build has MuJoCo";
  WorldParameters p = rig::irb6_cell();
  p.engine = PhysicsEngine::mujoco;
  EXPECT_THROW(World{p}, std::invalid_argument);
}

TEST(Engines, RefuseInMujocoWhatItDoesNotHave) {
  WorldParameters p = rig::irb6_cell();
  p.engine = PhysicsEngine::mujoco;
  p.free_body.emplace();
  EXPECT_THROW(World{p}, std::invalid_argument);
  p.free_body.reset();
  p.arms[0].palm.emplace();
  EXPECT_THROW(World{p}, std::invalid_argument);
}

TEST(Engines, SayTheSameOfAnArmAtRestForItsGears) {
  if (!has_mujoco()) GTEST_SKIP() << "this build has no MuJoCo";
  Bodies bullet(PhysicsEngine::bullet), mujoco(PhysicsEngine::mujoco);
  const ArmAtRest a = bullet.arm().at_rest(), b = mujoco.arm().at_rest();
  EXPECT_EQ(a.joints, b.joints);
  EXPECT_LT((a.mass - b.mass).cwiseAbs().maxCoeff(), 1e-6 * a.mass.maxCoeff());
  EXPECT_LT((a.holding - b.holding).cwiseAbs().maxCoeff(), 1e-6 * a.holding.cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace mrroc::sim
