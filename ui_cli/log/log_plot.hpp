// `ui_cli log plot`: pictures of runs from their logs.
#pragma once
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "ui_cli/log/plot_fields.hpp"
#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// Choice of what a picture shows.
struct PlotOptions {
  std::string what;                   ///< one of plot_subjects(); empty: fields say it all
  std::vector<std::string> fields{};  ///< see chosen_fields(); empty: the usual ones of `what`
  std::vector<std::string> arms{};    ///< or platforms; empty: all
  double from{-std::numeric_limits<double>::infinity()};  ///< shown simulated time [s]
  double to{std::numeric_limits<double>::infinity()};     ///< the same
};

/// @return what can be drawn, of arms and of platforms
[[nodiscard]] std::vector<std::string> plot_subjects();

/// One run: a chart for each arm or platform and quantity, a curve for each field. Several: a chart for each of them and field, a
/// curve for each run.
/// @param picture  as the script is to call it
/// @return a gnuplot script with all its data, so that the picture can be drawn again from one file
/// @throws FaultError bad_usage: no such field or arm, no such time; bad_log: no arm or platform, of which that
///         can be drawn, or no reading in a log
[[nodiscard]] std::string plot_script(const std::vector<RunRecord>& runs, const PlotOptions& options,
                                      const std::string& picture);

/// Draws a PNG file with gnuplot; the script stays beside it.
/// @param output  empty: plots/log-WHAT.png in the folder of the first run
/// @return the file
/// @throws FaultError  as plot_script(); cannot_write: gnuplot is missing or could not draw
std::filesystem::path plot_runs(const std::vector<RunRecord>& runs, const PlotOptions& options,
                                const std::filesystem::path& output);

}  // namespace mrroc::ui
