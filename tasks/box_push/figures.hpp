// The figures of a run: where the box has come to, and with how much effort.
#pragma once
#include <array>

#include "mp/figure_table.hpp"
#include "tasks/box_push/coordinator.hpp"
#include "tasks/box_push/push_record.hpp"

namespace mrroc::box_push {

/// What figures and pictures are made of.
struct PushResults {
  PushTable table;          ///< a row per macrostep
  CoordinatorParameters k;  ///< of the coordinator
  double macrostep{0.02};   ///< duration [s]
};

/// @return figures; those that a run cannot have are missing
///   box_err_mm, box_err_deg   of the true box from its goal, in the end
///   pushes                    begun
///   push_mean_N               force on the box while it moves, along the platforms' heading
///   way_m                     of the box
///   run_s                     from start to the end
[[nodiscard]] mp::Figures figures_of(const PushResults& results);

/// In the order of the table, with what is wanted.
inline constexpr std::array kFigures{
    mp::FigureInfo{
        .key = "box_err_mm", .words = "distance of the box from its goal", .unit = "mm", .high = 30},
    mp::FigureInfo{.key = "box_err_deg", .words = "  turned by", .unit = "degrees", .high = 5},
    mp::FigureInfo{.key = "pushes", .words = "pushes", .unit = ""},
    mp::FigureInfo{.key = "push_mean_N", .words = "force on the moving box", .unit = "N"},
    mp::FigureInfo{.key = "way_m", .words = "way of the box", .unit = "m"},
    mp::FigureInfo{.key = "run_s", .words = "time", .unit = "s"},
    mp::FigureInfo{.key = "stop_steps_max",
                   .words = "steps until the platforms were at rest",
                   .unit = "",
                   .high = 300,
                   .always = true},
};

}  // namespace mrroc::box_push
