// The task ball over objects, palms and places.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kRuns = 100;

/// What nobody tells the coordinator. Friction bears at least 1.3 times the weight, as the task demands of what it is told.
struct CarriedObject {
  bool box;
  double mass, friction, size, stiffness;  // [kg], [m], of the palms [N/m]
  double x, y, z;                          // by which it stands elsewhere [m]
};

CarriedObject object_of(unsigned seed) {
  constexpr double kForce = 12.5, kMargin = 1.3, kGravity = 9.81;
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
  };
  CarriedObject o{.box = seed % 2 == 0,
                  .mass = between(0.15, 1.1),
                  .friction = between(0.4, 1.2),
                  .size = between(0.18, 0.22),
                  .stiffness = std::exp(between(std::log(2000), std::log(30000))),
                  .x = between(-0.015, 0.015),
                  .y = between(-0.01, 0.01),
                  .z = between(-0.01, 0.01)};
  o.mass = std::min(o.mass, 2 * o.friction * kForce / (kMargin * kGravity));
  return o;
}

std::vector<std::string> arguments(const fs::path& folder, unsigned seed, const CarriedObject& o) {
  std::vector<std::string> a{"--seed",    std::to_string(seed), "--processes", "one",
                             "--run-dir", folder.string(),      "--object",    o.box ? "box" : "ball"};
  const auto set = [&](const std::string& what) { a.insert(a.end(), {"--set", what}); };
  set(fmt::format("sim.free_body.mass={:.4f}", o.mass));
  set(fmt::format("sim.free_body.friction={:.4f}", o.friction));
  set(fmt::format("sim.free_body.size={:.4f}", o.size));
  set(fmt::format("sim.free_body.offset=[{:.4f}, {:.4f}, {:.4f}]", o.x, o.y, o.z));
  set(fmt::format("sim.palm.stiffness={:.1f}", o.stiffness));
  return a;
}

/// Least and largest value of a figure over the runs.
struct Spread {
  double least{HUGE_VAL}, largest{-HUGE_VAL};

  void take(const nlohmann::json& figures, const char* key) {
    if (!figures.contains(key) || !figures.at(key).is_number()) return;
    const double x = figures.at(key).get<double>();
    least = std::min(least, x);
    largest = std::max(largest, x);
  }
};

}  // namespace

Figures run_ball_group() {
  const ScratchFolder scratch;
  Spread force, circle, turned;
  double failed = 0, falls = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const fs::path folder = scratch.path() / "run";
    TaskProcess task("ball", arguments(folder, seed, object_of(seed)));
    failed += task.wait() != 0;
    const nlohmann::json summary = run_summary(folder);
    if (!summary.is_null()) {
      const nlohmann::json& figures = summary.at("figures");
      force.take(figures, "inner_force_N");
      circle.take(figures, "circle_rms_mm");
      turned.take(figures, "turned_deg");
      falls += figures.value("falls", 1.0);
    }
    fs::remove_all(folder);
  }
  const std::string runs = fmt::format("of {} runs of ball over objects, palms and places", kRuns);
  const double farther =
      std::abs(force.least - 12.5) > std::abs(force.largest - 12.5) ? force.least : force.largest;
  return {{"ball_falls", falls, "", runs + ", those in which the object fell"},
          {"ball_failed", failed, "", runs + ", those that did not end well"},
          {"inner_force_N", farther, "N", "mean inner force, the farthest from 12.5 N"},
          {"circle_rms_mm", circle.largest, "mm rms", "the object off the circle, worst"},
          {"ball_turned_deg", turned.largest, "deg", "the object turned between the palms, worst"}};
}

}  // namespace mrroc::bench
