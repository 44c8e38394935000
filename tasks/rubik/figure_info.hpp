// The figures of the cube's task: their meaning and their bounds.
#pragma once
#include <array>

#include "mp/figure_table.hpp"

namespace mrroc::rubik {

/// More would crush the cube [N]. Fingers give way at 300 N (docs/plant.md).
inline constexpr double kMostSqueeze = 350;

/// In the order of the table.
inline constexpr std::array kFigures{
    mp::FigureInfo{.key = "solved", .words = "the cube is solved", .unit = "", .low = 1},
    mp::FigureInfo{.key = "verified", .words = "  and is seen to be", .unit = "", .low = 1},
    mp::FigureInfo{.key = "moves", .words = "turns of a face", .unit = ""},
    mp::FigureInfo{.key = "regrasps", .words = "re-grasps without a turn", .unit = ""},
    mp::FigureInfo{.key = "retries", .words = "attempts at a grip or turn besides the first", .unit = ""},
    mp::FigureInfo{.key = "other_way", .words = "  faces that jam, turned the other way round", .unit = ""},
    mp::FigureInfo{.key = "first_try_share", .words = "turns without such, share", .unit = ""},
    mp::FigureInfo{
        .key = "sim_s_per_turn", .words = "time per turn, re-grasps included", .unit = "s", .high = 30},
    mp::FigureInfo{.key = "approach_settled_N",
                   .words = "force of the approach, settled",
                   .unit = "N",
                   .low = 3.8,
                   .high = 4.2},
    mp::FigureInfo{.key = "approach_peak_N", .words = "  of the impact, largest", .unit = "N"},
    mp::FigureInfo{
        .key = "turn_lateral_peak_N", .words = "x, y, z while turning, largest", .unit = "N", .high = 12},
    mp::FigureInfo{.key = "turn_lateral_std_N",
                   .words = "  their standard deviation in a turn, largest",
                   .unit = "N",
                   .high = 0.5},
    mp::FigureInfo{.key = "turn_torque_peak_Nm", .words = "torque while turning, largest", .unit = "N m"},
    mp::FigureInfo{.key = "turn_angle_err_deg",
                   .words = "face behind tool at the end of a turn",
                   .unit = "deg",
                   .high = 2},
    mp::FigureInfo{.key = "turn_slip_mm", .words = "slip in the jaws while turning", .unit = "mm", .high = 2},
    mp::FigureInfo{.key = "squeeze_N",
                   .words = "of a pad or palm on the cube, largest",
                   .unit = "N",
                   .high = kMostSqueeze},
};

}  // namespace mrroc::rubik
