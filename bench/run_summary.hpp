// Reads the summary of a run.
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>

namespace mrroc::bench {

/// @return summary.json of a run folder; null when there is none, or it is damaged
nlohmann::json run_summary(const std::filesystem::path& folder);
/// @return the same
/// @throws FaultError internal_error: there is none, or it is damaged
nlohmann::json needed_summary(const std::filesystem::path& folder);

}  // namespace mrroc::bench
