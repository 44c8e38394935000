#include "tasks/drawing/plots.hpp"

#include <fmt/core.h>

#include <system_error>

#include "base/text_file.hpp"
#include "mp/gnuplot.hpp"
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

Plots plot_run(const fs::path& run_folder, const PlotSetup& setup) {
  const RunTables run = read_tables(run_folder);
  std::error_code error;
  fs::create_directories(run_folder / "plots", error);
  Plots plots;
  const auto draw = [&](const std::string& name, const std::string& script) {
    if (script.empty()) return;
    const fs::path picture = run_folder / "plots" / (name + ".png");
    fs::remove(picture, error);
    write_text_file(run_folder / "plots" / (name + ".gp"), script);
    switch (mp::run_gnuplot(run_folder, fs::path("plots") / (name + ".gp"))) {
      case mp::GnuplotResult::done:
        plots.pictures.push_back(picture);
        break;
      case mp::GnuplotResult::absent:
        plots.note = "gnuplot is not installed, so there are no pictures of the run";
        break;
      case mp::GnuplotResult::failed:
        plots.note =
            fmt::format("gnuplot could not draw {}; see plots/gnuplot.log", picture.filename().string());
        break;
    }
  };
  draw("fig8_trajectory", trajectory_script(run, setup));
  draw("fig9_height", height_script(run, setup));
  draw("fig10_force", force_script(run));
  draw("drawing", drawing_script(run));
  return plots;
}

}  // namespace mrroc::drawing
