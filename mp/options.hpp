// The options that every task's program has.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/link/process.hpp"

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::mp {

/// How a task is to be run.
struct TaskOptions {
  std::uint64_t seed{1};              ///< of everything in the run that is random
  bool seed_asked{};                  ///< --seed was given: that of the configuration does not count
  ClockKind clock{ClockKind::step};   ///< --clock
  double speed{0};                    ///< simulated seconds per second; 0: as fast as possible
  bool speed_asked{};                 ///< --speed was given
  std::filesystem::path run_dir;      ///< empty: runs/TASK-TIME
  std::filesystem::path config_file;  ///< empty: the task's own
  std::vector<std::string> settings;  ///< key=value, over the configuration file
  bool separate{true};                ///< separate processes, or all in one
  bool separate_asked{};              ///< --processes was given
  bool attended{};                    ///< a person at ui_cli instead of the scripted operator
  std::filesystem::path script;       ///< operator input to replay
  bool view{};                        ///< start a viewer beside the task
  std::string session;                ///< empty: a unique name
  std::string url;                    ///< empty: from the session's name
  std::filesystem::path check;        ///< run folder whose log is recomputed instead of a run; empty: none
};

/// Adds the common options to a program's command line.
/// @param options  filled in when the line is parsed; must live as long as the line
void add_task_options(CommandLine& line, TaskOptions& options);

/// @return who gives start and triggers, to be said behind the task's name; empty: the scripted operator
std::string who_orders(const TaskOptions& options);

/// What every task's main does: parses the command line, runs the task, and writes the error line of what it throws.
/// @return exit status
int run_command_line(CommandLine& line, int argc, char** argv, const std::function<int()>& run);

}  // namespace mrroc::mp
