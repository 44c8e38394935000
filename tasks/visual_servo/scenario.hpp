// What the object does in a run, as settings of the world and the task.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"

namespace mrroc::visual_servo {

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

/// @return settings that stand for the options, to be put over the built-in TOML file and below what --set says
/// @throws FaultError bad_usage  there is no such scenario
[[nodiscard]] std::vector<std::string> settings_of(const ScenarioOptions& options);

}  // namespace mrroc::visual_servo
