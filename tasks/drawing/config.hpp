// The drawing task's part of the configuration.
#pragma once
#include "base/config.hpp"
#include "tasks/drawing/hand_operator.hpp"
#include "tasks/drawing/images.hpp"

namespace mrroc::drawing {

/// @return the parameters in the tables [task] and [time]
/// @throws ConfigError
Parameters read_parameters(const Config& config);

/// Refuses a recording that was taught with another macrostep.
/// @param file  for the error
/// @throws FileError
void check_macrostep(const Taught& taught, const Parameters& k, const std::string& file);

/// @param start  where both pens begin the reproduction unless the configuration says otherwise [mm]
/// @return the scripted operator's parameters in the table [operator]
/// @throws ConfigError
HandPlan read_hand_plan(const Config& config, const Point& start = {0, 0});

}  // namespace mrroc::drawing
