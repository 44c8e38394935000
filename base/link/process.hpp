// One process of a running system: its links, its life from assembling to the end, and the one function in
// which it waits.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/fault.hpp"
#include "base/link/bus.hpp"
#include "base/link/channel.hpp"
#include "base/link/vigil.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/process_status_t.hpp"
#include "mrroc/supervisor_t.hpp"

namespace mrroc::link {

/// State of a process, as it tells the supervisor.
/// dead: the supervisor has found that it is gone.
enum class ProcessState : std::uint8_t { starting, ready, running, done, faulted, dead };
/// @return name of the state, as terminals show it
std::string_view to_string(ProcessState s);

/// @param until  what the behaviour waited for, in words; may be empty
/// @param lasted  how long it lasted, with the unit
/// @return "NAME: UNTIL", or, without a reason, "NAME, ended after LASTED"
[[nodiscard]] std::string end_of_behaviour(std::string_view name, std::string_view until,
                                           std::string_view lasted);

/// What the supervisor tells everybody.
enum class Phase : std::uint8_t {
  assembling,  ///< wait until everybody is there
  running,
  stopping,  ///< no more commands: effectors come to rest and hold
  finished,  ///< end now
};

/// How a process belongs to its system.
struct Membership {
  std::string session{"mrroc"};     ///< name of the system; prefix of every channel
  std::int64_t session_id{1};       ///< distinguishes runs with the same name
  std::string name;                 ///< of this process, as in the roster
  std::vector<std::string> roster;  ///< all processes, the supervisor's own name first
  /// What decides when the process goes on.
  ClockKind clock{ClockKind::step};
  /// How long a message that must come is waited for [wall time]; 0: for ever
  std::chrono::milliseconds patience{kPatience};
  /// How long it goes on without a word of the supervisor [wall time]; with patience 0 for ever
  std::chrono::milliseconds alone{kAlone};
  /// How long a macrostep lasts [wall time]; 0: as short as it can be
  std::chrono::microseconds macrostep{0};
  bool replayed{};  ///< the process runs once more on the log of a run, see base/link/log_check.hpp
};

/// Thrown in a replay by a process that needs what no message of a log carries.
struct NotInLog {
  std::string what;  ///< in words, for the report of the check
};

/// A process's connection with its system. Used by one thread.
class Process {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time of patience and signs of life

  /// @param bus must outlive the process
  Process(Bus& bus, Membership membership);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// @return as it was made with
  [[nodiscard]] const Membership& membership() const { return membership_; }
  /// @return for links; the same for all of the process
  [[nodiscard]] Bus& bus() { return bus_; }
  /// @return whether every message that is needed is waited for
  [[nodiscard]] bool lock_step() const { return membership_.clock == ClockKind::step; }

  /// @param name without the session, e.g. "arm1.command"
  [[nodiscard]] Route route(const std::string& name, Group group = Group::agents) const;

  /// A link that is watched: what was wrong on it is told at the end.
  template <FixedMessage M>
  std::unique_ptr<Inbox<M>> inbox(const std::string& name, Group group = Group::agents) {
    if (group != Group::agents) needs_unlogged("the servo links");
    auto box = std::make_unique<Inbox<M>>(bus_, route(name, group), membership_.session_id);
    inboxes_.push_back(box.get());
    return box;
  }
  /// A link on which the run is fingerprinted and repaired.
  /// @throws FaultError internal_error when the process has more links than its status can tell about
  template <FixedMessage M>
  std::unique_ptr<Outbox<M>> outbox(const std::string& name, Group group = Group::agents) {
    if (group != Group::agents) needs_unlogged("the servo links");
    auto box = std::make_unique<Outbox<M>>(bus_, route(name, group), membership_.session_id);
    add(*box);
    return box;
  }
  /// @param channel  with the session @return whether one of the outboxes publishes there, or did
  [[nodiscard]] bool sends(std::string_view channel) const;

  /// Says that this process uses something that is not in the log of a run, such as pictures.
  /// @throws NotInLog in a replay
  void needs_unlogged(const std::string& what) const {
    if (membership_.replayed) throw NotInLog{what + " are not in the log"};
  }

  /// Says which behaviour decides on what is sent from now on: every agent tells it here. When it is another one than
  /// before, the supervisor hears of it, and of why that one ended, at once.
  /// @param name, until  of a row (base/motion.hpp), which live as long as the program
  void in_behaviour(int m, std::string_view name, std::string_view until = {});
  /// @return it as "3, hold"; empty before the first one
  [[nodiscard]] std::string behaviour() const;

  /// Tells the supervisor that this process is ready and waits until all are (rule R2). Make all inboxes
  /// before.
  /// @return false when the system ends before it has begun
  bool assemble();

  /// Waits until ready() holds. Everything else that has to be done goes on in here: messages arrive, own
  /// messages are repeated when the wait is long, the supervisor hears that this process lives.
  /// @param deadline gives up then
  /// @return the last value of ready()
  template <class Ready>
  bool await(Ready ready, Clock::time_point deadline = Clock::time_point::max()) {
    if (ready()) return true;
    waiting_since_ = Clock::now();
    while (!ready()) {
      if (deadline != Clock::time_point::max() && Clock::now() >= deadline) return false;
      service(deadline);
    }
    return true;
  }

  /// Like await(), for messages that must come: it does not wait for ever.
  /// @param sources  where they come from; must live as long as the wait
  /// @param silent   what it means when they do not: peer_silent or hardware_silent
  /// @throws FaultError after Membership::patience `silent`, with channel, time and counters; after a fifth of
  ///         it malformed_message when one of the channels has brought nothing else
  template <class Ready>
  void await_from(const Sources& sources, FaultCode silent, Ready ready) {
    if (ready()) return;
    waiting_since_ = Clock::now();
    const Vigil vigil(sources, silent, membership_.patience);
    while (!ready()) {
      vigil.check(Clock::now());
      service(vigil.deadline());
    }
  }

  /// Handles what has arrived, without waiting for more than a moment.
  void poll();

  /// @return what the supervisor said last
  [[nodiscard]] Phase phase() const;
  /// @return whether the system stops or has ended
  [[nodiscard]] bool over() const { return phase() >= Phase::stopping; }
  /// @return first macrostep in which nothing is commanded any more; only meaningful when over()
  [[nodiscard]] std::int64_t stop_as_of() const;
  /// @return whether the supervisor has declared that process dead
  [[nodiscard]] bool dead(const std::string& name) const;

  /// How far this process is, for the supervisor.
  void report_progress(std::int64_t macrostep, std::int64_t step);
  /// With the wall clock: so many steps, macrosteps or periods have been passed over because this process, or
  /// a message, was late. The supervisor writes it down.
  void report_skipped(std::int64_t count);
  /// What the world reports about arms at rest.
  void report_rest(bool at_rest, const std::array<int, 4>& stop_steps);
  /// A line for the operator and the log.
  void say(const std::string& text, FaultCode code = FaultCode::none);
  /// Says that this process has ended, with the fingerprints of what it sent, and what was wrong on the links
  /// that it read. Its links must still be there.
  void report_done();
  /// Stays, with everything done, until the system has ended: a peer may still need a message repeated. Its
  /// links must still be there.
  void stay();
  /// Says that this process has ended because of a fault.
  void report_fault(const Fault& fault);

  /// Called in every service, for the supervisor's own duties.
  std::function<void()> on_service;

 private:
  void add(OutboxBase& box);
  void service(Clock::time_point deadline);
  void send_status();
  void say_counters();
  void check_supervisor();

  Bus& bus_;
  Membership membership_;
  std::vector<OutboxBase*> outboxes_;
  std::vector<const InboxBase*> inboxes_;
  std::vector<std::string> sent_;  // channels of the outboxes, which may be gone
  Outbox<process_status_t> status_out_;
  Outbox<console_t> console_out_;
  Inbox<supervisor_t> supervisor_in_;
  process_status_t status_{};
  int m_{};
  std::string_view behaviour_, until_;  // of a row, which lives as long as the program
  std::int64_t behaves_since_{};        // macrostep
  Clock::time_point last_status_{};
  Clock::time_point waiting_since_{};  // or since own messages were repeated
  Clock::time_point supervisor_heard_{Clock::now()};
  std::int64_t heard_{};  // messages of the supervisor
};

}  // namespace mrroc::link
