// The task guide over its fixtures and over hands.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

/// A hand and forearm.
struct GuidingHand {
  double stiffness{}, damping{}, mass{};  // [N/m], [N s/m], [kg]
  double tremor{}, frequency{}, speed{};  // [m], [Hz], [m/s]
};

// Soft and stiff, light and heavy, calm and trembling: corners and the middle of what hands are.
constexpr std::array kHands{
    GuidingHand{1000, 30, 1.0, 1e-4, 8, 0.04}, GuidingHand{300, 10, 0.4, 5e-5, 12, 0.05},
    GuidingHand{300, 20, 2.5, 1e-3, 4, 0.02},  GuidingHand{2000, 40, 0.4, 1e-3, 12, 0.03},
    GuidingHand{2000, 80, 2.5, 3e-4, 8, 0.05}, GuidingHand{800, 20, 0.0, 1e-3, 6, 0.04},
};
// A square whose corners are rounded by the task, and an eight that crosses itself.
constexpr std::array kFixtures{"fixture=line", "fixture=plane", "fixture=circle",
                               "curve=[-40,-40,40,-40,40,40,-40,40,-40,-40]",
                               "curve=[-45,0,-20,30,0,0,20,-30,45,0,20,30,0,0,-20,-30,-45,0]"};

std::vector<std::string> arguments(const fs::path& folder, const std::string& fixture,
                                   const GuidingHand& hand) {
  std::vector<std::string> a{"--seed", "1", "--processes", "one", "--run-dir", folder.string()};
  const auto set = [&](const std::string& what) { a.insert(a.end(), {"--set", what}); };
  if (fixture.starts_with("curve")) set("task.fixture=curve");
  set("task." + fixture);
  set(fmt::format("sim.hand.stiffness={:.1f}", hand.stiffness));
  set(fmt::format("sim.hand.damping={:.1f}", hand.damping));
  set(fmt::format("sim.hand.mass={:.2f}", hand.mass));
  set(fmt::format("sim.hand.tremor={:.6f}", hand.tremor));
  set(fmt::format("sim.hand.tremor_frequency={:.1f}", hand.frequency));
  set(fmt::format("operator.speed={:.3f}", hand.speed));
  return a;
}

/// A figure's worst value so far, and where.
struct WorstFigure {
  std::string key, unit, about;
  bool least{};  // the smaller the worse
  double value{std::nan("")};
  std::string where{};

  void take(const nlohmann::json& figures, const std::string& run) {
    if (!figures.contains(key) || !figures.at(key).is_number()) return;
    const double x = figures.at(key).get<double>();
    if (!std::isnan(value) && (least ? x >= value : x <= value)) return;
    value = x;
    where = run;
  }
};

}  // namespace

Figures run_guide_group() {
  const ScratchFolder scratch;
  std::array worst{
      WorstFigure{"fixture_dev_mm", "mm", "off the fixture"},
      WorstFigure{"compliance_mm_per_10N", "mm", "the same per 10 N across"},
      WorstFigure{"across_force_N", "N", "force across"},
      WorstFigure{"fixture_drag_N", "N", "force needed along"},
      WorstFigure{"entry_step_mm", "mm", "motion in a step while it takes hold or lets go"},
      WorstFigure{"least_energy_mJ", "mJ", "energy that the hand has given, least", true},
  };
  int failed = 0;
  for (const char* const fixture : kFixtures)
    for (const GuidingHand& hand : kHands) {
      const fs::path folder = scratch.path() / "run";
      TaskProcess task("guide", arguments(folder, fixture, hand));
      failed += task.wait() != 0;
      const nlohmann::json summary = run_summary(folder);
      if (!summary.is_null())
        for (WorstFigure& figure : worst)
          figure.take(summary.at("figures"),
                      fmt::format("{}, hand of {:g} N/m, {:g} kg, tremor {:g} mm", fixture, hand.stiffness,
                                  hand.mass, 1e3 * hand.tremor));
      fs::remove_all(folder);
    }
  Figures figures{{"fixture_failed", static_cast<double>(failed), "",
                   fmt::format("of {} runs of guide over fixtures and hands, those that did not end well",
                               kFixtures.size() * kHands.size())}};
  for (const WorstFigure& f : worst)
    figures.push_back({f.key, f.value, f.unit, fmt::format("{}, worst of them: {}", f.about, f.where)});
  return figures;
}

}  // namespace mrroc::bench
