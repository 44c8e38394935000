// The record of a run: every message of the group agents, in LCM's event-log format.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "base/link/bus.hpp"

namespace mrroc::link {

/// Writes what it receives of one session; messages of another one with the same name are left out. Repeated messages
/// are written once, also those that were missing until they were repeated; missing numbers are counted. On a channel
/// with several senders numbers say nothing: everything is written and nothing is counted.
class EventLog final : public Sink {
 public:
  /// @param session  as in header_t::session
  /// @throws FaultError cannot_write
  EventLog(const std::filesystem::path& file, std::int64_t session);
  ~EventLog() override;
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;

  /// @return numbers that are missing in the log so far
  [[nodiscard]] std::int64_t gaps() const { return gaps_; }
  /// Writes down everything that has been received.
  /// @return false when that, or anything before, could not be written: the disk is full, for instance
  bool flush() noexcept;
  /// @return whether something could not be written so far
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  struct File;
  /// Numbers of one channel.
  struct Heard {
    std::int64_t last{};
    std::set<std::int64_t> missing{};  // below it
  };
  /// @return whether it is to be written
  bool note(std::int64_t number, Heard& heard) noexcept;

  std::unique_ptr<File> file_;
  std::map<std::string, Heard, std::less<>> heard_;  // by channel
  std::int64_t session_;
  std::int64_t events_{};
  std::int64_t gaps_{};
  bool failed_{};
};

}  // namespace mrroc::link
