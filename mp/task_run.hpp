// One run of a task, from the assembled system to the summary: the part that is the same in every task.
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/motion.hpp"
#include "mp/coordinator_run.hpp"
#include "mp/lateness_notice.hpp"
#include "mp/operator_command_server.hpp"
#include "mp/options.hpp"
#include "mp/order_wait.hpp"
#include "mp/print_line.hpp"
#include "mp/recoverable_faults.hpp"
#include "mp/run_folder.hpp"
#include "mp/run_log.hpp"
#include "mp/run_session.hpp"
#include "mp/signal_orders.hpp"
#include "mp/status_board.hpp"
#include "mp/stop_orders.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::mp {

/// The task's own side of a running system: links, operator, supervisor, log. Used by the main thread.
class TaskRun {
 public:
  /// @param task     its name
  /// @param folder   run folder, exists; holds config.toml
  /// @param arms     keys of the arms, e.g. arm1, arm2
  /// @param nodes    every other process
  /// @throws FaultError session_in_use, no_multicast, bad_script, cannot_write, bad_usage: hosts; ConfigError: hosts or
  ///         losses. Then the folder is removed
  TaskRun(const std::string& task, const TaskOptions& options, const std::filesystem::path& folder,
          const std::vector<std::string>& arms, std::vector<NodeSpec> nodes);
  /// A coordinator that runs once more on the log of a run: nobody is started, nothing is written, and the
  /// operator's orders come from the run's operator.script.
  /// @param process  must outlive this object
  /// @param folder   of that run
  TaskRun(const std::string& task, link::Process& process, const std::filesystem::path& folder,
          const std::vector<std::string>& arms);
  ~TaskRun();
  TaskRun(const TaskRun&) = delete;
  TaskRun& operator=(const TaskRun&) = delete;

  /// MP's connection, what operators say, what they see, the watch over the processes; they live as long as the run.
  [[nodiscard]] link::Process& process() { return *process_; }
  [[nodiscard]] OperatorCommandServer& command_server() { return *command_server_; }
  [[nodiscard]] StatusBoard& board() { return *board_; }
  [[nodiscard]] Supervisor& supervisor() { return *supervisor_; }
  /// Tells of what the task does.
  [[nodiscard]] const Announcer& announce() const { return *announce_; }
  /// @return name of the session, prefix of every channel
  [[nodiscard]] const std::string& session() const { return process_->context().session; }

  /// Starts every node. Make all links of MP before.
  /// @throws FaultError start_failed
  void start();

  /// Call this once per macrostep: passes the operator's stop on (rule R3), and ends the run when its time is
  /// over. While only a person can go on, see OperatorCommandServer::waits_for_a_person(), macrosteps do not
  /// go by faster than they last.
  /// @param sim_s  simulated time [s]
  void each_macrostep(std::int64_t i, double sim_s);

  /// Tells operator and command server what the task does.
  void set_state(TaskState state, bool waits_for_trigger);

  /// @param idle  the task's own script of instructions has ended, all of them have been carried out, and no terminal has
  ///              given any: only a person can go on
  void set_idle(bool idle) { wait_->set_idle(idle); }

  /// A person gives one instruction after the other, and may think as long as they like in between: that nothing changes
  /// is no news then.
  void set_attended() { wait_->set_attended(); }

  /// Tells of a fault after which the task goes on: to the messages, the summary and a black box of its own,
  /// black_box/PROCESS-MACROSTEP, which is written meanwhile; RecoverableFaults::kMostBoxes of a run.
  /// @param fault   names its process
  /// @param advice  what the operator can do
  void report_recoverable_fault(const Fault& fault, const std::string& advice) {
    recoverable_->report(fault, advice, i_, sim_s_);
  }

  /// Does the last work, such as tables and pictures, while terminals are still told that the task is ending. A signal
  /// kills gnuplot, so that the work goes on without pictures; a second one ends the program at once.
  /// @param work  runs in a thread of its own, after end(); what it throws is thrown here
  void finish(const std::function<void()>& work);

  /// Executes the coordinator, and brings the system to its end. Call start() before.
  /// @return summary without the task's own figures; it is written already, for the case that nothing after it can be
  Summary execute(CoordinatorRun& coordinator) {
    const Outcome outcome = process_->assemble() ? coordinator.execute() : Outcome::aborted;
    return end(outcome, outcome == Outcome::faulted ? std::optional(coordinator.fault()) : std::nullopt);
  }

  /// Brings the system to its end. The task is done when its program has terminated and every node has told that it is
  /// done, with the fingerprints of what it sent; otherwise the summary has a fault.
  /// @param outcome  of the task's program
  /// @param fault    why the task did not reach its own end; none: it did, or was stopped
  /// @return as execute()
  Summary end(Outcome outcome, const std::optional<Fault>& fault);

 private:
  using Clock = link::Process::Clock;

  /// Creates the services around MP's connection. @param session  that hints have to name; empty: none
  void create_services(const std::vector<std::string>& arms, std::vector<NodeSpec> nodes,
                       const std::filesystem::path& messages, const std::string& session,
                       std::vector<ScriptedOrder> script, const std::filesystem::path& record);
  /// Whatever MP has to look after while it waits.
  void serve();
  void look_after_log();
  void print_lateness();
  void end_in_time(double sim_s);

  std::string task_;
  std::filesystem::path folder_;
  bool view_{};
  bool scripted_{};
  double max_time_{};                    // simulated [s], 0: for ever
  std::unique_ptr<RunSession> session_;  // none in a check, like the next two, and signals
  std::unique_ptr<RunLog> log_;
  std::unique_ptr<link::Process> own_process_;
  link::Process* process_{};
  std::unique_ptr<Supervisor> supervisor_;
  std::unique_ptr<OperatorCommandServer> command_server_;
  std::unique_ptr<StatusBoard> board_;
  std::unique_ptr<Announcer> announce_;
  std::unique_ptr<RecoverableFaults> recoverable_;
  std::unique_ptr<StopOrders> stops_;
  std::unique_ptr<OrderWait> wait_;
  std::unique_ptr<SignalOrders> signals_;
  LatenessNotice lateness_;
  double sim_s_{};
  std::int64_t i_{};
  std::optional<Clock::time_point> begun_;  // first macrostep
};

}  // namespace mrroc::mp
