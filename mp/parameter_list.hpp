// Lists the parameters of a task, for a person or a script that sets some.
#pragma once
#include <string>

#include "base/config.hpp"
#include "mp/options.hpp"

namespace mrroc::mp {

/// @param config  from which everything has been read
/// @param value   what the column of values is called: "default", or "value" when some were given
/// @return lines: key, value, range and unit; those of [task] come first. Keys that only options give are left out
[[nodiscard]] std::string parameter_table(const Config& config, const std::string& value = "default");

/// @return the same as a JSON list of key, default (or value), range and unit; null: there is none
[[nodiscard]] std::string parameter_json(const Config& config, const std::string& value = "default");

/// @return lines of what is true of the plant: key, unit, value, range, what controllers believe instead, meaning
[[nodiscard]] std::string truth_table(const Config& config, const std::string& value = "default");

/// @return the same as a JSON list
[[nodiscard]] std::string truth_json(const Config& config, const std::string& value = "default");

/// Prints one of these instead of a run, see TaskOptions::parameters.
/// @return exit status
int list_parameters(const Config& config, const TaskOptions& options);

}  // namespace mrroc::mp
