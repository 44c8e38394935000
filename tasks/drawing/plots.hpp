// Pictures of a run: MS fig. 8, 9 and 10 and the drawing with all its ink.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mp/arm_trace.hpp"
#include "tasks/drawing/ink.hpp"

namespace mrroc::drawing {

/// Where the sheets lie.
struct PlotSetup {
  /// Centre of each arm's sheet in that arm's base [m]; z is the height of the paper.
  std::array<Vector3, 2> sheet{Vector3::Zero(), Vector3::Zero()};
};

/// What came of plotting.
struct Plots {
  std::vector<std::filesystem::path> pictures;  ///< the PNG files that exist now
  std::string note;  ///< why some are missing, one sentence for the user; empty if none are
};

/// Draws what the tables of a run folder hold into its folder plots/:
///
/// | picture | from |
/// | --- | --- |
/// | fig8_trajectory.png | arm1.csv, arm2.csv: the pen's path in space |
/// | fig9_height.png | the same: z(t) above the paper, with the four segments of MS 8.4 |
/// | fig10_force.png | the same: F_z(t) |
/// | drawing.png | input.csv, taught.csv, ink1.csv, ink2.csv |
///
/// Teach-in is behaviours m = 1 and 2; in m = 3 the operator leads the arms to the start; reproduction is m
/// >= 4. Tables that are not there are left out, and so is a panel without data. A script stands beside each
/// picture; `gnuplot plots/NAME.gp` in the run folder draws it again.
/// @throws FileError  a table that cannot be read, or plots/ cannot be written. A missing gnuplot is no
/// error.
[[nodiscard]] Plots plot_run(const std::filesystem::path& run_folder, const PlotSetup& setup);

}  // namespace mrroc::drawing
