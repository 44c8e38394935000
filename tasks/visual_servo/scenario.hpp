// Scenarios of a run: the object's motion, as settings of the simulator and the task.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"

namespace mrroc {
class CommandLine;
}  // namespace mrroc

namespace mrroc::visual_servo {

/// Options that say what the configuration of a run says.
inline constexpr std::array<const char*, 4> kScenarioOptions{"--scenario", "--object", "--aggregation",
                                                             "--cameras"};

/// The choices of the command line.
struct ScenarioOptions {
  std::string scenario{"rest"};      ///< name of one of scenarios()
  std::string object{"chessboard"};  ///< chessboard or apriltag
  std::string aggregation;           ///< empty: as the configuration says
  std::string cameras;               ///< sac or eih alone; empty or both: as the configuration says
};

/// Names for --scenario, and what each is.
struct Scenario {
  std::string_view name;              ///< for --scenario
  std::string_view about;             ///< what the object does, for --help
  std::vector<std::string> settings;  ///< KEY=VALUE, over the task's TOML file
};
/// @return all that there are
[[nodiscard]] const std::vector<Scenario>& scenarios();

/// Adds the options to a program's command line.
void add_scenario_options(CommandLine& line, ScenarioOptions& options);

/// @return settings that stand for the options, to be put over the built-in TOML file and below what --set says
/// @throws FaultError bad_usage  there is no such scenario
[[nodiscard]] std::vector<std::string> settings_of(const ScenarioOptions& options);

}  // namespace mrroc::visual_servo
