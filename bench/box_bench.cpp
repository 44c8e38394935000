// Two platforms that push a box: twenty seeds of the task as it is built in.
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/side_by_side.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

using nlohmann::json;
constexpr std::size_t kRuns = 20;
constexpr std::size_t kAtATime = 2;

json push(std::size_t k) {
  const ScratchFolder scratch;
  const std::filesystem::path folder = scratch.path() / "run";
  TaskProcess task("box_push",
                   {"--seed", std::to_string(k + 1), "--processes", "one", "--run-dir", folder.string()});
  task.wait();
  return needed_summary(folder);
}

double worst(const std::vector<json>& runs, const std::string& key) {
  double most = 0;
  for (const json& run : runs) most = std::max(most, run.at("figures").at(key).get<double>());
  return most;
}

}  // namespace

Figures run_box_group() {
  const auto runs = side_by_side<json>(kRuns, kAtATime, push, [](std::size_t done) {
    fmt::print(stderr, "box: {} of {} runs\n", done, kRuns);
  });
  const auto done = std::ranges::count_if(runs, [](const json& run) { return run.at("outcome") == "done"; });
  return {
      {"box_done", static_cast<double>(done), "", "runs of 20 seeds that end well, wanted 20"},
      {"box_err_mm", worst(runs, "box_err_mm"), "mm", "box from its goal, the worst of them, wanted <= 30"},
      {"box_err_deg", worst(runs, "box_err_deg"), "degrees", "  turned, wanted <= 5"},
      {"box_pushes", worst(runs, "pushes"), "", "  pushes at most"},
      {"box_run_s", worst(runs, "run_s"), "s", "  time at most"}};
}

}  // namespace mrroc::bench
