// The task `move` on random files: set points within limits, and goals that are reached.
#include <fmt/core.h>

#include <algorithm>
#include <random>

#include "bench/figures.hpp"
#include "tasks/move/cell/arm_body.hpp"
#include "tasks/move/config.hpp"
#include "test/rig/random_motions.hpp"

namespace mrroc::bench {

Figures run_trajectory_group() {
  constexpr int kFiles = 1000;
  std::mt19937 random(1);
  int executed = 0, refused = 0, violations = 0, failed = 0;
  double error = 0, speed = 0, acceleration = 0;
  std::string why;  // the first one failed
  for (std::uint64_t seed = 1; executed < kFiles; ++seed) {
    const std::string model = random() % 2 == 0 ? "irb6_track" : "irb6_postument";
    const Config config = any_motion::config_with(any_motion::random_motions(random, model), model);
    any_motion::Plan plan;
    try {
      plan = any_motion::read_plan(config, any_motion::make_arm_body);
      any_motion::rehearse(config, plan);
    } catch (const FaultError&) {
      ++refused;  // beyond a limit: nothing would move
      continue;
    }
    ++executed;
    try {
      const any_motion::Execution e = any_motion::execute(plan.arms[0], model, seed);
      violations += e.violations;
      error = std::max(error, e.goal_error_mm);
      speed = std::max(speed, e.speed);
      acceleration = std::max(acceleration, e.acceleration);
    } catch (const FaultError& e) {
      if (failed++ == 0) why = fmt::format("; file {}: {}", seed, e.what());
    }
  }
  return {{"trajectory_violations", static_cast<double>(violations), "",
           "move: set points of 1,000 random files beyond a limit of speed or acceleration"},
          {"trajectory_goal_err_mm", error, "mm", "  error at rest behind a motion, largest"},
          {"trajectory_failed", static_cast<double>(failed), "",
           "  files that were not executed to their end" + why},
          {"trajectory_refused", static_cast<double>(refused), "", "  random files that were refused before"},
          {"trajectory_speed_pct", 100 * speed, "%", "  speed of the set points, largest share of the limit"},
          {"trajectory_acceleration_pct", 100 * acceleration, "%", "  their acceleration"}};
}

}  // namespace mrroc::bench
