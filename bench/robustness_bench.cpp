// The drawing task over the stiffness of the paper and of the hand that teaches.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"
#include "tasks/drawing/figure_info.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::array kPaper{2e3, 5e3, 1e4, 2e4, 3e4};  // [N/m]
constexpr std::array kHand{500., 1000.};               // [N/m]

std::vector<std::string> arguments(const fs::path& folder, double paper, double hand) {
  std::vector<std::string> a{"--seed", "1", "--processes", "one", "--run-dir", folder.string()};
  const auto set = [&](const std::string& what) { a.insert(a.end(), {"--set", what}); };
  set(fmt::format("sim.paper.stiffness={:.1f}", paper));
  set(fmt::format("sim.hand.stiffness={:.1f}", hand));
  return a;
}

/// How far a number lies beyond what is wanted; negative: it is as wanted.
double excess(const mp::FigureInfo& info, double x) { return std::max(info.low - x, x - info.high); }

/// A figure that has a bar: its worst value so far, and where.
struct Worst {
  double value{}, excess{-HUGE_VAL};
  std::string where;
};

void take(const json& figures, const std::string& where, std::map<std::string, Worst>& worst) {
  for (const mp::FigureInfo& info : drawing::kFigures) {
    const std::string key(info.key);
    if (mp::wanted(info).empty() || !figures.contains(key)) continue;
    const json& values = figures.at(key);
    for (const json& x : values.is_array() ? values : json::array({values})) {
      const double beyond = x.is_number() ? excess(info, x.get<double>()) : HUGE_VAL;
      if (beyond > worst[key].excess)
        worst[key] = {x.is_number() ? x.get<double>() : std::nan(""), beyond, where};
    }
  }
}

}  // namespace

Figures run_robustness_group() {
  const ScratchFolder scratch;
  std::map<std::string, Worst> worst;
  int failed = 0;
  for (const double paper : kPaper)
    for (const double hand : kHand) {
      const fs::path folder = scratch.path() / "run";
      TaskProcess task("drawing", arguments(folder, paper, hand));
      failed += task.wait() != 0;
      const json summary = run_summary(folder);
      if (!summary.is_null())
        take(summary.at("figures"), fmt::format("paper {:g}, hand {:g} N/m", paper, hand), worst);
      fs::remove_all(folder);
    }
  Figures figures{
      {"robust_failed", static_cast<double>(failed), "",
       fmt::format("of {} drawings over the stiffness of paper and hand, those that did not end well",
                   kPaper.size() * kHand.size())}};
  for (const mp::FigureInfo& info : drawing::kFigures)
    if (const auto it = worst.find(std::string(info.key)); it != worst.end())
      figures.push_back({"robust_" + it->first, it->second.value, std::string(info.unit),
                         fmt::format("worst of them, at {}; wanted {}", it->second.where, mp::wanted(info))});
  return figures;
}

}  // namespace mrroc::bench
