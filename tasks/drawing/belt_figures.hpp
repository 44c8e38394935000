// Figures of a drawing on a belt that runs by itself.
#pragma once
#include "tasks/drawing/results.hpp"

namespace mrroc::drawing {

/// @param start  of the pen on the sheet when the reproduction begins [mm]
/// @return the drawing at its place on a sheet: the way of the nodes from there, a stroke for each stretch on the paper [mm]
[[nodiscard]] Drawing drawing_in_place(const Recording& recording, const Point& start);

/// @param papers    middle of each arm's sheet in the arm's base [m], with the belt where it begins
/// @param finished  as in figures_of()
/// @return belt_rms_mm, the ink against the drawing at its place on the sheet, moved in no way; belt_drift_mm and
///         belt_starts; nothing if the belt does not run by itself
[[nodiscard]] std::map<std::string, mp::Figure> belt_figures(const RunRecord& record, const RunInk& ink,
                                                             const Parameters& k,
                                                             const std::array<Vector3, kArms>& papers,
                                                             bool finished);

}  // namespace mrroc::drawing
