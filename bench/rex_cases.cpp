#include "bench/rex_cases.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "test/tasks/rex_drive/random_plans.hpp"

namespace mrroc::bench {
namespace {

const Arguments& as_fast_as_it_goes() {
  static const Arguments limits{"--set", "task.lateral=1.7", "--set", "task.turn_rate=2.1"};
  return limits;
}

Arguments smooth(const Arguments& more) { return Arguments{"--ground", "smooth"} + more; }

}  // namespace

Arguments fast_eight() { return Arguments{"--speed-mps", "1.3"} + as_fast_as_it_goes(); }

Arguments fast_corner() { return Arguments{"--plan", "corner", "--speed-mps", "0.8"} + as_fast_as_it_goes(); }

std::vector<Arguments> smooth_grounds() {
  return {smooth({}), smooth({"--set", "sim.ground.friction=[0.35, 0.3]"}),
          smooth({"--set", "sim.ground.patches.right.area=[-3, -2, 3, 0]", "--set",
                  "sim.ground.patches.right.scale=0.5"})};
}

Arguments halving_ground() {
  return smooth({"--set", "sim.ground.patches.half.area=[-3, -2, 3, 2]", "--set",
                 "sim.ground.patches.half.scale=0.5", "--set", "sim.ground.patches.half.from=7"});
}

Arguments random_plant(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  Arguments a;
  const auto set = [&](const std::string& what) { a = a + Arguments{"--set", what}; };
  const double friction = between(0.25, 1);
  set(fmt::format("sim.ground.friction=[{:.3f}, {:.3f}]", friction,
                  std::max(0.25, friction * between(0.7, 1))));
  // Patches that do not overlap: the friction is within the same bounds everywhere.
  for (const double side : {-1., 1.}) {
    const double left = side < 0 ? between(-2, -1) : between(0, 1), low = between(-1.3, 0.5);
    const std::string patch = side < 0 ? "left" : "right";
    set(fmt::format("sim.ground.patches.{}.area=[{:.2f}, {:.2f}, {:.2f}, {:.2f}]", patch, left, low,
                    left + between(0.3, 1), low + between(0.3, 1.2)));
    set(fmt::format("sim.ground.patches.{}.scale={:.3f}", patch, between(0.25, 1) / friction));
  }
  const double mass = 40 * between(0.85, 1.15);
  set(fmt::format("sim.platforms.rex.mass={:.2f}", mass));
  set(fmt::format("sim.platforms.rex.inertia={:.3f}", 2.5 * mass / 40));
  set(fmt::format("sim.platforms.rex.centre=[{:.3f}, {:.3f}]", between(-0.06, 0.06), between(-0.06, 0.06)));
  set("sim.platforms.rex.imu.noise=0.01");
  set("sim.platforms.rex.load_cells.noise=0.02");
  set("motion_capture.noise=[0.01, 0.02]");
  return a;
}

RexDrive random_drive(std::uint32_t seed) {
  constexpr int kPoints = 8;
  constexpr double kSpeed = 0.6, kLost = 8;
  std::mt19937 random(1000 + seed);
  RexDrive drive{.seed = seed, .more = random_plant(1000 + seed), .eyes = true};
  const double from = std::uniform_real_distribution<>(3, 12)(random);
  drive.more = drive.more +
               Arguments{"--set", fmt::format("motion_capture.lost=[{:.1f}, {:.1f}]", from, from + kLost)};
  const Plan plan = rex_drive::scattered_plan(random, kPoints, kSpeed);
  for (std::size_t k = 0; k < kPoints; ++k)
    drive.plan += fmt::format("{:.3f} {:.3f}\n", plan.point[k][0], plan.point[k][1]);
  return drive;
}

double track_rms(const nlohmann::json& summary) {
  const double rms = done(summary) ? figure(summary, "track_rms_mm") : kNotMeasured;
  return std::isnan(rms) ? HUGE_VAL : rms;
}

}  // namespace mrroc::bench
