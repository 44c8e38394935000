// The platform's task in processes of its own: grounds and plans that are named, and plants that are not known.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/figures.hpp"
#include "bench/rex_cases.hpp"
#include "bench/rex_drives.hpp"
#include "bench/vision.hpp"

namespace mrroc::bench {
namespace {

using nlohmann::json;
constexpr std::array kHardGrounds{"slippery", "ice_right"};
constexpr std::size_t kPlants = 100;
constexpr double kWorse = 2;  // [mm] rms, with which adaptation counts as harmful

Figures ground_figures(Summaries runs) {
  const Summaries nominal = seeds(runs, 0);
  Figures f{
      {"track_rms_mm", most(nominal, "track_rms_mm"), "mm",
       "figure eight, worst of five seeds, wanted <= 10"},
      {"track_max_mm", most(nominal, "track_max_mm"), "mm", "  at most, wanted <= 40"},
      {"estimate_rms_mm", most(nominal, "estimate_rms_mm"), "mm", "  error of the estimate, wanted <= 8"},
      {"ellipse_95_pct", least(nominal, "ellipse_95_pct"), "%", "  truth within its ellipse, wanted >= 80"},
      {"joint_speed_pct", least(nominal, "joint_speed_pct"), "%", "  speed between fragments, wanted >= 90"},
      {"plan_joint_speed_pct", least(nominal, "plan_joint_speed_pct"), "%",
       "  speed between plans, wanted >= 85"},
      {"ack_before_rest_s", least(nominal, "ack_before_rest_s"), "s",
       "  ack before it stands, wanted >= 0.5"},
      {"real_time_factor", pace(nominal), "", "  wanted >= 5"}};
  for (std::size_t k = 0; k < kHardGrounds.size(); ++k) {
    const Summaries hard = seeds(runs, k + 1);
    const std::string ground = kHardGrounds[k];
    f.push_back(
        {"track_rms_mm_" + ground, most(hard, "track_rms_mm"), "mm", "ground " + ground + ", wanted <= 15"});
    f.push_back({"track_max_mm_" + ground, most(hard, "track_max_mm"), "mm", "  at most"});
  }
  f.push_back({"log_hash_differences", nominal.front().at("log_hash") == runs.back().at("log_hash") ? 0. : 1.,
               "", "one process against separate ones, wanted 0"});
  return f;
}

RexPart grounds() {
  RexPart part{.drives = {}, .figures = ground_figures};
  add_seeds(part.drives, {.timed = true});
  for (const char* ground : kHardGrounds) add_seeds(part.drives, {.more = {"--ground", ground}});
  part.drives.push_back({.seed = 1});  // as the first one, but in one process
  return part;
}

RexPart plans() {
  RexPart part{
      .drives = {}, .figures = [](Summaries runs) {
        return Figures{
            {"track_rms_fast_mm", most(seeds(runs, 0), "track_rms_mm"), "mm",
             "figure eight at 1.3 m/s where curves allow it, wanted <= 15"},
            {"corner_max_mm", most(seeds(runs, 1), "track_max_mm"), "mm", "corner at 0.8 m/s, wanted <= 100"},
            {"pivot_rms_mm", most(seeds(runs, 2), "pivot_rms_mm"), "mm", "turn on the spot, wanted <= 10"}};
      }};
  add_seeds(part.drives, {.more = fast_eight()});
  add_seeds(part.drives, {.more = fast_corner()});
  add_seeds(part.drives, {.more = {"--plan", "pivot"}});
  return part;
}

Figures friction_figures(Summaries runs) {
  const Summaries grounds = runs.first(runs.size() - kSeeds), halved = runs.last(kSeeds);
  return {{"friction_err", most(grounds, "friction_err"), "", "three smooth grounds, worst, wanted <= 0.02"},
          {"split_err", most(grounds, "split_err"), "", "  wanted <= 0.02"},
          {"split_rms", most(grounds, "split_rms"), "", "  of the split at any time"},
          {"friction_found_s", most(halved, "friction_found_s"), "s",
           "after it halves in a curve, wanted <= 1.5"}};
}

/// What the estimator finds where the ground has its own structure.
RexPart frictions() {
  RexPart part{.drives = {}, .figures = friction_figures};
  for (const Arguments& ground : smooth_grounds()) add_seeds(part.drives, {.more = ground});
  add_seeds(part.drives, {.more = halving_ground()});
  return part;
}

/// @param runs  of each plant with adaptation, and without
Figures plant_figures(Summaries runs) {
  int ended = 0, worse = 0;
  std::vector<double> rms, gain;
  for (std::size_t k = 0; k < runs.size(); k += 2) {
    const double adapting = track_rms(runs[k]), fixed = track_rms(runs[k + 1]);
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

RexPart plants() {
  RexPart part{.drives = {}, .figures = plant_figures};
  for (std::uint32_t seed = 1; seed <= kPlants; ++seed) {
    const Arguments plant = random_plant(seed);
    part.drives.push_back({.seed = seed, .more = plant});
    part.drives.push_back({.seed = seed, .more = plant + Arguments{"--set", "platforms.rex.adapt=false"}});
  }
  return part;
}

}  // namespace

Figures run_rex_group(const std::filesystem::path& plots) {
  // Computing times first, while nothing else runs.
  Figures figures = rex_planner_figures();
  const auto add = [&](const Figures& some) { figures.insert(figures.end(), some.begin(), some.end()); };
#ifdef MRROC_REX
  add(rex_kernel_figures());
#endif
  add(figures_of({grounds(), plans(), frictions(), rex_algorithms(plots), plants()}));
  return figures;
}

Figures run_rex_eyes_group() {
  Figures figures = rex_odometry_figures();
  std::ranges::move(figures_of({rex_eyes()}), std::back_inserter(figures));
  return figures;
}

}  // namespace mrroc::bench
