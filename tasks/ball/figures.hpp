// What a run is judged by.
#pragma once
#include <optional>
#include <vector>

#include "mp/figure_table.hpp"
#include "tasks/ball/ball.hpp"
#include "tasks/ball/body_record.hpp"

namespace mrroc::ball {

/// @return where the object was at the beginning of the circle, less its way until then; nothing: it has not come there
[[nodiscard]] std::optional<Pose> lifted_pose(const std::vector<BodyRow>& rows);

/// @param pushed  a person pushed an arm: the object is not where the circle is
/// @return inner_force_N (mean of the weaker palm's normal force around the circle), inner_force_rms_N, inner_force_peak_N,
///         turned_deg, circle_rms_mm and circle_max_mm (of the object, from where it was lifted) or yielded_mm of a pushed
///         pair, falls
[[nodiscard]] mp::TaskFigures figures(const std::vector<BodyRow>& rows, const Parameters& k, bool pushed);

}  // namespace mrroc::ball
