#include "bench/arm_limits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "bench/arm_contact.hpp"
#include "mp/gnuplot.hpp"
#include "sim/engine.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kContacts = 100;

/// One kind of plant.
struct Plants {
  const char* name;   // in progress and picture
  std::string key;    // of the figure
  std::string about;  // what was measured
  sim::PhysicsEngine engine;
  Gears gears;
  std::vector<ArmLimit> limits{};
};

/// @param share  0..1 @return the smallest error [%] that this share of the contacts does not exceed
double error_of(const std::vector<ArmLimit>& limits, double share) {
  std::vector<double> errors;
  for (const ArmLimit& l : limits) errors.push_back(100 * std::abs(l.predicted / l.simulated - 1));
  const auto rank = std::ceil(share * static_cast<double>(errors.size()));
  std::ranges::sort(errors);
  return errors[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

/// Predicted over simulated limits; where there is none, twice the predicted one.
void plot(const fs::path& folder, const std::vector<Plants>& all) {
  fs::create_directories(folder);
  std::ofstream table(folder / "stability_arm.csv");
  table << "stiffness,inertia,gears,predicted,simulated,plant\n";
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const ArmLimit& l : all[k].limits)
      table << fmt::format("{:.0f},{:.2f},{:.2f},{:.6f},{:.6f},{}\n", l.stiffness, l.inertia, l.gears,
                           l.predicted, std::min(l.simulated, 2 * l.predicted), k);
  table.close();
  std::ofstream script(folder / "stability_arm.gp");
  script
      << "set terminal pngcairo size 640,600 font 'sans,10'\nset output 'stability_arm.png'\n"
         "set datafile separator ','\nset logscale xy\nset key top left\nset grid\nset size square\n"
         "set xlabel 'simulated limit of B [s/kg]'\nset ylabel 'predicted limit of B [s/kg]'\n"
         "plot x with lines lc 'black' notitle, 1.2*x with lines lc 'gray' title '+- 20 %', x/1.2 with lines "
         "lc 'gray' notitle";
  for (std::size_t k = 0; k < all.size(); ++k)
    script << fmt::format(", 'stability_arm.csv' skip 1 using ($6=={}?$5:1/0):4 with points pt {} title '{}'",
                          k, 2 * k + 5, all[k].name);
  script << '\n';
  script.close();
  if (mp::run_gnuplot(folder, "stability_arm.gp") != mp::GnuplotResult::done)
    fmt::print(stderr, "stability_arm.png was not drawn; see {}\n", (folder / "stability_arm.csv").string());
}

}  // namespace

Figures arm_limit_figures(const fs::path& plots) {
  using enum sim::PhysicsEngine;
  std::vector<Plants> all{{"Bullet", "bullet_limit_err", "in Bullet", bullet, Gears::rigid},
                          {"elastic gears", "elastic_arm_limit_err",
                           "in Bullet with elastic gears of 8 to 15 Hz", bullet, Gears::elastic}};
  if (sim::has_mujoco())
    all.insert(all.begin() + 1, {"MuJoCo", "mujoco_limit_err", "in MuJoCo", mujoco, Gears::rigid});
  Figures figures;
  for (Plants& p : all) {
    p.limits = arm_limits(p.engine, p.gears, p.name, kContacts);
    const std::string about = "predicted limit of the gain B of the whole arm against the real driver " +
                              p.about + ", without friction";
    figures.push_back({p.key + "_pct", error_of(p.limits, 0.95), "%",
                       about + ": 95th percentile of 100 random contacts, wanted <= 20"});
    figures.push_back({p.key + "_median_pct", error_of(p.limits, 0.5), "%", "the same, the median"});
  }
  if (!plots.empty()) plot(plots, all);
  return figures;
}

}  // namespace mrroc::bench
