// Pairs on light servos: predictions against the time domain, and that no channel makes a pair swing.
#include <gtest/gtest.h>

#include "test/edp/contact_simulation.hpp"
#include "test/tasks/haptic/random_case.hpp"
#include "test/tasks/haptic/random_pair.hpp"

namespace mrroc::haptic::test {
namespace {

TEST(HapticPair, BearsWhatIsPredictedWithinAFifth) {
  std::mt19937_64 random(11);
  for (int n = 0; n < 8; ++n) {
    const RandomPair pair = random_pair(random);
    const double predicted = edp::pair_stiffness_limit(pair.loop());
    EXPECT_LE(std::abs(predicted / pair.measured_limit(predicted) - 1), 0.2) << predicted << " N/m";
  }
}

TEST(HapticPair, BearsLessWithMoreDelay) {
  const Law law;
  double before = std::numeric_limits<double>::infinity();
  for (const double delay : {0.0, 0.05, 0.2}) {
    Law late = law;
    late.channel.delay = delay;
    const double limit = edp::pair_stiffness_limit(pair_loop(late, {}, {}));
    EXPECT_LE(limit, before) << delay;
    before = limit;
  }
  EXPECT_LT(before, 5000);
}

TEST(HapticPair, NeverSwingsMoreAndMoreNorMakesEnergyOverAnyChannel) {
  std::mt19937_64 random(21);
  for (int n = 0; n < 60; ++n) {
    const CaseResult r = run_case(random_case(random));
    EXPECT_GE(r.least_energy, -0.001) << n;
    EXPECT_GE(r.least_given, -0.001) << n;
    EXPECT_FALSE(r.grows()) << n;
  }
}

TEST(HapticPair, WouldSwingOverSuchChannelsWithoutTheController) {
  std::mt19937_64 random(21);
  int swing = 0;
  for (int n = 0; n < 60; ++n) {
    RandomCase c = random_case(random);
    c.law.passivity.control = false;
    c.settle();
    swing += run_case(c).late > 1;
  }
  EXPECT_GT(swing, 10);
}

TEST(HapticPair, FeelsTheForceOfTheSlaveAtRestWithoutDelay) {
  for (const double force_scale : {0.25, 0.5, 1.0}) {
    Law law;
    law.force_scale = force_scale;
    const Surroundings around{.wall = 1e4, .wall_damping = 0.002, .wall_at = 0.01};
    law.grows_gently = !edp::pair_settles(pair_loop(law, around, {}), around.wall, 0);
    LightPair pair(law, around);
    for (int i = 0; i < 5000; ++i) pair.macrostep(std::min(0.025, 0.00002 * i));
    EXPECT_GT(pair.slave().reading(), 3);
    EXPECT_NEAR(pair.felt_by_hand(), force_scale * pair.slave().reading(), 0.05 * pair.felt_by_hand());
  }
}

}  // namespace
}  // namespace mrroc::haptic::test
