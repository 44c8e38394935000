// Pictures of a run: the way of the object around the circle, and forces and deviation over time.
#pragma once
#include <string>
#include <vector>

#include "base/time_chart.hpp"
#include "tasks/ball/ball.hpp"
#include "tasks/ball/body_record.hpp"

namespace mrroc::ball {

/// @return gnuplot script of plots/path.png: the object and where it is led, seen along the line between the palms
[[nodiscard]] std::string path_script(const std::vector<BodyRow>& rows);

/// @return normal forces of both palms, and how far the object is from where it is led, while it is held
[[nodiscard]] TimeChart force_chart(const std::vector<BodyRow>& rows, const Parameters& k);

}  // namespace mrroc::ball
