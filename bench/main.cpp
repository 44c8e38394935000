// The benchmarks: figures that can be compared from version to version.
#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/print.hpp"
#include "base/standard_files.hpp"
#include "bench/figures.hpp"
#include "bench/own_output.hpp"
#include "bench/report.hpp"

namespace {

using namespace mrroc;

const std::vector<
    std::pair<std::string, std::function<bench::Figures(const std::string& plots, bool resume)>>>
    kGroups{
        {"edp", [](const std::string&, bool) { return bench::run_edp_group(); }},
        {"servo", [](const std::string& plots, bool) { return bench::run_servo_group(plots); }},
        {"trajectory", [](const std::string&, bool) { return bench::run_trajectory_group(); }},
        {"stability", [](const std::string& plots, bool) { return bench::run_stability_group(plots); }},
        {"vision", [](const std::string&, bool) { return bench::run_vision_group(); }},
        {"drawing", [](const std::string&, bool) { return bench::run_drawing_group(); }},
        {"pen_state", [](const std::string& plots, bool) { return bench::run_pen_state_group(plots); }},
        {"robustness", [](const std::string&, bool) { return bench::run_robustness_group(); }},
        {"guide", [](const std::string&, bool) { return bench::run_guide_group(); }},
        {"solver", [](const std::string&, bool) { return bench::run_solver_group(); }},
        {"cube", [](const std::string&, bool) { return bench::run_cube_group(); }},
        {"plan", [](const std::string&, bool) { return bench::run_plan_group(); }},
        {"operator", [](const std::string&, bool) { return bench::run_operator_group(); }},
        {"ball", [](const std::string&, bool) { return bench::run_ball_group(); }},
        {"calibrate_cell", [](const std::string&, bool) { return bench::run_calibrate_cell_group(); }},
        {"haptic", [](const std::string&, bool) { return bench::run_haptic_group(); }},
        {"rubik", [](const std::string&, bool resume) { return bench::run_rubik_group(resume); }},
        {"rex", [](const std::string& plots, bool) { return bench::run_rex_group(plots); }},
        {"rex_stops", [](const std::string&, bool) { return bench::run_rex_stops_group(); }},
        {"rex_eyes", [](const std::string&, bool) { return bench::run_rex_eyes_group(); }},
        {"box", [](const std::string&, bool) { return bench::run_box_group(); }},
        {"mutation", [](const std::string&, bool resume) { return bench::run_mutation_group(resume); }},
    };

/// Groups that have to be named.
const std::vector<std::string> kLong{"ball",     "calibrate_cell", "haptic", "rubik",   "rex",
                                     "rex_eyes", "rex_stops",      "box",    "mutation"};

std::vector<std::string> group_names() {
  std::vector<std::string> names;
  for (const auto& [name, run] : kGroups) names.push_back(name);
  return names;
}

/// Where the JSON goes.
struct JsonOutput {
  bool wanted{};
  std::string file;  ///< empty: the standard output
};

int run(const std::vector<std::string>& wanted, const JsonOutput& json, const std::string& plots,
        bool resume) {
  const auto known = group_names();
  if (std::ranges::find(known, json.file) != known.end())
    throw FaultError(FaultCode::bad_usage, fmt::format("--json takes '{}' for its file", json.file),
                     fmt::format("name groups before it: bench {} --json", json.file));
  if (resume && json.file.empty())
    throw FaultError(FaultCode::bad_usage, "--resume goes on with a file", "name it: --json FILE --resume");
  std::optional<bench::OwnOutput> out;
  if (json.wanted && json.file.empty()) out.emplace();
  bench::Report report(json.file);
  if (resume) report.resume();
  for (const auto& [name, measure] : kGroups) {
    const auto& list = wanted.empty() ? kLong : wanted;
    if ((std::ranges::find(list, name) != list.end()) == wanted.empty()) continue;
    if (resume && report.has(name)) continue;
    report.add(name, measure(plots, resume));
  }
  if (out) out->write(report.json());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line("Measures the framework and prints a table. The machine should have nothing else to do.",
                   "bench");
  std::vector<std::string> groups;
  JsonOutput json;
  std::string plots;
  bool resume = false;
  line.option("group", groups,
              "edp, servo, trajectory, stability, vision, drawing, pen_state, robustness, guide, "
              "solver, cube, plan, operator, ball, calibrate_cell, haptic, rubik, rex, rex_eyes, rex_stops, "
              "box, mutation "
              "(default: all but the last nine, which take long)")
      .one_of(group_names());
  const Option to =
      line.option("--json", json.file,
                  "prints {\"figures\": {KEY: number}, ...}, and the table on the standard error; with a "
                  "FILE behind it: writes it there, after each group")
          .type_name("[FILE]")
          .value_optional();
  line.flag("--resume", resume, "leaves out groups whose figures are in the file already");
  line.option("--plots", plots,
              "draws pictures of the groups servo, stability, pen_state and rex there (gnuplot)")
      .type_name("DIR");
  try {
    if (const auto help = line.parse_or_help(argc, argv, {"./run bench servo --plots plots"})) {
      print(stdout, *help);
      return end_standard_output(0);
    }
    json.wanted = to.given();
    return end_standard_output(run(groups, json, plots, resume));
  } catch (const FaultError& e) {
    fmt::print(stderr, "{}\n", e.error_line());
    return exit_status(e.fault().code);
  }
}
