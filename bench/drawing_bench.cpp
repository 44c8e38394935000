// The drawing task as a user runs it: figures, repeatability, speed, and what happens when parts are killed.
#include <fmt/core.h>
#include <csignal>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"
#include "tasks/drawing/figure_info.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kSystemError = 3;  // exit status

void must(bool condition, const std::string& what) {
  if (!condition) throw FaultError(FaultCode::internal_error, what);
}

/// One run to its end in separate processes, as fast as the machine can.
json whole_run(const fs::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"--seed", "1", "--processes", "separate", "--run-dir", folder.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  TaskProcess task("drawing", arguments);
  must(task.wait() == 0, "the drawing task did not end well");
  json summary = needed_summary(folder);
  fs::remove_all(folder);
  return summary;
}

/// Of a figure with one number per arm, the worse one: the larger, or of a mean force the farther from 1 N.
double worst(const std::string& key, const json& figure) {
  if (!figure.is_array()) return figure.get<double>();
  const auto badness = [&](const json& x) {
    return key == "paper_force_mean_N" ? std::abs(x.get<double>() - 1) : x.get<double>();
  };
  return std::ranges::max(figure, {}, badness).get<double>();
}

/// What the end of a run says about a figure, in one line.
std::string about(const std::string& key, bool per_arm) {
  const auto info = std::ranges::find(drawing::kFigures, key, &mp::FigureInfo::key);
  if (info == drawing::kFigures.end()) return "";
  const std::string words(info->words.substr(info->words.find_first_not_of(' ')));
  const std::string wanted = mp::wanted(*info);
  return fmt::format("{}{}{}", words, wanted.empty() ? "" : ", wanted " + wanted,
                     per_arm ? ", worse of both arms" : "");
}

/// What killing parts of the task in the middle of a stroke has led to.
struct Kills {
  int stop_steps_max{};
  int wrong_exits{};
  int left_running{};
};

/// Kills one part, or the task itself when the name is empty, while both arms draw the first stroke.
void kill_part(const std::string& name, const fs::path& recording, const fs::path& folder, Kills& kills) {
  // Ten times real time: a stroke lasts half a second of the clock on the wall.
  TaskProcess task("drawing", {"--processes", "separate", "--speed", "10", "--load", recording.string(),
                               "--run-dir", folder.string()});
  must(task.read_until("m = 5"), "the task did not come to its first stroke");
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  const std::vector<pid_t> children = task.children();
  const pid_t victim = name.empty() ? task.pid() : task.child(name);
  must(victim > 0, "there is no process " + name);
  ::kill(victim, SIGKILL);
  const int status = task.wait();
  kills.left_running += still_running(children);
  if (name.empty()) return;  // killed itself: it cannot say anything any more
  kills.wrong_exits += status != kSystemError;
  const json figures = needed_summary(folder).value("figures", json::object());
  if (name != "simulator") {
    must(figures.contains("stop_steps_max"), "the arms did not come to rest after the death of " + name);
    kills.stop_steps_max = std::max(kills.stop_steps_max, figures.at("stop_steps_max").get<int>());
  }
  fs::remove_all(folder);
}

}  // namespace

Figures run_drawing_group() {
  const ScratchFolder scratch;
  const fs::path recording = scratch.path() / "taught";
  const json first = whole_run(scratch.path() / "first", {"--save", recording.string()});
  const json second = whole_run(scratch.path() / "second", {});

  Figures figures;
  for (const auto& [key, figure] : first.at("figures").items())
    figures.push_back({key, worst(key, figure), "", about(key, figure.is_array())});
  const auto factor = [](const json& s) { return s.at("real_time_factor").get<double>(); };
  figures.push_back({"real_time_factor", std::max(factor(first), factor(second)), "",
                     "simulated over wall time, separate processes, better of two runs"});
  figures.push_back({"log_hash_equal", first.at("log_hash") == second.at("log_hash") ? 1.0 : 0.0, "",
                     "1: two runs with one seed say the same in every message"});

  Kills kills;
  for (const char* name :
       {"edp-arm1", "edp-arm2", "ecp-arm1", "ecp-arm2", "vsp-arm1", "vsp-arm2", "simulator", ""})
    kill_part(name, recording, scratch.path() / "kill", kills);
  figures.push_back({"stop_steps_max", static_cast<double>(kills.stop_steps_max), "steps",
                     "to rest after any part but the simulator was killed in a stroke"});
  figures.push_back({"kill_wrong_exits", static_cast<double>(kills.wrong_exits), "",
                     "kills of parts after which the exit status was not 3"});
  figures.push_back({"kill_left_running", static_cast<double>(kills.left_running), "",
                     "processes still there after the kills, the parent's too"});
  return figures;
}

}  // namespace mrroc::bench
