// Pictures of a run.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tasks/visual_servo/servo_table.hpp"

namespace mrroc::visual_servo {

/// @param table  as servo.csv has it, at least one row
/// @return names and gnuplot scripts, which read servo.csv: the error that c_1 sees over time, as VS fig. 28, in the
///         colour of the active behaviour; and the true error
[[nodiscard]] std::vector<std::pair<std::string, std::string>> plots(const ServoTable& table);

}  // namespace mrroc::visual_servo
