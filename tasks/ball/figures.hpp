// What a run is judged by.
#pragma once
#include <vector>

#include "mp/figure_table.hpp"
#include "tasks/ball/ball.hpp"
#include "tasks/ball/body_record.hpp"

namespace mrroc::ball {

/// @param pushed  a person pushed an arm: the object is not where the circle is
/// @return inner_force_N (mean of the weaker palm's normal force around the circle), inner_force_rms_N, inner_force_peak_N,
///         circle_rms_mm and circle_max_mm (of the object off the circle, counted from where it was lifted), held_rms_mm (of the
///         object off its place between the palms), turned_deg, yielded_mm, falls
[[nodiscard]] mp::TaskFigures figures(const std::vector<BodyRow>& rows, const Parameters& k, bool pushed);

}  // namespace mrroc::ball
