// `ui_cli log plot`: pictures of a run from its log.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ui_cli/log/run_record.hpp"

namespace mrroc::ui {

/// What can be drawn: force, pose, motors, behaviours.
[[nodiscard]] const std::vector<std::string>& plot_subjects();

/// Draws a PNG file with gnuplot, a chart below the other for each arm.
/// @param output  empty: plots/log-WHAT.png in the run folder
/// @return the file
/// @throws FaultError bad_usage: nothing of that name; bad_log: no arm in the log; cannot_write: gnuplot is missing or could
///         not draw
std::filesystem::path plot_run(const RunRecord& run, const std::string& what,
                               const std::filesystem::path& output);

}  // namespace mrroc::ui
