// The control subsystem's side of the command protocol: numbers commands and repeats lost ones.
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <optional>

#include "base/effector.hpp"

namespace mrroc::ecp {

/// Numbers the commands of one session and goes back to the first lost one when the driver misses it. A
/// macrostep's command is made while the one before is executed, so its answer comes two commands later. What is not
/// numbered in a command goes out with every message, also with one that repeats an older command, and is the newest.
template <Effector E>
class BasicEffectorClient {
 public:
  using Command = typename E::Command;  ///< y_ce
  using Reply = typename E::Reply;      ///< x_ce

  /// Attempts at one command before the link counts as broken.
  static constexpr int kAttempts = 3;

  /// @param late_attempts  sendings of a command that the driver may have missed in a row: with the wall clock a
  ///        command or the one before it can be late, or its answer is skipped; it is sent again and is no failure.
  ///        0: in lock-step there is no lateness, and what the driver has not seen is lost
  explicit BasicEffectorClient(std::int64_t session, int late_attempts = 0)
      : session_(session), late_attempts_(late_attempts) {}

  /// Takes x_ce of a macrostep. Call it before next() for the same macrostep. Macrosteps may be skipped: every
  /// reply says which commands have been executed.
  void see(const Reply& reply);

  /// @param wanted     what the control subsystem decided; session and number are filled in here
  /// @param macrostep  in which it is to be executed
  /// @return what to send: the wanted command, or the oldest one that the driver has not executed; release
  ///         always goes out at once
  Command next(Command wanted, std::int64_t macrostep);

  /// @return the system error after kAttempts failures, with the wall clock late_attempts, in a row
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
    bool reset{};
  };
  /// @return a command for a macrostep before that one, of whose end nothing is known though it must have come: with
  ///         the wall clock, its answer was skipped; null: there is none
  [[nodiscard]] const Sent* unanswered(std::int64_t macrostep) const;
  /// Goes back to the oldest command that is not executed. @param s  what the driver has not got
  void send_again(const Reply& reply, const Sent& s);
  Sent& sent(std::int64_t macrostep) { return sent_[static_cast<std::size_t>(macrostep) % kRemembered]; }

  void settle_until(std::int64_t number);
  /// A driver without an owner does not count a command that it refuses: the ones after it get its number.
  /// One that has been reset counts from the beginning.
  /// @param macrostep  of the reply that told it @param by  less than before
  void count_anew(std::int64_t macrostep, std::int64_t by);

  std::int64_t session_;
  std::int64_t number_{};          // of the last command
  std::deque<Command> pending_;    // not known to be executed, oldest first
  std::size_t sent_of_pending_{};  // of these, sent and not given up
  std::array<Sent, kRemembered> sent_{};
  std::int64_t repeated_from_{};  // answers to commands before this macrostep are out of date
  int late_attempts_;
  int late_{};  // macrosteps in a row
  int failures_{};
  std::optional<Fault> fault_;
};

/// That of an arm's control subsystem.
using EffectorClient = BasicEffectorClient<ArmEffector>;

}  // namespace mrroc::ecp
