// The folder of a run that has been, as all programs take it that read one.
#pragma once
#include <filesystem>

namespace mrroc::link {

/// To be called with what a person gave as a run, before anything of it is read.
/// @return the folder
/// @throws FaultError bad_log: there is no such folder, or it has no log or no configuration; says where runs are
std::filesystem::path checked_run_folder(const std::filesystem::path& folder);

}  // namespace mrroc::link
