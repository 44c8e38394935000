// The configuration of one run of a task: where its keys come from, and what is refused before anything starts.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/config.hpp"
#include "mp/options.hpp"

namespace mrroc::launch {

/// @return whether the file of the options is the configuration of a run, which has everything
/// @throws ConfigError
bool is_of_run(const mp::TaskOptions& options);

/// @return a task's configuration: its own, over it what the task finds out, over that the file of the options, over
///         that their settings. A file that a run has left has everything: it stands alone, without what belonged to
///         that run, such as its folder. For a check that of the run.
/// @param built_in  TOML  @param task  its name  @param found  KEY=VALUE that the task finds out
/// @throws ConfigError
Config load_task_config(const mp::TaskOptions& options, std::string_view built_in, const std::string& task,
                        const std::vector<std::string>& found = {});

/// @return the seed of a run with a configuration as load_task_config() gives it, in which that of the command line is
/// @throws ConfigError
std::uint64_t seed_of(const Config& config);

/// Checks options that would be refused only at the start of the system. @throws FaultError
void check_task_options(const mp::TaskOptions& options);

/// Fixes what belongs to one run alone, and checks that every key is known.
/// @param strokes  file along which the simulator's hands lead; empty: none
/// @param film     whether cameras leave pictures, by default in the folder
/// @throws ConfigError
void complete_config(Config& config, const mp::TaskOptions& options, const std::filesystem::path& folder,
                     const std::string& strokes, bool film = false);

}  // namespace mrroc::launch
