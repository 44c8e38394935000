// The file that a run leaves: what was found, as the configuration of every task takes it.
#pragma once
#include <array>
#include <string>

#include "ecp/generators/weighing.hpp"
#include "tasks/calibrate_cell/figures.hpp"

namespace mrroc::calibrate_cell {

/// Name of the file in the run folder.
inline constexpr const char* kResultFile = "calibrated.toml";

/// @param believed  bases before the run; that of arm1 is kept, since touches tell where the bases stand to each other alone
/// @return the bases as they are believed from now on
[[nodiscard]] Bases corrected(const Bases& believed, const Calibration& found);

/// @param sets  names of the arms' kinematic sets, for robots.ARM.kinematics; empty: nothing is said of them
/// @param run  where it was found, for people
/// @return the text of the file
[[nodiscard]] std::string as_toml(const Bases& bases, const std::array<ecp::ForceTool, kArms>& tools,
                                  const std::array<std::string, kArms>& sets, const std::string& run);

}  // namespace mrroc::calibrate_cell
