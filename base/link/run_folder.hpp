// Checks the folder of a finished run, for all programs that read one.
#pragma once
#include <filesystem>

namespace mrroc::link {

/// Call this with the folder that the user gave as a run, before reading anything of it.
/// @return the folder
/// @throws FaultError bad_log: there is no such folder, or it has no log or no configuration; says where runs are
std::filesystem::path checked_run_folder(const std::filesystem::path& folder);

}  // namespace mrroc::link
