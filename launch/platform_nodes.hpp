// The nodes of platforms: one effector driver each. The simulator is that of launch/cell_nodes.hpp.
#pragma once
#include <string>
#include <vector>

#include "base/config.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::launch {

/// One platform of a task.
struct CellPlatform {
  std::string key;    ///< e.g. "rex"
  std::string model;  ///< one of robots/platforms.hpp
};

/// @return their keys
[[nodiscard]] std::vector<std::string> keys_of(const std::vector<CellPlatform>& platforms);

/// Reads every parameter of the simulated platforms and their drivers, so that a wrong one is found before anything starts.
/// @param platforms  of the task; without one nothing is read
/// @throws FaultError  bad_configuration; also when [platforms] order has other platforms, or motion capture measures too seldom
///         for SYNCHRO
void check_platforms(const Config& config, const std::vector<CellPlatform>& platforms);

/// @return a node `edp-KEY` for every platform; its plant is not set
std::vector<mp::NodeSpec> platform_nodes(const Config& config, const std::vector<CellPlatform>& platforms);

}  // namespace mrroc::launch
