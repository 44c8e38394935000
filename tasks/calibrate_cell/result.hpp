// The file that a run leaves: what was found, as the configuration of every task takes it.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "ecp/generators/weighing.hpp"
#include "tasks/calibrate_cell/figures.hpp"

namespace mrroc::calibrate_cell {

/// Name of the file in the run folder.
inline constexpr const char* kResultFile = "calibrated.toml";

/// @param believed  bases before the run; that of arm1 is kept, since nothing tells where the cell stands in the world
/// @param T_12  base of arm2 in that of arm1 as it was found
/// @return the bases as they are believed from now on
[[nodiscard]] Bases corrected(const Bases& believed, const Pose& T_12);

/// Where a camera is.
struct CameraPlace {
  std::string key;  ///< of [cameras.KEY]
  Pose pose;        ///< in the frame of its mount
};

/// What a run has found.
struct CellResult {
  Bases bases;                              ///< as they are believed from now on
  std::array<ecp::ForceTool, kArms> tools;  ///< weights and mass centres
  std::array<std::string, kArms> sets;      ///< for robots.ARM.kinematics; empty: nothing is said of them
  std::vector<CameraPlace> cameras;         ///< that were found
  std::string ways;                         ///< for people: how the bases were found; one line or more
};

/// @param run  where it was found, for people
/// @return the text of the file
[[nodiscard]] std::string as_toml(const CellResult& found, const std::string& run);

}  // namespace mrroc::calibrate_cell
