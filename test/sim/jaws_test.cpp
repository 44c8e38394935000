// The jaws' servo on the simulated jaws: distances, grips, stops, and the decision that something is held.
#include <gtest/gtest.h>

#include <cmath>

#include "robots/gripper/jaws.hpp"
#include "sim/jaws.hpp"

namespace mrroc::sim {
namespace {

constexpr double kDt = 0.002;
constexpr int kSubsteps = 2;

/// Gripper and plant, stepped together.
struct Rig {
  explicit Rig(double start = 0.074) : jaws(plant(start), kDt / kSubsteps) {
    gripper.believe(start, count());
  }
  static JawParameters plant(double start) {
    JawParameters p;
    p.start = start;
    return p;
  }
  std::int32_t count() const {
    return static_cast<std::int32_t>(std::floor(jaws.turned() * gripper.parameters().increments_per_rad));
  }
  void step() {
    EXPECT_FALSE(gripper.measure(count(), jaws.current()));
    const double pwm = gripper.step();
    jaws.begin_step();
    for (int k = 0; k < kSubsteps; ++k) jaws.step(pwm, true, 1. / kSubsteps);
    current = std::max(current, std::abs(jaws.current()));
    blocked_steps += gripper.blocked();
  }
  void run(int steps) {
    for (int k = 0; k < steps; ++k) step();
  }

  edp::Gripper gripper{gripper::two_jaw(), kDt};
  Jaws jaws;
  double current{};     ///< greatest [A]
  int blocked_steps{};  ///< in which the gripper said so
};

TEST(Jaws, ReachEveryLegalDistanceAndAreNotBlockedThere) {
  for (const double goal : {0.053, 0.06, 0.0739, 0.08, 0.0905}) {
    Rig rig;
    rig.gripper.set_distance(goal);
    rig.run(2500);
    EXPECT_NEAR(rig.jaws.distance(), goal, 1e-4) << goal;
    EXPECT_NEAR(rig.gripper.distance(), rig.jaws.distance(), 2e-6);
    EXPECT_EQ(rig.blocked_steps, 0) << goal;
    EXPECT_LT(rig.current, 0.3);
  }
}

TEST(Jaws, HoldAnObjectWithTheForceOfTheirCurrentAndSayIt) {
  for (const double width : {0.057, 0.065, 0.07}) {
    Rig rig;
    rig.jaws.set_object(width);
    rig.gripper.set_distance(0.053);
    rig.run(3000);
    EXPECT_TRUE(rig.gripper.blocked());
    EXPECT_NEAR(rig.gripper.distance(), width, 2e-3);
    const double torque = JawParameters{}.motor.torque_constant * gripper::two_jaw().max_current;
    EXPECT_NEAR(rig.jaws.force(), torque / -gripper::slope(rig.gripper.set_motor()), 20);
    // They let go, and are free again.
    rig.gripper.set_distance(0.085);
    rig.run(2500);
    EXPECT_FALSE(rig.gripper.blocked());
    EXPECT_NEAR(rig.jaws.distance(), 0.085, 1e-4);
  }
}

TEST(Jaws, NoLoadDrivesThemOpen) {
  Rig rig(0.06);
  rig.gripper.set_distance(0.06);
  rig.run(500);
  const double before = rig.jaws.distance();
  for (const double load : {100., 400.}) {
    rig.jaws.set_load(load);
    for (int k = 0; k < 2000; ++k) {
      rig.gripper.braked();
      rig.jaws.begin_step();
      rig.jaws.step(0, true, 1);
    }
    EXPECT_NEAR(rig.jaws.distance(), before, 1e-5) << load << " N on a motor without voltage";
  }
}

TEST(Jaws, FindTheirPositionAtTheStopOfTheOpening) {
  for (const double start : {0.054, 0.074, 0.0905}) {
    Rig rig(start);
    rig.gripper.start_homing();
    EXPECT_FALSE(rig.gripper.known());
    for (int k = 0; k < 20'000 && rig.gripper.homing(); ++k) rig.step();
    ASSERT_TRUE(rig.gripper.known());
    EXPECT_NEAR(rig.gripper.distance(), rig.jaws.distance(), 1e-3) << "the stop gives way a little";
    rig.gripper.set_distance(0.06);
    rig.run(4000);
    EXPECT_NEAR(rig.jaws.distance(), 0.06, 2e-3);
  }
}

TEST(Jaws, WithoutPowerNothingMoves) {
  Rig rig;
  const double before = rig.jaws.distance();
  for (int k = 0; k < 100; ++k) {
    rig.gripper.braked();
    rig.jaws.begin_step();
    rig.jaws.step(100, false, 1);
  }
  EXPECT_EQ(rig.jaws.distance(), before);
}

}  // namespace
}  // namespace mrroc::sim
