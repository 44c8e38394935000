// The last messages that the processes of a task wrote for people.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/fault.hpp"
#include "base/link/bus.hpp"
#include "mrroc/console_t.hpp"
#include "ui_cli/snapshot.hpp"

namespace mrroc::ui {

/// One line.
struct Message {
  std::string process;  ///< that logged it; empty: not known
  FaultCode code{};     ///< none: information
  std::string text;     ///< without control characters
  /// simulated time [s]: of the macrostep that the process had come to, or else of the status before; nothing for a line
  /// that is older than this log
  std::optional<double> time{};
};

/// Listens to SESSION.PROCESS.console of every process that the task's status names.
class MessageLog final : public link::Sink {
 public:
  /// Lines that are kept.
  static constexpr std::size_t kKept = 64;

  /// @param bus must outlive the log
  MessageLog(link::Bus& bus, std::string session);

  /// Listens to processes of the status's session that it did not know, and takes the status's last message,
  /// unless that is a line which it has heard from the process itself.
  void follow(const Snapshot& s);
  /// @param count how many at most
  /// @return the newest lines, oldest first
  [[nodiscard]] std::vector<Message> newest(std::size_t count) const;

  void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;

 private:
  struct Line {
    console_t said{};
    std::optional<double> time;
  };
  void keep(const Line& line) noexcept;

  link::Bus& bus_;
  std::string session_;
  std::int64_t session_id_{};
  std::set<std::string> known_;
  std::array<Line, kKept> lines_{};
  double sim_time_{};     // of the newest status [s]
  double macrostep_s_{};  // 0: not known yet
  std::size_t count_{};   // of all lines so far; the newest is at (count_ - 1) % kKept
  std::string last_message_;
};

}  // namespace mrroc::ui
