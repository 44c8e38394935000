// One process of a running system: its links, its life from assembling to the end, and the one function in
// which it waits.
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "base/fault.hpp"
#include "base/link/bus.hpp"
#include "base/link/channel.hpp"
#include "base/link/heartbeat_monitor.hpp"
#include "base/link/receive_deadline.hpp"
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

/// Phase of a run, which the supervisor tells all processes.
enum class Phase : std::uint8_t {
  assembling,  ///< wait until everybody is there
  running,
  stopping,  ///< no more commands: effectors come to rest and hold
  finished,  ///< end now
};

/// A node's identity and settings in its system.
struct NodeContext {
  std::string session{"mrroc"};     ///< name of the system; prefix of every channel
  std::int64_t session_id{1};       ///< distinguishes runs with the same name
  std::string name;                 ///< of this process, as in the roster
  std::vector<std::string> roster;  ///< all processes, the supervisor's own name first
  /// Condition for the process to go on.
  ClockKind clock{ClockKind::step};
  /// How long a message that must come is waited for [wall time]; 0: for ever
  std::chrono::milliseconds timeout{kReceiveTimeout};
  /// How long it goes on without a word of the supervisor [wall time]; 0, or with timeout 0: for ever
  std::chrono::milliseconds alone{kAlone};
  /// How long a macrostep lasts [wall time]; 0: as short as it can be
  std::chrono::microseconds macrostep{0};
  bool replayed{};  ///< the process runs once more on the log of a run, see base/link/log_check.hpp
};

/// With the wall clock a process that has heard nothing of its supervisor for so long comes to rest by itself: arms that
/// move need somebody who can stop them. The supervisor gives a sign of life ten times a second.
inline constexpr std::chrono::milliseconds kSupervisorSilent{700};

/// Thrown in a replay by a process that needs what no message of a log carries.
struct NotInLog {
  std::string what;  ///< in words, for the report of the check
};

/// A process's connection with its system. Used by one thread.
class Process {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time of timeouts and signs of life

  /// @param bus must outlive the process
  Process(Bus& bus, NodeContext context);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// @return as it was made with
  [[nodiscard]] const NodeContext& context() const { return context_; }
  /// @return for links; the same for all of the process
  [[nodiscard]] Bus& bus() { return bus_; }
  /// @return whether every message that is needed is waited for
  [[nodiscard]] bool lock_step() const { return context_.clock == ClockKind::step; }

  /// @param name without the session, e.g. "arm1.command"
  [[nodiscard]] Route route(const std::string& name, Group group = Group::agents) const;

  /// A link that is watched: what was wrong on it is told at the end.
  /// @tparam depth  messages that are kept
  template <FixedMessage M, std::int64_t depth = kInboxDepth>
  std::unique_ptr<Inbox<M, depth>> inbox(const std::string& name, Group group = Group::agents) {
    if (group != Group::agents) needs_unlogged("the servo links");
    auto box = std::make_unique<Inbox<M, depth>>(bus_, route(name, group), context_.session_id);
    inboxes_.push_back(box.get());
    return box;
  }
  /// A link on which the run is fingerprinted and repaired.
  /// @throws FaultError internal_error when the process has more links than its status can tell about
  /// @tparam Kept  messages that can be sent again
  template <FixedMessage M, std::size_t Kept = kOutboxKept>
  std::unique_ptr<Outbox<M, Kept>> outbox(const std::string& name, Group group = Group::agents) {
    if (group != Group::agents) needs_unlogged("the servo links");
    auto box = std::make_unique<Outbox<M, Kept>>(bus_, route(name, group), context_.session_id);
    add(*box);
    return box;
  }
  /// @param channel  with the session @return whether one of the outboxes publishes there, or did
  [[nodiscard]] bool sends(std::string_view channel) const;

  /// Says that this process uses something that is not in the log of a run, such as pictures.
  /// @throws NotInLog in a replay
  void needs_unlogged(const std::string& what) const {
    if (context_.replayed) throw NotInLog{what + " are not in the log"};
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

  /// Like await(), for messages that must come: it does not wait for ever. Neither the time counts in which this process
  /// was suspended, nor that in which its supervisor is: what it waits for may wait for the supervisor.
  /// @param sources  where they come from; must live as long as the wait
  /// @param silent   what it means when they do not: peer_silent or hardware_silent
  /// @throws FaultError after NodeContext::timeout `silent`, with channel, time and counters; after a fifth of
  ///         it malformed_message when one of the channels has brought nothing else
  template <class Ready>
  void await_from(const Sources& sources, FaultCode silent, Ready ready) {
    if (ready()) return;
    waiting_since_ = Clock::now();
    begin_counting(waiting_since_);
    const ReceiveDeadline receive_deadline(sources, silent, context_.timeout);
    while (!ready()) {
      receive_deadline.check(Clock::now() - excused_);
      service(Clock::time_point::max());
    }
  }

  /// Handles what has arrived, without waiting for more than a moment.
  void poll();

  /// The supervisor's own process: what it says itself holds from now on, whatever comes by its channel.
  void lead(const supervisor_t& word) { own_word_ = word; }
  /// @return what the supervisor said last; with the wall clock at least stopping, for good, after its
  /// silence of
  ///         kSupervisorSilent
  [[nodiscard]] Phase phase() const;
  /// @return whether the system stops or has ended
  [[nodiscard]] bool over() const { return phase() >= Phase::stopping; }
  /// @return first macrostep in which nothing is commanded any more; only meaningful when over()
  [[nodiscard]] std::int64_t stop_as_of() const;
  /// @return whether the supervisor has declared that process dead
  [[nodiscard]] bool dead(const std::string& name) const;

  /// Reports the progress of this process to the supervisor.
  void report_progress(std::int64_t macrostep, std::int64_t step);
  /// With the wall clock: so many steps, macrosteps or periods have been passed over because this process, or
  /// a message, was late. The supervisor writes it down.
  void report_skipped(std::int64_t count);
  /// Reports the state of an effector driver. A change is told at once where the system stops: somebody waits
  /// for it.
  /// @param state  number of its DriverState
  void report_effector(int state);
  /// What an effector driver reports about its robot after a stop, and the simulator about those whose drivers are dead. It is
  /// told at once.
  /// @param stop_steps  from the end of the last commanded macrostep to rest
  void report_rest(bool at_rest, int stop_steps);
  /// A line for the operator and the log.
  void log(const std::string& text, FaultCode code = FaultCode::none);
  /// Takes the fingerprints of what it has sent: what it sends from now on is not in them. After a stop a robot's
  /// driver and the simulator go on until the supervisor knows that all rest, and when that is lies with the wall clock. Only the first
  /// call counts. Real-time safe.
  void seal_fingerprints();
  /// Says that this process has ended, with the fingerprints of what it sent, and what was wrong on the links
  /// that it read. A fault that it has reported stays its state. Its links must still be there.
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
  void log_counters();
  void watch_supervisor();
  void come_to_rest_alone();
  void confirm();  // what has been heard of the supervisor
  void begin_counting(Clock::time_point now);
  void count(Clock::time_point now);
  [[nodiscard]] bool leads() const;
  [[nodiscard]] bool unled() const;                // the supervisor is silent
  [[nodiscard]] const supervisor_t* word() const;  // of the supervisor; null: none yet

  Bus& bus_;
  NodeContext context_;
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
  HeartbeatMonitor supervisor_{Clock::now(), std::chrono::milliseconds(100)};
  std::int64_t heard_{};                  // messages of the supervisor
  std::optional<supervisor_t> own_word_;  // of a process that leads, or that runs without a supervisor
  bool alone_{};
  Clock::time_point counted_{};  // the time of a wait, up to here
  Clock::duration excused_{};    // of it
};

}  // namespace mrroc::link
