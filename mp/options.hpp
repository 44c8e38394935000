// The options that every task's program has.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/command_words.hpp"
#include "base/link/process.hpp"

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::mp {

/// Settings of how a task is run.
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
  double max_time{};                  ///< simulated time after which the run is ended [s]; 0: none
  bool strict{};                      ///< a figure that misses what is wanted makes the exit status 1
  bool no_pictures{};                 ///< gnuplot is not run: its scripts alone are left
  bool parameters{};                  ///< instead of a run: list the parameters
  bool truth{};                       ///< of the parameters: those of the plant, with what is believed
  bool json{};                        ///< of the parameters: as JSON
  std::string session;                ///< empty: a unique name
  std::string url;                    ///< empty: from the session's name
  std::vector<std::string> hosts;     ///< --host: NAME=WORDS, see mp/hosts.hpp
  std::filesystem::path check;        ///< run folder whose log is recomputed instead of a run; empty: none

  /// @return whether the scripted operator gives start and triggers: neither a person nor a script does, and no log is
  ///         recomputed
  [[nodiscard]] bool scripted() const { return !attended && script.empty() && check.empty(); }
};

/// Adds the common options to a program's command line.
/// @param options  filled in when the line is parsed; must live as long as the line
void add_task_options(CommandLine& line, TaskOptions& options);

/// @return who gives start and triggers, to be said behind the task's name; empty: the scripted operator
std::string who_orders(const TaskOptions& options);

/// The common main of all tasks: parses the command line, runs the task, and writes the error line of what it
/// throws.
/// @param own  examples of lines with options of the task's own, for errors
/// @return exit status
int run_command_line(CommandLine& line, int argc, char** argv, const std::function<int()>& run,
                     const Examples& own = {});

}  // namespace mrroc::mp
