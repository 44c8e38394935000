#include "bench/rex_drives.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <thread>

#include "base/fault.hpp"
#include "bench/run_summary.hpp"
#include "bench/side_by_side.hpp"
#include "bench/task_process.hpp"
#include "bench/vision.hpp"

namespace mrroc::bench {
namespace {

using nlohmann::json;

json drive(const RexDrive& d) {
  const ScratchFolder scratch;
  const std::filesystem::path folder = scratch.path() / "run";
  Arguments arguments{"--seed",    std::to_string(d.seed), "--processes", d.timed ? "separate" : "one",
                      "--run-dir", folder.string(),        "--eyes",      d.eyes ? "on" : "off"};
  arguments.insert(arguments.end(), d.more.begin(), d.more.end());
  if (!d.plan.empty()) {
    const std::filesystem::path plan = scratch.path() / "plan.txt";
    std::ofstream(plan) << d.plan;
    arguments.insert(arguments.end(), {"--plan", plan.string()});
  }
  TaskProcess task("rex_drive", arguments);
  task.wait();
  return needed_summary(folder);
}

/// A drive is one process, and its parts take turns.
std::size_t drives_at_a_time() { return std::max(2U, (std::thread::hardware_concurrency() + 1) / 2); }

/// How many drives are done, and how long that took.
class Progress {
 public:
  explicit Progress(std::size_t all) : all_(all) {}
  void add() {
    const auto passed = std::chrono::steady_clock::now() - begun_;
    fmt::print(stderr, "rex: {} of {} drives, {:.0f} s\n", ++done_, all_,
               std::chrono::duration<double>(passed).count());
  }

 private:
  std::size_t all_;
  std::size_t done_{};
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

std::vector<double> all(Summaries runs, const std::string& key) {
  std::vector<double> values;
  for (const json& s : runs) values.push_back(figure(s, key));
  return values;
}
bool is_measured(const std::vector<double>& values) {
  return std::ranges::none_of(values, [](double x) { return std::isnan(x); });
}

}  // namespace

bool done(const json& summary) { return summary.at("outcome") == "done"; }

Arguments operator+(Arguments a, const Arguments& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void add_seeds(std::vector<RexDrive>& drives, const RexDrive& like, std::size_t count) {
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    drives.push_back(like);
    drives.back().seed = seed;
  }
}

Summaries seeds(Summaries runs, std::size_t k) { return runs.subspan(k * kSeeds, kSeeds); }

double figure(const json& summary, const std::string& key) {
  if (!done(summary))
    throw FaultError(FaultCode::internal_error, fmt::format("rex_drive: no {} could be measured", key));
  const json value = summary.at("figures").value(key, json());
  return value.is_number() ? value.get<double>() : kNotMeasured;
}

double most(Summaries runs, const std::string& key) {
  const std::vector<double> values = all(runs, key);
  return is_measured(values) ? std::ranges::max(values) : kNotMeasured;
}

double least(Summaries runs, const std::string& key) {
  const std::vector<double> values = all(runs, key);
  return is_measured(values) ? std::ranges::min(values) : kNotMeasured;
}

double pace(Summaries runs) {
  std::vector<double> paces;
  for (const json& s : runs) paces.push_back(s.at("real_time_factor").get<double>());
  return quantile(paces, 0.5);
}

Figures figures_of(const std::vector<RexPart>& parts) {
  std::vector<const RexDrive*> all;
  for (const RexPart& part : parts)
    for (const RexDrive& d : part.drives) all.push_back(&d);
  Progress progress(all.size());
  std::map<const RexDrive*, json> summaries;
  for (const bool timed : {true, false}) {
    std::vector<const RexDrive*> some;
    std::ranges::copy_if(all, std::back_inserter(some), [&](const RexDrive* d) { return d->timed == timed; });
    const std::vector<json> driven = side_by_side<json>(
        some.size(), timed ? 1 : drives_at_a_time(), [&](std::size_t k) { return drive(*some[k]); },
        [&](std::size_t) { progress.add(); });
    for (std::size_t k = 0; k < some.size(); ++k) summaries[some[k]] = driven[k];
  }
  Figures figures;
  for (const RexPart& part : parts) {
    std::vector<json> of_part;
    for (const RexDrive& d : part.drives) of_part.push_back(summaries.at(&d));
    std::ranges::move(part.figures(of_part), std::back_inserter(figures));
  }
  return figures;
}

}  // namespace mrroc::bench
