// Counts the files that this process has open: what a function has opened it must close.
#pragma once
#include <cstddef>
#include <filesystem>
#include <iterator>

namespace mrroc::test {

/// @return how many there are; the same number before and after means that none was left
inline std::ptrdiff_t open_files() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

}  // namespace mrroc::test
