// The build ID of a program: a hash of its code that the linker writes into the file, and that stripping keeps.
#pragma once
#include <filesystem>
#include <string>

namespace mrroc {

/// @param program  a file
/// @return its build ID in hexadecimal digits (NT_GNU_BUILD_ID of its ELF notes); empty: it cannot be read, is no program of
///         this kind of machine, or has none
[[nodiscard]] std::string build_id(const std::filesystem::path& program);

}  // namespace mrroc
