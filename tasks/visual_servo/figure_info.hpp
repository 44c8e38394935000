// The figures of visual servoing: their meaning and their bounds.
#pragma once
#include <array>

#include "mp/figure_table.hpp"

namespace mrroc::visual_servo {

/// In the order of the table. An error is of the pose of E relative to the object. At the end it is judged by what the
/// tool's camera can know (tool_camera_error): 0.5 % of the focal length is 1.8 mm of its distance.
inline constexpr std::array kFigures{
    mp::FigureInfo{.key = "final_err_mm", .words = "error at the end", .unit = "mm", .high = 2},
    mp::FigureInfo{.key = "final_err_deg", .words = "  of the orientation", .unit = "deg", .high = 0.1},
    mp::FigureInfo{.key = "true_err_mm", .words = "  with the tool's camera out of place", .unit = "mm"},
    mp::FigureInfo{.key = "overshoot_pct", .words = "overshoot", .unit = "% of the way", .high = 10},
    mp::FigureInfo{
        .key = "steps_to_2mm", .words = "until it stays below 2 mm", .unit = "control steps", .high = 80},
    mp::FigureInfo{.key = "camera_change_mm",
                   .words = "set pose, after a change of cameras",
                   .unit = "mm a step",
                   .high = 1},
    mp::FigureInfo{.key = "line_lag_mm", .words = "behind an object on a line", .unit = "mm", .high = 10},
    mp::FigureInfo{.key = "follow_err_mm", .words = "error while the object moves", .unit = "mm"},
    mp::FigureInfo{.key = "unseen_pct", .words = "seen by no camera", .unit = "% of the steps"},
    mp::FigureInfo{
        .key = "refused_steps", .words = "asked more than the arm can do", .unit = "control steps"},
    mp::FigureInfo{.key = "arm_moved_mm", .words = "farthest that E went", .unit = "mm"},
};

}  // namespace mrroc::visual_servo
