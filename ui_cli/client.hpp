// A terminal's connection with a running task: receives its status, and sends orders to it.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/fault.hpp"
#include "base/link/bus.hpp"
#include "base/link/session.hpp"
#include "base/operator.hpp"
#include "mrroc/operator_answer_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/task_status_t.hpp"
#include "ui_cli/snapshot.hpp"

namespace mrroc::ui {

using Clock = std::chrono::steady_clock;  ///< of everything that a terminal waits for

/// Time limits of a terminal.
struct Timeouts {
  std::chrono::milliseconds repeat{100};    ///< between the sendings of an order that is not answered
  std::chrono::milliseconds give_up{5000};  ///< until a task that says nothing is given up
  /// Until drivers that rest speak for a task that says nothing: two of their signs of life.
  std::chrono::milliseconds drivers{1500};
  std::chrono::milliseconds told{2000};      ///< until a person is told that it is waited for what was taken
  std::chrono::milliseconds progress{5000};  ///< until he is told how far that is, again and again
  std::chrono::milliseconds repeat_emergency{20};  ///< between those of an emergency stop
};

/// The task's answer to an order.
struct Answer {
  OperatorOrder order{};  ///< that is answered
  bool accepted{};        ///< false: refused, text says why
  std::string text;       ///< reason of a refusal, or what was done; without control characters
  FaultCode code{};       ///< what went wrong with an order that the task had taken; none: it was refused
};

/// Sends orders to a task and hears its status. An order has a random number and is sent again and again
/// until the task answers that number; the task answers every sending and obeys once. All of it goes through
/// Group::agents, on the channels SESSION.operator, SESSION.answer and SESSION.task_status; what the effector drivers do
/// is heard from themselves, on SESSION.PROCESS.status. Used by one thread; nothing in here looks at a clock but order() and await_status().
class Client {
 public:
  /// @param bus must outlive the client
  /// @param session of the task; id 0: unknown, it is taken from the first status that comes
  Client(link::Bus& bus, link::SessionInfo session, Timeouts timeouts = {});
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// @return of the task; its id is 0 until it is known
  [[nodiscard]] const link::SessionInfo& session() const { return session_; }

  /// Takes in what has come, waits for the first message if there is none.
  void receive(std::chrono::milliseconds timeout) { bus_.wait(timeout); }

  /// @return how many status messages have come; it grows with each
  [[nodiscard]] std::int64_t news() const { return status_.count; }
  /// @return the newest status, or nothing before the first
  [[nodiscard]] std::optional<Snapshot> status() const;

  /// Begins with an order; nothing more is heard of one that is pending.
  void begin(OperatorOrder order, Clock::time_point now);
  /// @return whether an order waits for its answer
  [[nodiscard]] bool pending() const { return pending_.has_value(); }
  /// Sends the order when it is time, and looks for the answer. Call it often.
  /// @return the answer, once; of a stop, when every process of the task has confirmed it, or has been ended
  /// @throws FaultError peer_silent, once, when no answer has come for Timeouts::give_up; sooner, when the task has been
  ///         silent since the order and every effector driver says that its arm rests. It tells what the drivers say
  std::optional<Answer> poll(Clock::time_point now);

  /// Gives an order and waits for its answer.
  /// @throws FaultError peer_silent
  Answer order(OperatorOrder order);
  /// Waits for the first status.
  /// @throws FaultError peer_silent
  Snapshot await_status();

 private:
  struct StatusSink final : link::Sink {
    void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;
    std::int64_t session{};  ///< 0: of the first that comes
    std::int64_t count{};
    task_status_t newest{};
  };
  struct AnswerSink final : link::Sink {
    void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;
    std::int64_t session{};
    std::int64_t wanted{};  ///< number of the order, 0: none
    std::optional<operator_answer_t> found;
  };
  struct DriverSink final : link::Sink {
    /// A driver's messages since the order, newest last.
    struct Said {
      std::int64_t count{}, step_before{}, step{};
      int effector{};
    };
    void receive(std::string_view channel, std::span<const std::uint8_t> bytes) noexcept override;
    std::int64_t session{};
    std::size_t prefix{};                           ///< of the channels, to leave out
    std::map<std::string, Said, std::less<>> said;  ///< by the name of the arm
  };
  struct Pending {
    OperatorOrder order{};
    std::int64_t id{};
    Clock::time_point begun, since;
    std::int64_t news{};  ///< when it began
    std::optional<Clock::time_point> sent;
  };

  void send();
  [[nodiscard]] bool drivers_rest() const;
  [[nodiscard]] std::string describe_drivers() const;
  [[noreturn]] void give_up(const std::string& waited_for, bool stops = false) const;

  link::Bus& bus_;
  link::SessionInfo session_;
  Timeouts timeouts_;
  StatusSink status_;
  AnswerSink answer_;
  DriverSink drivers_;
  std::optional<Pending> pending_;
  std::int64_t number_{};  // of the last sending; several terminals may send, so the task goes by Pending::id
};

}  // namespace mrroc::ui
