// The command line's options for the platform's task.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "tasks/rex_drive/plan/plan_file.hpp"

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::rex_drive {

/// The options of the task's own; what is not given is as the configuration says.
struct DriveOptions {
  std::optional<std::string> plan{};       ///< a built-in one or a file
  std::optional<double> speed{};           ///< wanted [m/s]
  std::optional<std::string> tracker{};    ///< of the virtual effector
  std::optional<std::string> estimator{};  ///< the same
  std::optional<std::string> ground{};     ///< a kind of ground or a file
  std::optional<std::string> eyes{};       ///< on or off
};

/// Adds them to a program's command line.
void add_drive_options(CommandLine& line, DriveOptions& options);

/// @return KEY=VALUE of what the options say. A file of a plan is told with its whole path
/// @throws FaultError bad_usage  an empty word; there is neither a ground nor a file of that name
[[nodiscard]] std::vector<std::string> settings_of(const DriveOptions& options);

/// @return the options by the keys that settings_of() gives for them
[[nodiscard]] std::map<std::string, std::string> options_of_keys();

/// Sets what follows from the options: the ground of a file, the cameras unless the eyes are off, and where the simulated platform stands at the beginning.
/// @param plans  begin there; their start becomes that of the configuration if it has one
/// @throws ConfigError; FaultError bad_configuration: cameras are set, and there are none; the file of a ground has
///         no table of one, or another table
void complete_drive(Config& config, const DriveOptions& options, PlanList& plans);

}  // namespace mrroc::rex_drive
