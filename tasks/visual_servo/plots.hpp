// Pictures of a run.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace mrroc::visual_servo {

/// @return names and gnuplot scripts, which read servo.csv: the error that c_1 sees over control steps in the colour of
///         the active behaviour, as VS fig. 28; and the true error
[[nodiscard]] std::vector<std::pair<std::string, std::string>> plots();

}  // namespace mrroc::visual_servo
