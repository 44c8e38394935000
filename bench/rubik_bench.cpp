// The task of the cube from vision to the verified solved cube, over seeds: a long run that can be resumed.
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/text_file.hpp"
#include "bench/figures.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kCubes = 20;

/// Where the summaries of cubes are kept, beside the runs of tasks.
fs::path file_of(int seed) { return fs::path("runs") / "bench-rubik" / fmt::format("seed-{}.json", seed); }

json read(const fs::path& file) {
  std::ifstream in(file);
  json summary = json::parse(in, nullptr, false);
  return summary.is_discarded() ? json{} : summary;
}

/// Solves the cube of one seed. @return summary.json; empty when there is none
json solve(int seed) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "run";
  TaskProcess task("rubik", {"--seed", fmt::to_string(seed), "--processes", "separate", "--set",
                             "cameras.profile=fast", "--run-dir", folder.string()});
  task.wait();
  json summary = read(folder / "summary.json");
  fs::create_directories(file_of(seed).parent_path());
  write_text_file(file_of(seed), summary.dump(1) + "\n");
  return summary;
}

double number(const json& summary, const char* key) {
  const auto found = summary.find(key);
  return found != summary.end() && found->is_number() ? found->get<double>() : 0;
}

}  // namespace

Figures run_rubik_group(bool resume) {
  double solved = 0, turns = 0, seconds = 0, retries = 0, regrasps = 0, sim_s = 0, wall_s = 0, squeeze = 0;
  for (int seed = 1; seed <= kCubes; ++seed) {
    const json known = resume ? read(file_of(seed)) : json{};
    const json summary = known.empty() ? solve(seed) : known;
    const json figures = summary.value("figures", json::object());
    const bool good = summary.value("outcome", "") == "done" && number(figures, "solved") == 1;
    std::fprintf(stderr, "rubik: cube %d of %d, %s, %.0f s simulated in %.0f s\n", seed, kCubes,
                 good ? "solved" : "NOT SOLVED", number(summary, "sim_s"), number(summary, "wall_s"));
    solved += good;
    turns += number(figures, "moves");
    seconds += number(figures, "moves") * number(figures, "sim_s_per_turn");
    retries += number(figures, "retries");
    regrasps += number(figures, "regrasps");
    sim_s += number(summary, "sim_s");
    wall_s += number(summary, "wall_s");
    squeeze = std::max(squeeze, number(figures, "squeeze_N"));
  }
  return {
      {"solved_of_20", solved, "", "random scrambles of 20 turns, from vision to verified, wanted 20"},
      {"sim_s_per_turn", turns > 0 ? seconds / turns : 0, "s", "re-grasps included, wanted <= 30"},
      {"regrasps_per_turn", turns > 0 ? regrasps / turns : 0, "", "cycles without a turn"},
      {"rubik_retries", retries, "", "of grips and turns, all cubes"},
      {"rubik_squeeze_N", squeeze, "N", "of a pad or palm on the cube, largest"},
      {"real_time_factor", wall_s > 0 ? sim_s / wall_s : 0, "x",
       "whole task, separate processes, wanted >= 1.2"},
  };
}

}  // namespace mrroc::bench
