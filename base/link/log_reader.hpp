// Reads the record of a run: every message, in the order in which it was sent.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/link/decode.hpp"

namespace mrroc::link {

/// Name of the event log in a run folder.
inline constexpr std::string_view kEventLog = "events.lcmlog";

/// One message of a log.
struct LoggedMessage {
  std::int64_t time_us{};           ///< when it was written, wall time since 1970 [us]
  std::string channel;              ///< without the session, e.g. "arm1.order"
  std::vector<std::uint8_t> bytes;  ///< as they were on the wire
};

/// The header of a message, read without knowing its type.
struct RawHeader {
  /// As in header_t: session of the sender, number 1, 2, 3... of the channel, macrostep or step that it is for.
  std::int64_t session{};
  std::int64_t number{};
  std::int64_t stamp{};
};
/// @return the header of the bytes; zeros when they are too short for one
[[nodiscard]] RawHeader header_of(std::span<const std::uint8_t> bytes) noexcept;

/// The messages of an event log, but for those that are damaged (base/link/event_reader.hpp).
class LogReader {
 public:
  /// @param where  an event log, or a run folder
  /// @throws FaultError bad_log when the file is missing, is no file, or holds no message
  explicit LogReader(const std::filesystem::path& where);

  /// @param channel  without the session, e.g. "arm1.order"
  /// @return the messages of the channel by stamp; those that are not exactly an M are left out
  template <FixedMessage M>
  [[nodiscard]] std::map<std::int64_t, M> messages(std::string_view channel) const {
    std::map<std::int64_t, M> by_stamp;
    for (const LoggedMessage& logged : messages_)
      if (logged.channel == channel)
        if (const auto m = decode<M>(logged.bytes)) by_stamp.insert_or_assign(m->header.stamp, *m);
    return by_stamp;
  }

  /// @return every message, in the order in which they were written; one that came late, when it was sent again, stands
  ///         before the next one of its channel
  [[nodiscard]] const std::vector<LoggedMessage>& messages() const { return messages_; }
  /// @return every channel of the log
  [[nodiscard]] std::vector<std::string> channels() const;
  /// @return the session's name, which precedes every channel on the wire
  [[nodiscard]] const std::string& session() const { return session_; }
  /// @return the number of the run, which its own messages carry
  [[nodiscard]] std::int64_t session_id() const;
  /// @return how many stretches of the log are damaged and were left out
  [[nodiscard]] std::int64_t damaged() const { return damaged_; }

 private:
  void put_late_ones_in_their_place();

  std::string session_;
  std::vector<LoggedMessage> messages_;
  std::int64_t damaged_{};
};

}  // namespace mrroc::link
