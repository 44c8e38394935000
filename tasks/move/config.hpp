// Configuration of the task, and the body of its ECP.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/link/child_main.hpp"
#include "tasks/move/agent.hpp"

namespace mrroc::any_motion {

/// @return the task's built-in configuration, tasks/move/move.toml
[[nodiscard]] std::string_view config();
/// @return the motions that are executed without a file, tasks/move/example.toml
[[nodiscard]] std::string_view example();

/// @return the body of an arm of the configuration; never null @throws ConfigError
using MakeBody = std::function<std::unique_ptr<Body>(const Config&, const std::string& arm)>;

/// @return keys of the arms, from [robots] order
[[nodiscard]] std::vector<std::string> arms_of(const Config& config);

/// @return the plan of [task] of a run's configuration @throws ConfigError; FaultError as make_plan()
[[nodiscard]] Plan read_plan(const Config& config, const MakeBody& make_body);

/// @return what [task] has to hold for a file: KEY=VALUE
/// @param file  not read yet  @param arms  keys of the cell  @throws ConfigError  naming file, line and key
[[nodiscard]] std::vector<std::string> settings_of(const Config& file, const std::vector<std::string>& arms);

/// Runs the control subsystem of one arm.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments,
             const MakeBody& make_body);

}  // namespace mrroc::any_motion
