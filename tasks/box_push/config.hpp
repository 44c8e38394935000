// Everything that the task reads from the configuration, and the bodies of its processes.
#pragma once
#include <string_view>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "tasks/box_push/coordinator.hpp"

namespace mrroc::box_push {

/// @return the task's built-in configuration, tasks/box_push/box_push.toml
std::string_view config();

/// @return [task] of the coordinator, [room], and what the box is believed to be like: [task.box]
/// @throws ConfigError; FaultError bad_configuration: the goal has no room around it
[[nodiscard]] CoordinatorParameters read_coordinator(const Config& config);
/// @return [task] of the platforms' agents @throws ConfigError
[[nodiscard]] PusherParameters read_pusher(const Config& config);

/// Body of the ECP of a platform.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);
/// Body of the process of a map agent. @param arguments  key of its platform
void run_map(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::box_push
