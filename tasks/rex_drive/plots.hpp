// Pictures of a run.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tasks/rex_drive/figures.hpp"

namespace mrroc::rex_drive {

/// @param results  as platform.csv and fragments.csv have them, at least one row
/// @return names and gnuplot scripts, which read these files: path, error, slip, torques; odometry where there are pictures,
///         and handover where there are fragments
[[nodiscard]] std::vector<std::pair<std::string, std::string>> plots(const DriveResults& results);

}  // namespace mrroc::rex_drive
