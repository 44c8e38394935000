// The nodes of a cell: the simulator, if anything in it is simulated, and one effector driver per arm and per platform.
#pragma once
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "launch/platform_nodes.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::launch {

/// One arm of a task.
struct CellArm {
  std::string key;    ///< arm1, arm2
  std::string model;  ///< one of robots/catalogue.hpp, unless [robots.ARM] says another
};

/// @return their keys
[[nodiscard]] std::vector<std::string> keys_of(const std::vector<CellArm>& arms);

/// Reads every parameter of simulator and drivers, so that a wrong one is found before anything starts.
/// @throws FaultError  bad_configuration; also when [robots] order has other arms, or [platforms] order other platforms
void check_cell(const Config& config, const std::vector<CellArm>& arms,
                const std::vector<CellPlatform>& platforms = {});

/// @return a process, which is a program of its own or a thread
/// @param arm  null: it belongs to no arm; of a platform, its key and model
mp::NodeSpec make_node(const Config& config, const std::string& name, const std::string& program,
                       const CellArm* arm, const link::NodeMain& body);

/// @param keys  of cameras @return a process `vsp-CAMERA` for every one of them
std::vector<mp::NodeSpec> camera_nodes(const Config& config, const std::vector<std::string>& keys,
                                       const std::string& program, const link::NodeMain& body);

/// @return the node `simulator`, if a robot is simulated, and a node `edp-KEY` for every arm and platform
std::vector<mp::NodeSpec> cell_nodes(const Config& config, const std::vector<CellArm>& arms,
                                     const std::vector<CellPlatform>& platforms = {});

}  // namespace mrroc::launch
