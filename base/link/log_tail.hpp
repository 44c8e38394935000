// Reads the end of an event log without its beginning.
#pragma once
#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/link/log_reader.hpp"

namespace mrroc::link {

/// The last messages of a log.
struct LogTail {
  std::vector<LoggedMessage> messages;  ///< in the order in which they were written
  bool whole{};                         ///< they are all that the log holds
};

/// Reads at most so many bytes of a log, from its end. An event that is cut off at either end is left out; so is what
/// stands between events and is none. Of a file that cannot be read, and of one that grows meanwhile, it takes what is there.
/// @param most  [bytes]
/// @param end   where in the file the log ends at the latest [bytes]: what was written later is left out
[[nodiscard]] LogTail read_tail(const std::filesystem::path& file, std::uintmax_t most,
                                std::uintmax_t end = UINTMAX_MAX);

}  // namespace mrroc::link
