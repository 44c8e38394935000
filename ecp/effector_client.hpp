// The control subsystem's side of the command protocol: numbers commands and repeats what was lost.
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "base/effector_command.hpp"

namespace mrroc::ecp {

/// Numbers the commands of one session and goes back to the first lost one when the driver misses it. A
/// macrostep's command is made while the one before is executed, so its answer comes two commands later.
class EffectorClient {
 public:
  /// Attempts at one command before the link counts as broken.
  static constexpr int kAttempts = 3;

  explicit EffectorClient(std::int64_t session) : session_(session) {}

  /// Takes x_ce of a macrostep. Call it before next() for the same macrostep.
  void see(const EffectorReply& reply);

  /// @param wanted     what the control subsystem decided; session and number are filled in here
  /// @param macrostep  in which it is to be executed
  /// @return what to send: the wanted command, or the oldest one that the driver has not executed; release
  ///         always goes out at once
  EffectorCommand next(EffectorCommand wanted, std::int64_t macrostep);

  /// @return the system error after kAttempts failures in a row
  [[nodiscard]] const std::optional<Fault>& fault() const { return fault_; }
  /// @return commands that wait because earlier ones had to be repeated
  [[nodiscard]] std::size_t backlog() const { return pending_.size() - sent_of_pending_; }
  /// @return whether every command is known to be executed or refused
  [[nodiscard]] bool settled() const { return pending_.empty(); }

 private:
  static constexpr std::size_t kRemembered = 16;
  struct Sent {
    std::int64_t macrostep{-1};
    std::int64_t number{};
  };
  Sent& sent(std::int64_t macrostep) { return sent_[static_cast<std::size_t>(macrostep) % kRemembered]; }

  std::int64_t session_;
  std::int64_t number_{};                // of the last command
  std::deque<EffectorCommand> pending_;  // not known to be executed, oldest first
  std::size_t sent_of_pending_{};        // of these, sent and not given up
  std::array<Sent, kRemembered> sent_{};
  std::int64_t repeated_from_{};  // answers to commands before this macrostep are out of date
  int failures_{};
  std::optional<Fault> fault_;
};

}  // namespace mrroc::ecp
