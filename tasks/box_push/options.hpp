// The command line's options for pushing a box.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::box_push {

/// The options of the task's own; what is not given is as the configuration says.
struct PushOptions {
  std::vector<std::string> to{};   ///< goal of the box: x, y [m], phi [degrees]; empty: not given
  std::vector<std::string> box{};  ///< the same of where it stands at the beginning
};

/// Adds them to a program's command line.
void add_push_options(CommandLine& line, PushOptions& options);

/// @return KEY=VALUE of what the options say
/// @throws FaultError bad_usage  not three numbers
[[nodiscard]] std::vector<std::string> settings_of(const PushOptions& options);

/// @return the options by the keys that settings_of() gives for them
[[nodiscard]] std::map<std::string, std::string> options_of_keys();

}  // namespace mrroc::box_push
