// Pictures of a run.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tasks/box_push/figures.hpp"

namespace mrroc::box_push {

/// @param results  as box.csv has them, at least one row
/// @return names and gnuplot scripts, which read that file: path, push
[[nodiscard]] std::vector<std::pair<std::string, std::string>> plots(const PushResults& results);

}  // namespace mrroc::box_push
