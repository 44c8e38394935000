// Loads a run folder into the record that a page shows.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "ui_cli/view/record.hpp"
#include "ui_cli/view/scene.hpp"

namespace mrroc::view {

/// Fills the record with a whole run. Value "summary": summary.json, if the run has one.
/// @return the pictures of the folder, as in pictures_of()
/// @throws FaultError bad_log: it is no run folder, or its log cannot be read; bad_configuration
std::vector<std::string> load_run(const std::filesystem::path& folder, Record& record);

/// @return PNG files of a run folder and of its plots/, relative to it with '/': those of the cameras first, then
///         the plots, each in the order of their names; at most 64, empty when there is no such folder
[[nodiscard]] std::vector<std::string> pictures_of(const std::filesystem::path& folder);

/// Reads what the folder's config.toml says of the cell.
/// @throws FaultError bad_usage: there is none; bad_configuration
[[nodiscard]] Scene scene_of(const std::filesystem::path& folder);

/// Puts summary.json of the folder into the record, if there is a sound one, and a line for the fault that it names.
void load_summary(const std::filesystem::path& folder, Record& record);

}  // namespace mrroc::view
