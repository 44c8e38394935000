// Pairs of master and slave: the prediction of the wall that they bear, random channels, and the task itself.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"
#include "test/tasks/haptic/random_case.hpp"
#include "test/tasks/haptic/random_pair.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kPairs = 200, kCases = 500, kRuns = 20;

/// @return errors of the predicted limits of random pairs [%]
std::vector<double> limit_errors() {
  std::mt19937_64 random(1);
  std::vector<double> errors;
  while (errors.size() < kPairs) {
    const haptic::test::RandomPair pair = haptic::test::random_pair(random);
    const double predicted = edp::pair_stiffness_limit(pair.loop());
    errors.push_back(100 * std::abs(predicted / pair.measured_limit(predicted) - 1));
  }
  return errors;
}

/// What came of random cases, worst.
struct WorstCase {
  double energy{}, given{};
  int growing{};
};

WorstCase random_cases() {
  std::mt19937_64 random(1);
  WorstCase worst;
  for (int n = 0; n < kCases; ++n) {
    const haptic::test::CaseResult r = haptic::test::run_case(haptic::test::random_case(random));
    worst.energy = std::min(worst.energy, r.least_energy);
    worst.given = std::min(worst.given, r.least_given);
    worst.growing += r.grows();
  }
  return worst;
}

/// A run of the task. @return its figures, null when it has not come to its end
nlohmann::json run_of(const fs::path& folder, const std::vector<std::string>& settings) {
  std::vector<std::string> a{"--processes", "one", "--run-dir", folder.string()};
  for (const std::string& s : settings) a.insert(a.end(), {"--set", s});
  TaskProcess task("haptic", a);
  const int status = task.wait();
  const nlohmann::json summary = run_summary(folder);
  fs::remove_all(folder);
  return status == 0 && !summary.is_null() ? summary.at("figures") : nlohmann::json();
}

double number(const nlohmann::json& figures, const char* key) {
  return figures.is_object() && figures.contains(key) && figures.at(key).is_number()
             ? figures.at(key).get<double>()
             : NAN;
}

}  // namespace

Figures run_haptic_group() {
  const std::vector<double> errors = limit_errors();
  const WorstCase worst = random_cases();
  const ScratchFolder scratch;
  const nlohmann::json good = run_of(scratch.path() / "run", {});
  std::mt19937_64 random(1);
  const auto even = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  double least = std::numeric_limits<double>::infinity();
  int failed = 0;
  for (int n = 0; n < kRuns; ++n) {
    const nlohmann::json figures = run_of(
        scratch.path() / "run",
        {fmt::format("seed={}", n + 1), fmt::format("task.delay={:.3f}", even(0, 0.2)),
         fmt::format("task.jitter={:.3f}", even(0, 0.05)), fmt::format("task.loss={:.3f}", even(0, 0.1)),
         fmt::format("table.stiffness={:.0f}", 500 * std::pow(100, even(0, 1))),
         fmt::format("sim.hand.stiffness={:.0f}", even(300, 2000))});
    failed += figures.is_null();
    if (figures.is_object()) least = std::min(least, number(figures, "energy_min_mJ"));
  }
  return {
      {"follow_lag_macrosteps", number(good, "follow_lag_macrosteps"), "",
       "slave behind the master in the air"},
      {"follow_rms_mm", number(good, "follow_rms_mm"), "mm", "their distance"},
      {"reflect_err_pct", number(good, "reflect_err_pct"), "%",
       "force felt less force exerted, in contact, no delay"},
      {"pair_limit_err_pct", std::ranges::max(errors), "%",
       "predicted largest wall against the time domain, worst of 200 random pairs on light servos"},
      {"energy_min_mJ", 1e3 * worst.energy, "mJ",
       "energy of the ports, least of 500 random cases on light servos"},
      {"given_min_mJ", 1e3 * worst.given, "mJ", "energy that hand and wall have given, least of the same"},
      {"haptic_growing", static_cast<double>(worst.growing), "", "growing oscillations in the same"},
      {"haptic_energy_min_mJ", least, "mJ", "energy of the ports, least of 20 random runs of the task"},
      {"haptic_failed", static_cast<double>(failed), "", "of these that have not come to their end"},
  };
}

}  // namespace mrroc::bench
