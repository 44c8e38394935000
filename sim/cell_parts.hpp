// The processes of a simulated cell of arms: the world, and one effector driver per arm. What the mains
// of all tasks put together in the same way.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "mp/options.hpp"
#include "mp/supervisor.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// One arm of a task.
struct CellArm {
  std::string key;  ///< arm1, arm2
  std::string
      model;  ///< irb6_postument, irb6_track or one of robots/catalogue.hpp, unless [robots.ARM] says another
};

/// Reads every parameter of world and drivers, so that a wrong one is found before anything starts.
/// @param seed  of the world
/// @return the world's parameters
/// @throws FaultError  bad_configuration; also when [robots] order has other arms
WorldParameters read_cell(const Config& config, const std::vector<CellArm>& arms, std::uint64_t seed);

/// @return a task's configuration: its own, over it what the task finds out, over that the file of the options, over
///         that their settings. A file that a run has left has everything: it stands alone, without what belonged to
///         that run, such as its folder. For a check that of the run.
/// @param built_in  TOML  @param task  its name  @param found  KEY=VALUE that the task finds out
/// @throws ConfigError
Config load_task_config(const mp::TaskOptions& options, std::string_view built_in, const std::string& task,
                        const std::vector<std::string>& found = {});

/// @return the seed of a run with a configuration as load_task_config() gives it, in which that of the command line is
/// @throws ConfigError
std::uint64_t seed_of(const Config& config);

/// What would be refused only when the system is being started. @throws FaultError
void check_task_options(const mp::TaskOptions& options);

/// Fixes what belongs to one run alone, and checks that every key is known.
/// @param strokes  file along which the world's hands lead; empty: none
/// @param film     whether cameras leave pictures, by default in the folder
/// @throws ConfigError
void complete_config(Config& config, const mp::TaskOptions& options, const std::filesystem::path& folder,
                     const std::string& strokes, bool film = false);

/// @return a process, which is a program of its own or a thread
/// @param arm  null: it belongs to no arm
mp::Part make_part(const Config& config, const std::string& name, const std::string& program,
                   const CellArm* arm, const link::PartBody& body);

/// @return the process `world`, and a process `edp-ARM` for every arm
std::vector<mp::Part> cell_parts(const Config& config, const std::vector<CellArm>& arms);

}  // namespace mrroc::sim
