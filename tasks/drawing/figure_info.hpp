// The figures of the drawing task: their meaning and their bounds, shared by the end of a run, the benchmark
// and the README's table.
#pragma once
#include <array>

#include "mp/figure_table.hpp"

namespace mrroc::drawing {

/// In the order of the table. An error is the distance to the nearest point of the corresponding stroke.
inline constexpr std::array kFigures{
    mp::FigureInfo{
        .key = "teach_rms_mm", .words = "taught ink against the input", .unit = "mm rms", .high = 1},
    mp::FigureInfo{.key = "teach_max_mm", .words = "  farthest", .unit = "mm"},
    mp::FigureInfo{
        .key = "copy_rms_mm", .words = "copy against the taught ink", .unit = "mm rms", .high = 0.5},
    mp::FigureInfo{.key = "copy_max_mm", .words = "  farthest", .unit = "mm", .high = 1.5},
    mp::FigureInfo{
        .key = "stray_ink_mm", .words = "ink outside the strokes", .unit = "mm", .low = 0, .high = 0},
    mp::FigureInfo{
        .key = "uncovered_mm", .words = "taught ink that the copy lacks", .unit = "mm", .low = 0, .high = 0},
    mp::FigureInfo{.key = "paper_force_mean_N",
                   .words = "force on the paper while drawing",
                   .unit = "N",
                   .low = 0.95,
                   .high = 1.05},
    mp::FigureInfo{.key = "paper_force_std_N", .words = "  its deviation", .unit = "N", .high = 0.2},
    mp::FigureInfo{
        .key = "travel_z_mm", .words = "height variation of a travel in the air", .unit = "mm", .high = 0.2},
    mp::FigureInfo{.key = "segment_skew",
                   .words = "arms apart at a stroke's start",
                   .unit = "macrosteps",
                   .low = 0,
                   .high = 0},
    mp::FigureInfo{.key = "belt_rms_mm",
                   .words = "ink on the belt against the standing sheet",
                   .unit = "mm rms",
                   .high = 0.3},
    mp::FigureInfo{.key = "belt_drift_mm",
                   .words = "  drift over the sheets, first to last stop",
                   .unit = "mm",
                   .high = 0.1},
    mp::FigureInfo{.key = "belt_starts", .words = "  starts of the belt", .unit = ""},
    mp::FigureInfo{.key = "strokes_input", .words = "strokes of the input", .unit = ""},
    mp::FigureInfo{.key = "strokes_taught", .words = "strokes taught", .unit = ""},
    mp::FigureInfo{
        .key = "strokes_missing", .words = "  that the copy lacks", .unit = "", .low = 0, .high = 0},
    mp::FigureInfo{
        .key = "strokes_extra", .words = "  that the copy has besides", .unit = "", .low = 0, .high = 0},
    mp::FigureInfo{.key = "pen_state_wrong_strokes",
                   .words = "strokes whose pen state was not the ink's",
                   .unit = "",
                   .low = 0,
                   .high = 0},
    mp::FigureInfo{.key = "pen_state_mismatches",
                   .words = "pen state unlike the memory's",
                   .unit = "macrosteps",
                   .low = 0,
                   .high = 0},
    mp::FigureInfo{
        .key = "doubtful_strokes", .words = "pen states against the height", .unit = "", .low = 0, .high = 0},
    mp::FigureInfo{.key = "nodes", .words = "nodes recorded", .unit = ""},
    mp::FigureInfo{.key = "macrostep_s", .words = "duration of one", .unit = "s"},
};

/// Headings, in the order of the arms.
inline constexpr std::array<std::string_view, 2> kFigureColumns{"arm 1", "arm 2"};

}  // namespace mrroc::drawing
