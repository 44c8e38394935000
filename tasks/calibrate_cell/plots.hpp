// Pictures of a run: where both arms found the balls, and how well they agree.
#pragma once
#include <string>

#include "tasks/calibrate_cell/figures.hpp"

namespace mrroc::calibrate_cell {

/// @return gnuplot script of plots/balls.png: the balls in the world seen from above, as the first arm found them and as
///         the second one did, by the bases believed before and by those found; and what is left of each ball
[[nodiscard]] std::string balls_script(const Calibration& found, const Bases& believed);

}  // namespace mrroc::calibrate_cell
