// Trackers and estimators of the platform against each other: one is exchanged, nothing else changes (paper REX, sec. 1).
#include <fmt/core.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "base/gnuplot_text.hpp"
#include "bench/rex_drives.hpp"
#include "mp/gnuplot.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::array kTrackers{"nmpc", "kinematic"};
constexpr std::array kEstimators{"mhe", "ekf"};
constexpr std::array kGrounds{"nominal", "slippery", "ice_right"};

/// What a pair of algorithms reaches on one ground.
struct Reached {
  std::string tracker, estimator, ground;
  double track{}, estimate{};  ///< [mm] rms; NaN: the run did not end well
};

double number(const nlohmann::json& summary, const char* key) {
  const nlohmann::json value =
      summary.value("figures", nlohmann::json::object()).value(key, nlohmann::json());
  return value.is_number() ? value.get<double>() : std::nan("");
}

/// Bars: a group per ground, one bar per pair of algorithms.
void plot(const fs::path& folder, const std::vector<Reached>& all) {
  fs::create_directories(folder);
  std::ofstream table(folder / "algorithms.csv");
  table << "ground";
  for (const char* tracker : kTrackers)
    for (const char* estimator : kEstimators)
      table << fmt::format(",track {0} {1},estimate {0} {1}", tracker, estimator);
  for (const char* ground : kGrounds) {
    table << "\n" << ground;
    for (const Reached& r : all)
      if (r.ground == ground) table << fmt::format(",{:.3f},{:.3f}", r.track, r.estimate);
  }
  table << "\n";
  std::ofstream script(folder / "algorithms.gp");
  script << gnuplot_head("algorithms.png", 1000, 800)
         << "set style data histograms\nset style histogram clustered gap 1.5\nset style fill solid 0.85 "
            "border -1\n"
            "set xtics nomirror noenhanced\nset yrange [0:*]\nset key outside bottom center horizontal\n"
            "set multiplot layout 2,1\n";
  for (const auto& [title, first] :
       {std::pair{"true place against the reference", 2}, {"true place against the estimate", 3}}) {
    script << fmt::format("set title {}\nset ylabel 'mm rms'\nplot ", gnuplot_quoted(title));
    int column = first;
    std::size_t colour = 0;
    for (const char* tracker : kTrackers)
      for (const char* estimator : kEstimators) {
        script << fmt::format(
            "{}'algorithms.csv' every ::1 using {}:xtic(1) title {} lc rgb '{}'", colour > 0 ? ", " : "",
            column, gnuplot_quoted(fmt::format("{}, {}", tracker, estimator)), curve_colour(colour));
        column += 2;
        ++colour;
      }
    script << "\n";
  }
  script << "unset multiplot\n";
  table.close();
  script.close();
  if (!table || !script) throw FaultError(FaultCode::cannot_write, (folder / "algorithms.gp").string());
  if (mp::run_gnuplot(folder, "algorithms.gp") == mp::GnuplotResult::failed)
    fmt::print(stderr, "warning: gnuplot did not draw {}; see gnuplot.log beside it\n",
               (folder / "algorithms.gp").string());
}

/// All pairs of algorithms on all grounds, in the order of the drives.
std::vector<Reached> pairs() {
  std::vector<Reached> all;
  for (const char* tracker : kTrackers)
    for (const char* estimator : kEstimators)
      for (const char* ground : kGrounds) all.push_back({tracker, estimator, ground});
  return all;
}

Figures figures_of_pairs(const fs::path& plots, Summaries runs) {
  std::vector<Reached> all = pairs();
  Figures figures;
  for (std::size_t k = 0; k < all.size(); ++k) {
    Reached& r = all[k];
    r.track = number(runs[k], "track_rms_mm");
    r.estimate = number(runs[k], "estimate_rms_mm");
    const std::string key = fmt::format("{}_{}_{}", r.tracker, r.estimator, r.ground);
    figures.push_back({"track_rms_mm_" + key, r.track, "mm",
                       fmt::format("{}, {} on {} ground", r.tracker, r.estimator, r.ground)});
    figures.push_back({"estimate_rms_mm_" + key, r.estimate, "mm", "  of its estimate"});
  }
  if (!plots.empty()) plot(plots, all);
  return figures;
}

}  // namespace

RexPart rex_algorithms(const fs::path& plots) {
  RexPart part{.drives = {}, .figures = [plots](Summaries runs) { return figures_of_pairs(plots, runs); }};
  for (const Reached& r : pairs())
    part.drives.push_back(
        {.more = {"--tracker", r.tracker, "--estimator", r.estimator, "--ground", r.ground}});
  return part;
}

}  // namespace mrroc::bench
