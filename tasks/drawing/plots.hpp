// Pictures of a run: MS fig. 8, 9 and 10 and the drawing with all its ink.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "mp/arm_trace.hpp"
#include "tasks/drawing/ink.hpp"

namespace mrroc::drawing {

/// Places of the sheets.
struct PlotSetup {
  /// Centre of each arm's sheet in that arm's base [m]; z is the height of the paper.
  std::array<Vector3, 2> sheet{Vector3::Zero(), Vector3::Zero()};
};

/// Pictures of what the tables of a run folder hold:
///
/// | picture | from |
/// | --- | --- |
/// | fig8_trajectory.png | arm1.csv, arm2.csv: the pen's path in space |
/// | fig9_height.png | the same: z(t) above the paper, with the four segments of MS 8.4 |
/// | fig10_force.png | the same: F_z(t) |
/// | drawing.png | input.csv, taught.csv, ink1.csv, ink2.csv |
///
/// Teach-in is behaviours m = 1 and 2; in m = 3 the operator leads the arms to the start; reproduction is m
/// >= 4. Tables that are not there are left out, and so are a panel without data and a picture without a panel.
/// @return names and gnuplot scripts, see mp::draw()
/// @throws FileError  a table that cannot be read
[[nodiscard]] std::vector<std::pair<std::string, std::string>> plots(const std::filesystem::path& run_folder,
                                                                     const PlotSetup& setup);

}  // namespace mrroc::drawing
