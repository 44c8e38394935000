// Every task run once, shortly, and recomputed from its log to its end.
#include <fmt/core.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "bench/operator_figures.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

/// A task as short as it can be.
struct Short {
  std::string task;
  std::vector<std::string> arguments;
};

std::vector<Short> all_tasks(const fs::path& folder) {
  const std::string words = (folder / "jog.words").string();
  std::ofstream(words) << "5 home all\n150 jog arm1 angle-axis 0 0 0.01 0 0 0\n300 end\n";
  return {
#ifdef MRROC_REX
      {"rex_drive", {"--plan", "pivot", "--eyes", "off"}},
      {"box_push", {"--to", "0.6", "0", "0"}},
#endif
      {"press", {}},
      {"edge_follow", {}},
      {"weigh", {}},
      {"guide", {}},
      {"haptic", {}},
      {"ball", {"--set", "task.turn=400"}},
      {"move", {}},
      {"manual", {"--words", words}},
      {"drawing", {}},
      {"visual_servo", {"--set", "cameras.profile=fast"}},
      {"rubik", {"--scramble", "U'", "--eyes", "none", "--set", "task.tables=small"}}};
}

nlohmann::json check(const fs::path& run) {
  TaskProcess program("ui_cli", {"log", "check", run.string(), "--json"});
  std::string text;
  for (std::string line; program.read_until("", &line);) text += line + "\n";
  const int status = program.wait();
  auto verdict = nlohmann::json::parse(text, nullptr, false);
  if (verdict.is_discarded())
    throw FaultError(FaultCode::bad_log,
                     fmt::format("ui_cli log check {} ended with {}", run.string(), status));
  return verdict;
}

}  // namespace

Figures log_check_figures() {
  const ScratchFolder scratch;
  std::int64_t compared = 0;
  std::int64_t differences = 0;
  const auto tasks = all_tasks(scratch.path());
  for (const Short& s : tasks) {
    const fs::path run = scratch.path() / s.task;
    auto arguments = s.arguments;
    arguments.insert(arguments.end(), {"--processes", "separate", "--run-dir", run.string()});
    TaskProcess task(s.task, arguments);
    if (const int status = task.wait(); status != 0)
      throw FaultError(FaultCode::start_failed, fmt::format("{} ended with {}", s.task, status));
    const auto checked = check(run);
    if (!checked.at("complete").get<bool>())
      throw FaultError(FaultCode::bad_log, fmt::format("the log of {} was not recomputed to its end: {}",
                                                       s.task, checked.at("processes").dump()));
    differences += checked.at("differences").get<std::int64_t>();
    for (const auto& p : checked.at("processes")) compared += p.at("compared").get<std::int64_t>();
    fs::remove_all(run);
  }
  return {
      {"log_check_differences", static_cast<double>(differences), "",
       fmt::format("{} messages of {} tasks recomputed from their logs, wanted 0", compared, tasks.size())}};
}

}  // namespace mrroc::bench
