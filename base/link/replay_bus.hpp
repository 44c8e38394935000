// A transport that gives a process the messages that it received in a logged run, and compares what it sends
// with what it sent then.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/link/bus.hpp"
#include "base/link/log_reader.hpp"

namespace mrroc::link {

/// Thrown by ReplayBus::wait() when the log holds nothing more that the process listens to. Not an exception
/// of the library, so that nobody takes it for a fault.
struct LogEnded {};

/// Difference between a recomputed message and the logged one.
struct LogDifference {
  std::string channel{};     ///< without the session
  std::int64_t number{};     ///< of the message
  std::int64_t stamp{};      ///< macrostep or step that it is for
  std::string behaviour{};   ///< "3, hold"; empty when the process has none
  std::string function{};    ///< part of f' that made it: f_ce, f_cT...; empty when it is none of these
  std::string field{};       ///< name of the first field that differs; empty: the message as a whole
  std::string logged{};      ///< its value in the log; "nothing" when the message is not there
  std::string recomputed{};  ///< its value now
};

/// @param logged, recomputed  two messages of a channel
/// @return the first field in which they differ, headers included; nothing when they are the same
[[nodiscard]] std::optional<LogDifference> difference(std::string_view channel,
                                                      std::span<const std::uint8_t> logged,
                                                      std::span<const std::uint8_t> recomputed);

/// Plays the log to one process, message by message in the order of the log: each wait() gives the next one
/// that the process listens to. What says that the system stops at once is kept back until nothing else is left: when
/// it reached a process is not known, and until then the process worked on what it had. Used by one thread.
class ReplayBus final : public Bus {
 public:
  /// @param log       must outlive the bus
  /// @param left_out  channels without the session that the process is not to hear
  explicit ReplayBus(const LogReader& log, const std::set<std::string>& left_out = {});

  /// Which of the channels that the process sends are compared, and in which behaviour it is, both asked in
  /// publish() and wait(). Without it nothing is compared.
  struct Judge {
    std::function<bool(std::string_view channel)> compares;  ///< gets the channel with the session
    std::function<std::string()> behaviour;                  ///< name of the behaviour, for a difference
  };
  /// @param judge  asked from now on
  void set_judge(Judge judge) { judge_ = std::move(judge); }

  void publish(const Route& route, std::span<const std::uint8_t> bytes) override;
  void subscribe(const Route& route, Sink& sink) override;
  /// Nobody listens to everything in a replay.
  void subscribe_all(const std::string&, Sink&) override {}
  /// @return false at once when the time-out is zero. @throws LogEnded
  bool wait(std::chrono::milliseconds timeout) override;

  /// @return messages compared so far
  [[nodiscard]] std::int64_t compared() const { return compared_; }
  /// @return of these, those that differ from the log
  [[nodiscard]] std::int64_t differences() const { return differences_; }
  /// @return the first difference; nothing: there is none so far
  [[nodiscard]] const std::optional<LogDifference>& first() const { return first_; }
  /// @return messages in the log that the process has not sent again, by channel without the session
  [[nodiscard]] std::map<std::string, std::vector<std::int64_t>> not_sent() const;
  /// @return the first message that the process listens to and that the log lacks, "arm1.reply, number 12", or the
  ///         channel whose messages are of another version
  [[nodiscard]] std::string missing() const;

 private:
  struct Channel {
    std::map<std::int64_t, const LoggedMessage*> logged;  // by number
    std::int64_t sent{};                                  // number of the last message
  };
  [[nodiscard]] std::string bare(const std::string& channel) const;
  bool deliver(const LoggedMessage& m);
  [[nodiscard]] bool kept_back(const LoggedMessage& m) const;
  void note(const Route& route, std::span<const std::uint8_t> bytes, const Channel& channel);

  const LogReader& log_;
  std::set<std::string> left_out_;
  Judge judge_;
  std::map<std::string, std::vector<Sink*>, std::less<>> sinks_;  // by channel without the session
  std::map<std::string, Channel> channels_;
  std::size_t next_{};
  std::vector<const LoggedMessage*> kept_back_;
  std::size_t next_kept_back_{};
  std::int64_t compared_{};
  std::int64_t differences_{};
  std::optional<LogDifference> first_;
  bool behaviour_open_{};  // of first_: it is known when the process waits again
};

}  // namespace mrroc::link
