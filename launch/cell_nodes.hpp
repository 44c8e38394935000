// The nodes of a cell of arms: the simulator, if any of them is simulated, and one effector driver per arm.
#pragma once
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
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
/// @throws FaultError  bad_configuration; also when [robots] order has other arms
void check_cell(const Config& config, const std::vector<CellArm>& arms);

/// @return a process, which is a program of its own or a thread
/// @param arm  null: it belongs to no arm
mp::NodeSpec make_node(const Config& config, const std::string& name, const std::string& program,
                       const CellArm* arm, const link::NodeMain& body);

/// @param keys  of cameras @return a process `vsp-CAMERA` for every one of them
std::vector<mp::NodeSpec> camera_nodes(const Config& config, const std::vector<std::string>& keys,
                                       const std::string& program, const link::NodeMain& body);

/// @return the node `simulator`, if a robot is simulated, and a node `edp-ARM` for every arm
std::vector<mp::NodeSpec> cell_nodes(const Config& config, const std::vector<CellArm>& arms);

}  // namespace mrroc::launch
