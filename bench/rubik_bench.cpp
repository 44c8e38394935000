// The task of the cube from vision to the verified solved cube, over seeds: a long run that can be resumed.
#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "base/program.hpp"
#include "base/text_file.hpp"
#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kCubes = 20;
constexpr std::array kPrograms{"rubik", "ecp_rubik", "edp_irb6", "simulator", "vsp_cube_face"};

/// @return what tells the programs of this build from those of another one
std::string programs() {
  std::string all;
  for (const char* name : kPrograms) {
    const fs::path file = program_folder() / name;
    const auto changed = fs::last_write_time(file).time_since_epoch();
    all += fmt::format("{} {} {}\n", name, fs::file_size(file),
                       std::chrono::duration_cast<std::chrono::seconds>(changed).count());
  }
  return all;
}

/// Where the summaries of cubes are kept, beside the runs of tasks.
fs::path file_of(int seed) { return fs::path("runs") / "bench-rubik" / fmt::format("seed-{}.json", seed); }

json read(const fs::path& file) {
  std::ifstream in(file);
  json summary = json::parse(in, nullptr, false);
  return summary.is_discarded() ? json{} : summary;
}

/// @return the kept summary of a seed, if the same programs have made it
json kept(int seed) {
  json summary = read(file_of(seed));
  return summary.value("programs", "") == programs() ? summary : json{};
}

/// Solves the cube of one seed. @return summary.json; empty when there is none
json solve(int seed) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "run";
  TaskProcess task("rubik", {"--seed", std::to_string(seed), "--processes", "separate", "--set",
                             "cameras.profile=fast", "--run-dir", folder.string()});
  task.wait();
  json summary = run_summary(folder);
  if (!summary.empty()) summary["programs"] = programs();
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
  double solved = 0, turns = 0, seconds = 0, retries = 0, regrasps = 0, sim_s = 0, wall_s = 0;
  std::map<std::string, double> worst;  // of all cubes
  for (int seed = 1; seed <= kCubes; ++seed) {
    const json known = resume ? kept(seed) : json{};
    const json summary = known.empty() ? solve(seed) : known;
    const json figures = summary.value("figures", json::object());
    const bool good = summary.value("outcome", "") == "done" && number(figures, "solved") == 1;
    std::fprintf(stderr, "rubik: cube %d of %d, %s, %.0f s simulated in %.0f s\n", seed, kCubes,
                 good ? "solved" : "NOT SOLVED", number(summary, "sim_s"), number(summary, "wall_s"));
    if (!good) continue;
    ++solved;
    turns += number(figures, "moves");
    seconds += number(figures, "moves") * number(figures, "sim_s_per_turn");
    retries += number(figures, "retries");
    regrasps += number(figures, "regrasps");
    sim_s += number(summary, "sim_s");
    wall_s += number(summary, "wall_s");
    for (const char* key :
         {"turn_lateral_peak_N", "turn_lateral_std_N", "turn_angle_err_deg", "turn_slip_mm", "squeeze_N"})
      worst[key] = std::max(worst[key], number(figures, key));
  }
  return {
      {"solved_of_20", solved, "", "random scrambles of 20 turns, from vision to verified, wanted 20"},
      {"sim_s_per_turn", turns > 0 ? seconds / turns : 0, "s", "re-grasps included, wanted <= 30"},
      {"regrasps_per_turn", turns > 0 ? regrasps / turns : 0, "", "cycles without a turn"},
      {"rubik_retries", retries, "", "of grips and turns, all cubes"},
      {"rubik_lateral_peak_N", worst["turn_lateral_peak_N"], "N", "x, y, z of the track arm while it turns"},
      {"rubik_lateral_std_N", worst["turn_lateral_std_N"], "N", "their largest standard deviation in a turn"},
      {"rubik_angle_err_deg", worst["turn_angle_err_deg"], "deg",
       "face behind tool before its seat, largest"},
      {"rubik_slip_mm", worst["turn_slip_mm"], "mm", "of the cube in the track arm's jaws while it turns"},
      {"rubik_squeeze_N", worst["squeeze_N"], "N", "of a pad or palm on the cube, largest"},
      {"real_time_factor", wall_s > 0 ? sim_s / wall_s : 0, "x",
       "whole task, separate processes, wanted >= 1.2"},
  };
}

}  // namespace mrroc::bench
