// The record of a run: every message of the group agents, in LCM's event-log format.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "base/link/bus.hpp"

namespace mrroc::link {

/// Writes what it receives. Repeated messages are written once; missing numbers are counted.
class EventLog final : public Sink {
 public:
  /// @throws FaultError cannot_write
  explicit EventLog(const std::filesystem::path& file);
  ~EventLog() override;
  EventLog(const EventLog&) = delete;
  EventLog& operator=(const EventLog&) = delete;

  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;

  /// @return numbers that are missing in the log so far
  [[nodiscard]] std::int64_t gaps() const { return gaps_; }

 private:
  struct File;
  std::unique_ptr<File> file_;
  std::map<std::string, std::int64_t, std::less<>> last_;  // number by channel
  std::int64_t events_{};
  std::int64_t gaps_{};
};

}  // namespace mrroc::link
