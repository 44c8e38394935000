// Starts the processes of a task, watches them, and leads the system from assembling to its end.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "base/link/heartbeat_monitor.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/process.hpp"
#include "mp/fingerprint.hpp"
#include "mp/message_log.hpp"
#include "mp/stop_escalation.hpp"
#include "mp/supervised_node.hpp"

namespace mrroc::mp {

/// @param reason  why a system was stopped @return whether it is a word of the operator, and no failure
[[nodiscard]] bool is_operators_word(FaultCode reason);

/// The supervisor's time limits [wall time].
struct SupervisorTimes {
  std::chrono::milliseconds assembling{60'000};    ///< until everybody must be there
  std::chrono::milliseconds hang{10'000};          ///< without a sign of life
  std::chrono::milliseconds come_to_rest{20'000};  ///< for arms to come to rest after a stop
  std::chrono::milliseconds leaves{2000};    ///< from a node that is done to the end of the task's program
  std::chrono::milliseconds finish{20'000};  ///< from that end until every node has done its work
  std::chrono::milliseconds leave{5000};     ///< for processes and threads to end by themselves
};

/// The supervisor. Lives in MP's thread; everything happens in poll(), which MP's process calls whenever it
/// waits.
class Supervisor {
 public:
  /// @param mp        MP's own connection; its roster names MP first, then the nodes in order
  /// @param messages  file for all processes' lines
  /// @param times     other ones than usual are for tests
  Supervisor(link::Process& mp, std::vector<NodeSpec> nodes, const std::filesystem::path& messages,
             const SupervisorTimes& times = {});
  /// A thread that does not end cannot be ended: then the whole process ends here, with the status of process_hung.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Starts every node as a child process.
  /// @param common  arguments for all
  /// @param input   what each finds on its standard input
  /// @throws FaultError start_failed
  void start_processes(const std::vector<std::string>& common, const std::string& input = {});
  /// Starts every node as a thread.
  void start_threads(link::MemoryHub& hub);

  /// Everything that has to be looked after.
  void poll();

  /// Brings the system to rest. The first reason is kept.
  /// @param as_of  first macrostep without a command; 0: at once
  void stop(const Fault& reason, std::int64_t as_of);

  /// Second order of the user to stop: nodes that have not confirmed within StopEscalation::kHurry are ended.
  void hurry() { escalation_.hurry(); }
  /// Third word: ends every node at once, by SIGKILL; drives without drivers brake.
  void kill_all();

  /// @return whether every node that lives obeys the stop, or rests since a fault of its own; false: nobody has stopped
  ///         the system
  [[nodiscard]] bool stop_confirmed() const;
  /// @return nodes that did not confirm the stop in time and were ended, by name; empty: none
  [[nodiscard]] const std::string& unconfirmed() const { return escalation_.unconfirmed(); }
  /// @return a node that has not told what it has sent, by name; empty: all have
  [[nodiscard]] std::string without_fingerprint() const { return mp::without_fingerprint(nodes_); }

  /// Called with a line that the person in front of the task has to read; may be empty.
  std::function<void(const std::string&)> on_alarm;

  /// Waits until the nodes have done their work (after the task's end) or the arms are at rest (after a
  /// stop), and ends everything that still runs. A thread that does not end is told of as process_hung.
  void end();

  /// @return why the system was stopped: the first reason; nothing: it was not
  [[nodiscard]] const std::optional<Fault>& fault() const { return fault_; }
  /// @return in the order of the roster, MP first
  [[nodiscard]] std::vector<NodeStatus> node_statuses() const;
  /// @return how often any process has begun another behaviour
  [[nodiscard]] std::int64_t behaviours_begun() const { return behaviours_begun_; }
  /// @return steps from the end of the last commanded macrostep to rest, of the robot that took longest; nothing: nobody
  ///         has told
  [[nodiscard]] std::optional<int> stop_steps() const;
  /// @return fingerprint of all control messages; 0 when not every process has told its own
  [[nodiscard]] std::uint64_t log_hash() const { return fingerprint_of(nodes_); }
  /// @return steps, macrosteps and periods that processes have passed over because of lateness, of all; with the wall
  /// clock alone
  [[nodiscard]] std::int64_t skipped() const;
  /// @return the last line that a process said
  [[nodiscard]] const std::string& last_message() const { return messages_.last(); }
  /// @return its code; none: information
  [[nodiscard]] FaultCode last_code() const { return messages_.last_code(); }

 private:
  using Clock = link::Process::Clock;

  void hear();
  void watch_children();
  void watch_hangs();
  void watch_leavers();
  void watch_stop();
  void ask_to_end(SupervisedNode& node);
  void kill_unconfirmed(SupervisedNode& node);
  void lead();
  void publish();
  void await_work();
  bool await_for(std::chrono::milliseconds time, const std::function<bool()>& ready);
  void let_go();
  void end_threads();
  void alarm(const SupervisedNode& node, const std::string& line);
  void log_and_stop(const Fault& fault);  // of a node
  void declare_dead(SupervisedNode& node, const Fault& fault);
  void publish_dead(const SupervisedNode& node);  // the others do not wait for it any more
  [[nodiscard]] bool all(link::ProcessState at_least) const;
  [[nodiscard]] bool robots_rest() const;  // as far as their drivers live to tell, or else their plant
  [[nodiscard]] bool plant_rests(const SupervisedNode& driver) const;

  link::Process& mp_;
  SupervisedNodes nodes_;
  link::Outbox<supervisor_t> out_;
  supervisor_t said_{};
  Clock::time_point last_said_{};
  Clock::time_point last_look_{};
  link::HeartbeatMonitor assembling_;
  StopEscalation escalation_;
  SupervisorTimes times_;
  MessageLog messages_;
  std::optional<Fault> fault_;
  bool led_{};  // everybody was there, and the system ran
  std::int64_t behaviours_begun_{};
  bool program_ended_{};  // the task's own
  bool ending_{};
  bool abandons_threads_{};
};

}  // namespace mrroc::mp
