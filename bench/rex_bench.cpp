// The platform's task in processes of its own: grounds and plans that are named, and plants that are not known.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"
#include "bench/vision.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Arguments = std::vector<std::string>;

constexpr int kSeeds = 5;
constexpr int kPlants = 100;
constexpr double kWorse = 2;  // [mm] rms, with which adaptation counts as harmful

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// One run to its end. @return its summary
json drive(std::uint32_t seed, const Arguments& more, const std::string& processes = "separate") {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "run";
  TaskProcess task("rex_drive", Arguments{"--seed", std::to_string(seed), "--processes", processes,
                                          "--run-dir", folder.string()} +
                                    more);
  task.wait();
  return needed_summary(folder);
}

bool done(const json& summary) { return summary.at("outcome") == "done"; }

/// @throws FaultError internal_error: the run did not end well, or has no such figure
double figure(const json& summary, const std::string& key) {
  const json value = summary.at("figures").value(key, json());
  if (!done(summary) || !value.is_number())
    throw FaultError(FaultCode::internal_error, fmt::format("rex_drive: no {} could be measured", key));
  return value.get<double>();
}

/// Runs of seeds 1 to kSeeds.
class Runs {
 public:
  explicit Runs(const Arguments& arguments) {
    for (std::uint32_t seed = 1; seed <= kSeeds; ++seed) summaries_.push_back(drive(seed, arguments));
  }
  [[nodiscard]] double most(const std::string& key) const { return std::ranges::max(all(key)); }
  [[nodiscard]] double least(const std::string& key) const { return std::ranges::min(all(key)); }
  [[nodiscard]] double pace() const {
    std::vector<double> paces;
    for (const json& s : summaries_) paces.push_back(s.at("real_time_factor").get<double>());
    return quantile(paces, 0.5);
  }

 private:
  [[nodiscard]] std::vector<double> all(const std::string& key) const {
    std::vector<double> values;
    for (const json& s : summaries_) values.push_back(figure(s, key));
    return values;
  }
  std::vector<json> summaries_;
};

Figures ground_figures() {
  const Runs nominal({});
  Figures f{
      {"track_rms_mm", nominal.most("track_rms_mm"), "mm", "figure eight, worst of five seeds, wanted <= 10"},
      {"track_max_mm", nominal.most("track_max_mm"), "mm", "  at most, wanted <= 40"},
      {"estimate_rms_mm", nominal.most("estimate_rms_mm"), "mm", "  error of the estimate, wanted <= 8"},
      {"ellipse_95_pct", nominal.least("ellipse_95_pct"), "%", "  truth within its ellipse, wanted >= 80"},
      {"joint_speed_pct", nominal.least("joint_speed_pct"), "%", "  speed between fragments, wanted >= 90"},
      {"plan_joint_speed_pct", nominal.least("plan_joint_speed_pct"), "%",
       "  speed between plans, wanted >= 85"},
      {"ack_before_rest_s", nominal.least("ack_before_rest_s"), "s", "  ack before it stands, wanted >= 0.5"},
      {"real_time_factor", nominal.pace(), "", "  wanted >= 5"}};
  for (const std::string ground : {"slippery", "ice_right"}) {
    const Runs runs({"--ground", ground});
    f.push_back(
        {"track_rms_mm_" + ground, runs.most("track_rms_mm"), "mm", "ground " + ground + ", wanted <= 15"});
    f.push_back({"track_max_mm_" + ground, runs.most("track_max_mm"), "mm", "  at most"});
  }
  return f;
}

Figures plan_figures() {
  return {{"track_rms_fast_mm",
           Runs({"--speed-mps", "1.3", "--set", "task.lateral=1.7", "--set", "task.turn_rate=2.1"})
               .most("track_rms_mm"),
           "mm", "figure eight at 1.3 m/s where curves allow it, wanted <= 15"},
          {"corner_max_mm",
           Runs({"--plan", "corner", "--speed-mps", "0.8", "--set", "task.lateral=1.7", "--set",
                 "task.turn_rate=2.1"})
               .most("track_max_mm"),
           "mm", "corner at 0.8 m/s, wanted <= 100"},
          {"pivot_rms_mm", Runs({"--plan", "pivot"}).most("pivot_rms_mm"), "mm",
           "turn on the spot, wanted <= 10"}};
}

/// What the estimator finds where the ground has its own structure.
Figures friction_figures() {
  double friction = 0, split = 0;
  for (const Arguments& ground : {Arguments{}, Arguments{"--set", "sim.ground.friction=[0.35, 0.3]"},
                                  Arguments{"--set", "sim.ground.patches.right.area=[-3, -2, 3, 0]", "--set",
                                            "sim.ground.patches.right.scale=0.5"}}) {
    const Runs runs(Arguments{"--ground", "smooth"} + ground);
    friction = std::max(friction, runs.most("friction_err"));
    split = std::max(split, runs.most("split_err"));
  }
  // The whole ground, while the platform is in a curve.
  const Runs halved({"--ground", "smooth", "--set", "sim.ground.patches.half.area=[-3, -2, 3, 2]", "--set",
                     "sim.ground.patches.half.scale=0.5", "--set", "sim.ground.patches.half.from=7"});
  return {{"friction_err", friction, "", "three smooth grounds, worst, wanted <= 0.02"},
          {"split_err", split, "", "  wanted <= 0.02"},
          {"friction_found_s", halved.most("friction_found_s"), "s",
           "after it halves in a curve, wanted <= 1.5"}};
}

/// A plant that the driver does not know.
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

/// Those of a plant that end well have a figure; one that does not is worse than any.
double track_rms(const json& summary) { return done(summary) ? figure(summary, "track_rms_mm") : HUGE_VAL; }

Figures plant_figures() {
  int ended = 0, worse = 0;
  std::vector<double> rms, gain;
  for (std::uint32_t seed = 1; seed <= kPlants; ++seed) {
    const Arguments plant = random_plant(seed);
    const double adapting = track_rms(drive(seed, plant, "one"));
    const double fixed =
        track_rms(drive(seed, plant + Arguments{"--set", "platforms.rex.adapt=false"}, "one"));
    ended += std::isfinite(adapting) ? 1 : 0;
    worse += adapting > fixed + kWorse ? 1 : 0;
    rms.push_back(adapting);
    if (std::isfinite(adapting) && std::isfinite(fixed)) gain.push_back(fixed - adapting);
  }
  return {{"random_plants_done_pct", 100.0 * ended / kPlants, "%",
           "plants with other friction, patches, mass, centre, noise, wanted 100"},
          {"random_plants_rms95_mm", quantile(rms, 0.95), "mm", "  95 % of them below, wanted <= 40"},
          {"random_plants_rms50_mm", quantile(rms, 0.5), "mm", "  half of them below"},
          {"adaptation_worse", static_cast<double>(worse), "",
           fmt::format("  those that a fixed model drives better by more than {} mm, wanted 0", kWorse)},
          {"adaptation_gain_mm", gain.empty() ? 0 : quantile(gain, 0.5), "mm",
           "  what adaptation gains, median"}};
}

Figures same_bits_figures() {
  const json separate = drive(1, {}), one = drive(1, {}, "one");
  return {{"log_hash_differences", separate.at("log_hash") == one.at("log_hash") ? 0. : 1., "",
           "one process against separate ones, wanted 0"}};
}

}  // namespace

Figures run_rex_group(const fs::path& plots) {
  Figures all;
  const auto add = [&](const Figures& some) { all.insert(all.end(), some.begin(), some.end()); };
  add(ground_figures());
  add(plan_figures());
  add(friction_figures());
  add(same_bits_figures());
  add(rex_planner_figures());
  add(rex_odometry_figures());
#ifdef MRROC_REX
  add(rex_kernel_figures());
#endif
  add(rex_algorithm_figures(plots));
  add(plant_figures());
  return all;
}

}  // namespace mrroc::bench
