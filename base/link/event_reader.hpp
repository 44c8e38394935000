// Reads the events of a log in LCM's format one after the other, whatever the bytes are. LCM's own reader
// ends at the first event that it does not understand.
#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mrroc::link {

/// One event of a log. It points into the reader, and holds until the next call.
struct LogEvent {
  std::int64_t time_us{};               ///< when it was written, wall time since 1970 [us]
  std::string_view channel;             ///< 1..kLongestChannel printable characters
  std::span<const std::uint8_t> bytes;  ///< of the message, at most kLargestDatagram
};

/// Reads a log from its beginning to its end. An event begins with a word that tells it from others; one whose lengths
/// are out of bounds, whose channel is no text, or behind which none begins, is damaged. It is left out, and the reader
/// goes on at the next such word.
class EventReader {
 public:
  /// @param from  where in the file it begins [bytes]; what is left of an event there counts as damaged
  /// @param to    where it ends at the latest [bytes]; what the file holds behind it is not read
  /// @throws FaultError bad_log: there is no such file, it is no file, or it cannot be read
  explicit EventReader(const std::filesystem::path& file, std::uintmax_t from = 0,
                       std::uintmax_t to = UINTMAX_MAX);

  /// @return the next sound event; nothing at the end
  [[nodiscard]] std::optional<LogEvent> next();
  /// @return how many stretches of the file were left out so far; the end of a log that was cut off is one, too
  [[nodiscard]] std::int64_t damaged() const { return damaged_; }

 private:
  [[nodiscard]] bool fill(std::size_t bytes);
  [[nodiscard]] bool find_word();
  [[nodiscard]] bool word_at(std::size_t offset);
  [[nodiscard]] std::optional<LogEvent> event_here(std::size_t& size);

  std::ifstream file_;
  std::vector<std::uint8_t> buffer_;
  std::uintmax_t left_;  // that may be read [bytes]
  std::size_t at_{};     // of what is not read yet, in the buffer
  std::int64_t damaged_{};
};

}  // namespace mrroc::link
