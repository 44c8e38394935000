// The running program's file.
#pragma once
#include <filesystem>

namespace mrroc {

/// @return the running program
[[nodiscard]] inline std::filesystem::path this_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

/// @return folder of the running program, in which the others of the framework are
[[nodiscard]] inline std::filesystem::path program_folder() { return this_program().parent_path(); }

}  // namespace mrroc
