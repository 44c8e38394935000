// Writes the record of a run: every message of the group agents, in LCM's event-log format.
#pragma once
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/link/bus.hpp"

namespace mrroc::link {

/// Name of the file in a run folder that holds the end of a log that was longer than its bound.
inline constexpr std::string_view kEventTail = "events-tail.lcmlog";

/// @return `log.limit_mb`: how large a log may grow [bytes] @throws ConfigError
inline std::uintmax_t read_log_limit(const Config& config) {
  constexpr std::uintmax_t kMegabyte = 1'000'000;
  return static_cast<std::uintmax_t>(config.number("log.limit_mb", 4000, {1, 1e6}, "MB")) * kMegabyte;
}

/// A message that came when the log had reached its bound.
struct LeftOut {
  std::string channel;              ///< with the session's name
  std::int64_t time_us{};           ///< when it came, wall time since 1970 [us]
  std::vector<std::uint8_t> bytes;  ///< as they were on the wire
};

/// The contents of a log at one moment, for a reader that comes to it while the log goes on.
struct LogEnd {
  std::uintmax_t size{};  ///< of the file [bytes]
  std::vector<std::shared_ptr<const LeftOut>>
      tail{};  ///< what the file had no room for, oldest first, as far as it is kept
};

/// Writes what it receives of one session; messages of another one with the same name are left out. Repeated messages
/// are written once, also those that were missing until they were repeated; missing numbers are counted, and what has
/// numbers beyond all bounds is left out. On a channel with several senders numbers say nothing: everything is written and
/// nothing is counted. A log that has reached its bound ends there; what comes afterwards is kept in memory, kTail bytes of
/// it. After a write that failed, or memory that it lacked, nothing more is written: the room that is left is for others.
class EventLog final : public Sink {
 public:
  /// @param session  as in header_t::session
  /// @param limit    largest size of the file [bytes]
  /// @throws FaultError cannot_write
  EventLog(const std::filesystem::path& file, std::int64_t session, std::uintmax_t limit = UINTMAX_MAX);
  ~EventLog() override;
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;
  [[nodiscard]] std::size_t largest() const noexcept override;

  /// @return numbers that are missing in the log so far
  [[nodiscard]] std::int64_t gaps() const { return gaps_; }
  /// Writes down everything that has been received.
  /// @return false when that, or anything before, could not be written: the disk is full, for instance
  bool flush() noexcept;
  /// @return what it holds now. Costs one pointer per message of the tail. Call flush() before a reader opens the file
  [[nodiscard]] LogEnd end() const { return {size_, {tail_.begin(), tail_.end()}}; }
  /// @return messages that came when the log had reached its bound
  [[nodiscard]] std::int64_t left_out() const { return left_out_; }
  /// Writes a log of the last of them to another file; none: does nothing.
  void write_tail(const std::filesystem::path& file) const;
  /// What is kept of them [bytes of the file]: more than five seconds of two arms, as the black box wants them.
  static constexpr std::size_t kTail = 4'000'000;
  /// @return whether something could not be written so far, or not be kept for want of memory
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  struct File;
  /// Numbers of one channel.
  struct Heard {
    std::int64_t last{};
    std::set<std::int64_t> missing{};  // below it
  };
  void take(std::string_view channel, std::span<const std::uint8_t> bytes);
  void keep(std::string_view channel, std::int64_t time_us, std::span<const std::uint8_t> bytes);
  /// @return whether it is to be written
  bool note(std::int64_t number, Heard& heard);

  std::unique_ptr<File> file_;
  std::map<std::string, Heard, std::less<>> heard_;  // by channel
  std::int64_t session_;
  std::int64_t events_{};
  std::int64_t gaps_{};
  std::uintmax_t limit_, size_{};
  std::int64_t left_out_{};
  std::deque<std::shared_ptr<const LeftOut>> tail_;
  std::size_t tail_size_{};
  bool failed_{};
};

}  // namespace mrroc::link
