#include "tasks/haptic/coupling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mrroc::haptic {
namespace {

/// What a pair decides that is moved along a line in the air, its slave behind by nothing.
Coupling moved(const Law& law, double speed, int macrosteps) {
  Coupling c = coupled(law);
  for (int i = 1; i <= macrosteps; ++i) {
    const Vector3 x = speed * law.macrostep * i * Vector3::UnitX();
    c = couple(c, law, {.x_m = x, .x_s = law.motion_scale * x, .F_s = Vector3::Zero()}, i);
  }
  return c;
}

TEST(HapticCoupling, FeedsTheSlaveTheSpeedOfTheMasterInItsScale) {
  Law law;
  law.motion_scale = 2;
  const Coupling c = moved(law, 0.04, 500);
  EXPECT_NEAR(c.v_d.x(), 0.08, 1e-6);
  EXPECT_EQ(c.F_d, Vector3(Vector3::Zero())) << "nothing is met";
}

TEST(HapticCoupling, ScalesTheForceThatTheMasterFeelsAndItsSenseIsAgainstTheSlaves) {
  Law law;
  law.force_scale = 0.5;
  law.passivity.control = false;
  Coupling c = coupled(law);
  for (int i = 1; i < 2000; ++i) c = couple(c, law, {.F_s = {8, 0, 0}}, i);
  EXPECT_NEAR(c.F_d.x(), -4, 1e-9);
}

TEST(HapticCoupling, TakesNoiseForNothing) {
  const Law law;
  EXPECT_EQ(felt(law, {0.2, 0, 0}), Vector3(Vector3::Zero()));
  EXPECT_EQ(felt(law, {0, 7, 0}), Vector3(0, 7, 0));
}

TEST(HapticCoupling, LetsTheForceGrowNoFasterThanASpringAndDropAtOnce) {
  Law law;
  law.passivity.control = false;
  Coupling c = coupled(law);
  c = couple(c, law, {.F_s = {20, 0, 0}}, 1);
  EXPECT_LE(c.F_d.norm(), law.grow_rate * law.macrostep + 1e-12);
  c = couple(c, law, {.x_m = {0.001, 0, 0}, .F_s = {20, 0, 0}}, 2);
  EXPECT_NEAR(c.F_d.norm(), law.grow_stiffness * 0.001 + 2 * law.grow_rate * law.macrostep, 1e-9);
  c = couple(c, law, {.x_m = {0.001, 0, 0}}, 3);
  EXPECT_EQ(c.F_d.norm(), 0);
}

TEST(HapticCoupling, StandsInAPauseAndCatchesUpGentlyAfterIt) {
  const Law law;
  Coupling c = coupled(law);
  const Vector3 away(0.05, 0, 0);
  for (int i = 1; i < 100; ++i) c = couple(c, law, {.x_m = away}, i, 0);
  EXPECT_EQ(c.place, Vector3(Vector3::Zero()));
  for (int i = 100; i < 200; ++i) {
    const Vector3 before = c.place;
    c = couple(c, law, {.x_m = away, .x_s = c.place}, i, 1);
    ASSERT_LE((c.place - before).norm(), law.catch_up * law.macrostep + 1e-12);
  }
}

TEST(HapticCoupling, StaysWithinItsBoundsWhateverIsReported) {
  std::mt19937_64 random(3);
  std::normal_distribution<> normal;
  for (int run = 0; run < 50; ++run) {
    Law law;
    law.channel = {.delay = 0.02 * (run % 10), .jitter = 0.02, .loss = 0.1, .seed = random()};
    Coupling c = coupled(law);
    for (int i = 1; i < 1000; ++i) {
      const auto any = [&](double size) {
        return Vector3(size * Vector3(normal(random), normal(random), normal(random)));
      };
      c = couple(c, law, {.x_m = any(0.1), .x_s = any(0.1), .F_s = any(50)}, i);
      ASSERT_LE(c.F_d.norm(), law.most_force + 1e-9);
      ASSERT_LE(c.v_d.norm(), law.most_speed + 1e-9);
      ASSERT_GE(std::min(c.master.observed(), c.slave.observed()), -law.passivity.start - 1e-9);
    }
  }
}

}  // namespace
}  // namespace mrroc::haptic
