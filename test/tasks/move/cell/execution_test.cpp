// Random files on the simulated arms; the benchmark executes a thousand.
#include <gtest/gtest.h>

#include "tasks/move/cell/arm_body.hpp"
#include "tasks/move/config.hpp"
#include "test/rig/random_motions.hpp"

namespace mrroc::any_motion {
namespace {

TEST(MoveExecution, WhatPassesTheRehearsalIsExecutedWithinAllLimitsAndReachesItsGoals) {
  std::mt19937 random(3);
  int executed = 0, refused = 0;
  for (std::uint64_t seed = 1; executed < 25 && refused < 100; ++seed) {
    const std::string model = seed % 2 == 0 ? "irb6_track" : "irb6_postument";
    const std::string file = random_motions(random, model);
    SCOPED_TRACE(file);
    const Config config = config_with(file, model);
    Plan plan;
    try {
      plan = read_plan(config, make_arm_body);
      rehearse(config, plan);
    } catch (const ConfigError& e) {
      FAIL() << e.what();
    } catch (const FaultError&) {
      ++refused;
      continue;
    }
    ++executed;
    Execution e;
    ASSERT_NO_THROW(e = execute(plan.arms[0], model, seed));
    EXPECT_EQ(e.violations, 0);
    EXPECT_LE(e.goal_error_mm, 0.1);
  }
  EXPECT_EQ(executed, 25);
}

}  // namespace
}  // namespace mrroc::any_motion
