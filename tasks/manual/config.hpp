// Configuration of manual operation, and the body of its ECP.
#pragma once
#include <string_view>
#include <vector>

#include "base/link/child_main.hpp"
#include "tasks/manual/arm.hpp"
#include "tasks/manual/instruction_script.hpp"

namespace mrroc::manual {

/// @return the task's built-in configuration, tasks/manual/manual.toml
[[nodiscard]] std::string_view config();

/// @return arms and their presets, from [robots]: order, ARM.axes and the table ARM.presets of joints
/// @throws ConfigError
[[nodiscard]] std::vector<ArmInfo> read_arms(const Config& config);

/// @return memory of an arm's agent at the beginning @throws ConfigError
[[nodiscard]] Memory read_memory(const Config& config, const std::string& arm);

/// Runs the control subsystem of one arm.
/// @param reach  of that arm
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments,
             const Reach& reach);

}  // namespace mrroc::manual
