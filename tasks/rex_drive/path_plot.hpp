// The picture of the way: seen from above.
#pragma once
#include <string>

#include "tasks/rex_drive/figures.hpp"

namespace mrroc::rex_drive {

/// @return a gnuplot script that reads platform.csv, and writes plots/path.png: the room, its floor and areas tinted by their friction, the plan's
///         points, reference, true and estimated way, and ellipses of the estimate
[[nodiscard]] std::string path_script(const DriveResults& results);

}  // namespace mrroc::rex_drive
