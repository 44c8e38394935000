// Pictures of a run: the paths of the fingers around their plates, and the force.
#pragma once
#include <string>

#include "base/config.hpp"
#include "base/time_chart.hpp"

namespace mrroc::edge_follow {

/// @param config  of the run: plates, finger and sheets are drawn as it gives them
/// @return gnuplot script of plots/path.png: for each arm, seen from above, its plate, the finger where it began, and the
///         way of the finger's axis around the plate, from arm1.csv and arm2.csv
[[nodiscard]] std::string path_script(const Config& config);

/// @return the contact force over time, a panel for each arm, from the same tables
[[nodiscard]] TimeChart force_chart(const Config& config);

}  // namespace mrroc::edge_follow
