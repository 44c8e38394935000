// The declaration of a task; run_task() makes a run of it.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/command_line.hpp"
#include "base/config.hpp"
#include "launch/cell_nodes.hpp"
#include "launch/results.hpp"
#include "launch/setup.hpp"
#include "mp/coordinator_run.hpp"
#include "mp/task_run.hpp"

namespace mrroc::launch {

/// A virtual sensor that every arm of a task has: process vsp-NAME-ARM, program vsp_NAME, channel ARM.NAME.
struct Receptor {
  std::string name;     ///< NAME of program and channel
  link::NodeMain body;  ///< what its process does
  /// Reads its parameters once, so that a wrong one is found before anything starts. May be empty.
  std::function<void(const Config&)> read{};
};

/// A task: what it is called, which processes take part, and what is its own in a run. Functions may be empty unless it is said that
/// they may not. Those that keep something for one another capture it.
struct Task {
  std::string name;             ///< of the program
  std::string about;            ///< for --help
  std::string_view config;      ///< its TOML file
  std::vector<CellArm> arms{};  ///< keys and kinematics
  /// @return arms that stand behind these in `[robots] order` in a run with that configuration
  std::function<std::vector<CellArm>(const Config&)> more_arms{};
  std::vector<CellPlatform>
      platforms{};            ///< keys and models; their configuration has `robots.order = []` without arms
  link::NodeMain ecp;         ///< what the ECP of each arm and platform does; not empty
  std::string ecp_program{};  ///< its program; empty: `ecp_NAME`
  std::vector<Receptor> receptors{};  ///< of each arm

  /// Adds options of the task's own, which stand above those of every task.
  std::function<void(CommandLine&)> options{};
  /// Lines that show them, from which errors take what to type.
  Examples examples{};
  /// Those of them that say what a configuration says: a line has them or --config.
  std::vector<std::string> instead_of_config{};
  /// Says how they stand to others of those of every task.
  std::function<void(CommandLine&)> relations{};
  /// Finds out what the user need not say. The configuration of an earlier run has all of it.
  /// @return KEY=VALUE, over the task's file, below the user's @throws FaultError
  std::function<std::vector<std::string>(mp::TaskOptions&)> found{};
  /// Options by the keys that `found` sets for them: an error of such a value names what the user typed.
  std::map<std::string, std::string> typed{};
  /// Sets keys that depend on what the rest of the configuration says.
  std::function<void(Config&, const mp::TaskOptions&)> complete{};
  /// Reads everything that the task will read of the configuration and of files: what is wrong is told before anything
  /// starts. @throws FaultError
  std::function<void(const Setup&)> prepare{};
  /// @return what is printed instead of a run, which does not start then; empty: the run starts
  std::function<std::string(const Setup&)> instead{};
  /// @return what is run, for the first line, such as the name of a drawing
  std::function<std::string(const Setup&)> words{};
  std::string unattended{};  ///< end of the first line when neither a person nor a script gives the orders
  std::string strokes{};     ///< file of the run folder along which the simulator's hands lead; empty: none
  /// Writes what the run folder holds before the nodes start. @param folder  exists
  std::function<void(const std::filesystem::path& folder)> files{};
  /// @return the nodes besides the simulator, the drivers, the ECPs and the receptors
  std::function<std::vector<mp::NodeSpec>(const Setup&)> nodes{};
  /// Makes the coordinator, for a run or for a check of one, see TaskOptions::check; not empty.
  std::function<std::unique_ptr<mp::CoordinatorRun>(mp::TaskRun&, const Setup&)> coordinator{};
  /// Files, figures and pictures of a run that has ended. The arms' tables are there already.
  std::function<void(Results&)> results{};
};

/// Reads the command line, runs the task, leaves the run folder and prints how it ended. With --check it executes the
/// coordinator on the log of a run, with --parameters it lists the parameters.
/// @return exit status
int run_task(const Task& task, int argc, char** argv);

}  // namespace mrroc::launch
