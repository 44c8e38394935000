// The visual servoing task in processes of its own.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// One run to its end, as fast as the machine can. @return its summary
json servo_run(const std::vector<std::string>& more) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "run";
  std::vector<std::string> arguments{"--seed", "1", "--processes", "separate", "--run-dir", folder.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  TaskProcess task("visual_servo", arguments);
  const int status = task.wait();
  json summary = run_summary(folder);
  if (status != 0 || summary.is_null())
    throw FaultError(FaultCode::internal_error, "the visual servoing task did not end well");
  return summary;
}

double figure(const json& summary, const std::string& key) {
  const json value = summary.at("figures").value(key, json());
  if (!value.is_number())
    throw FaultError(FaultCode::internal_error, fmt::format("visual servoing: no {} could be measured", key));
  return value.get<double>();
}

}  // namespace

Figures visual_servo_figures() {
  const std::vector<std::string> fast{"--set", "cameras.profile=fast"};
  const json exact = servo_run({});
  Figures figures{
      {"final_err_mm", figure(exact, "final_err_mm"), "mm",
       "visual servoing: true error at the end, wanted <= 1"},
      {"final_err_deg", figure(exact, "final_err_deg"), "deg", "  of the orientation, wanted <= 0.1"},
      {"overshoot_pct", figure(exact, "overshoot_pct"), "%", "overshoot, wanted <= 10"},
      {"steps_to_2mm", figure(exact, "steps_to_2mm"), "steps",
       "from 0.33 m, mean of both cameras, wanted <= 80"}};
  for (const std::string method : {"switching", "weights"})
    figures.push_back({"steps_to_2mm_" + method, figure(servo_run({"--aggregation", method}), "steps_to_2mm"),
                       "steps", "  aggregation " + method + ", wanted <= 80"});
  const json line = servo_run({"--scenario", "line"});
  figures.push_back({"line_lag_mm", figure(line, "line_lag_mm"), "mm",
                     "behind an object on a line at 0.1 m/s, wanted <= 10"});
  figures.push_back(
      {"line_follow_err_mm", figure(line, "follow_err_mm"), "mm", "  true error on that line, mean"});
  figures.push_back({"real_time_factor", exact.at("real_time_factor").get<double>(), "",
                     "whole task, two cameras, exact pictures, wanted >= 0.5"});
  figures.push_back({"real_time_factor_fast", servo_run(fast)["real_time_factor"].get<double>(), "",
                     "  fast pictures, wanted >= 1.5"});
  return figures;
}

}  // namespace mrroc::bench
