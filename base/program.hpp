// Finds the running program's file and the programs beside it.
#pragma once
#include <sys/auxv.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "base/fault.hpp"

namespace mrroc {

/// @return the running program: the file itself, also when a symbolic link was called
[[nodiscard]] inline std::filesystem::path this_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

/// @return folder of the running program, in which the others of the framework are
[[nodiscard]] inline std::filesystem::path program_folder() { return this_program().parent_path(); }

/// @return another program of the framework: beside the running one, or beside the link by which that was called, as
///         projects outside of the tree have them
/// @throws FaultError start_failed: it is in neither place
[[nodiscard]] inline std::filesystem::path program_beside(const std::string& name) {
  // The kernel tells an address as a number.  NOLINTNEXTLINE(performance-no-int-to-ptr)
  const auto* const called = reinterpret_cast<const char*>(::getauxval(AT_EXECFN));
  const std::filesystem::path own = program_folder();
  const std::filesystem::path link =
      std::filesystem::absolute(called ? called : "").lexically_normal().parent_path();
  for (const std::filesystem::path& folder : {own, link})
    if (::access((folder / name).c_str(), X_OK) == 0) return folder / name;
  throw FaultError(
      FaultCode::start_failed,
      "there is no program " + name + " in " + own.string() + ", beside " +
          this_program().filename().string() + (link == own ? "" : ", nor in " + link.string()),
      "call the program that lies among all the others, as in build/release/bin, or a link to it; "
      "or build what is missing");
}

}  // namespace mrroc
