// The way along which a simulated operator's hand leads a tool, as the file that the simulator reads.
#pragma once
#include <filesystem>
#include <vector>

#include "base/pose.hpp"

namespace mrroc::mp {

/// Where a hand wants to be.
struct WayPoint {
  double t{};                  ///< since the beginning [s]
  Vector3 p{Vector3::Zero()};  ///< in the base of the arm [m]
};

/// File of the run folder that has it.
inline constexpr const char* kHandFile = "hand.csv";

/// Writes rows t,x,y,z [s], [mm]. @param T_0P  frame of the sheet in the base @throws FaultError cannot_write
void write_hand_way(const std::filesystem::path& file, const std::vector<WayPoint>& way, const Pose& T_0P);

}  // namespace mrroc::mp
