// Reads the record of a run: every message, in the order in which it was written.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/link/decode.hpp"

namespace mrroc::link {

/// The messages of an event log, by channel without the session's name.
class LogReader {
 public:
  /// @throws FaultError bad_log when the file is missing or is no event log
  explicit LogReader(const std::filesystem::path& file);

  /// @param channel  without the session, e.g. "arm1.order"
  /// @return the messages of the channel by stamp; those that are not exactly an M are left out
  template <FixedMessage M>
  [[nodiscard]] std::map<std::int64_t, M> messages(const std::string& channel) const {
    std::map<std::int64_t, M> by_stamp;
    if (const auto it = bytes_.find(channel); it != bytes_.end())
      for (const auto& bytes : it->second)
        if (const auto m = decode<M>(bytes)) by_stamp.insert_or_assign(m->header.stamp, *m);
    return by_stamp;
  }

  /// @return every channel of the log
  [[nodiscard]] std::vector<std::string> channels() const;

 private:
  std::map<std::string, std::vector<std::vector<std::uint8_t>>> bytes_;
};

}  // namespace mrroc::link
