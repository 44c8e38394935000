// The way that a simulated operator wants to lead the tool: to the fixture, along it while he pushes across and against its ends.
#pragma once
#include <filesystem>
#include <vector>

#include "tasks/guide/config.hpp"

namespace mrroc::guide {

/// Where his hand wants to be.
struct WayPoint {
  double t{};                  ///< since the beginning [s]
  Vector3 p{Vector3::Zero()};  ///< in the base of the arm [m]
};

/// @return a point every 10 ms. From off the fixture onto it, a rest until the fixture holds; along it to both ends and half
///         back, or once and a half around a curve without ends, or once over a plane; a rest at the end. On the way his hand
///         is off the fixture by as much as the push takes, in a direction that turns.
[[nodiscard]] std::vector<WayPoint> hand_way(const Setup& k, const OperatorPlan& plan);

/// File of the run folder that has it, for the simulator.
inline constexpr const char* kHandFile = "hand.csv";

/// Writes rows t,x,y,z [s], [mm]. @param T_0P  frame of the sheet in the base @throws FaultError cannot_write
void write_hand_way(const std::filesystem::path& file, const std::vector<WayPoint>& way, const Pose& T_0P);

}  // namespace mrroc::guide
