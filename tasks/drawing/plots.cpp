#include "tasks/drawing/plots.hpp"

#include <system_error>

#include "tasks/drawing/plots_scripts.hpp"

namespace mrroc::drawing {
namespace fs = std::filesystem;
namespace {

template <class Table, class Read>
std::optional<Table> table(const fs::path& file, Read read) {
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  Table rows = read(file);
  return rows.empty() ? std::nullopt : std::optional<Table>(std::move(rows));
}

RunTables read_tables(const fs::path& folder) {
  RunTables run;
  run.input = table<Ink>(folder / "input.csv", read_ink);
  run.taught = table<Ink>(folder / "taught.csv", read_ink);
  run.ink = {table<Ink>(folder / "ink1.csv", read_ink), table<Ink>(folder / "ink2.csv", read_ink)};
  run.arms = {table<mp::ArmTrace>(folder / "arm1.csv", mp::read_arm_trace),
              table<mp::ArmTrace>(folder / "arm2.csv", mp::read_arm_trace)};
  return run;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plots(const fs::path& run_folder, const PlotSetup& setup) {
  const RunTables run = read_tables(run_folder);
  std::vector<std::pair<std::string, std::string>> scripts{{"fig8_trajectory", trajectory_script(run, setup)},
                                                           {"fig9_height", height_script(run, setup)},
                                                           {"fig10_force", force_script(run)},
                                                           {"drawing", drawing_script(run)}};
  std::erase_if(scripts, [](const auto& script) { return script.second.empty(); });
  return scripts;
}

}  // namespace mrroc::drawing
