// One run of a task, from the assembled system to the summary: what every task's main does in the same way.
#pragma once
#include <csignal>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "base/link/event_log.hpp"
#include "base/link/session.hpp"
#include "mp/operator_desk.hpp"
#include "mp/options.hpp"
#include "mp/run_folder.hpp"
#include "mp/status_board.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::mp {

/// The task's own side of a running system: links, operator, supervisor, log. Used by the main thread.
class TaskRun {
 public:
  /// @param task     its name
  /// @param folder   run folder, exists; holds config.toml
  /// @param arms     keys of the arms, e.g. arm1, arm2
  /// @param parts    every other process
  /// @throws FaultError session_in_use, no_multicast, bad_script, cannot_write; ConfigError: hosts or losses
  TaskRun(const std::string& task, const TaskOptions& options, const std::filesystem::path& folder,
          const std::vector<std::string>& arms, std::vector<Part> parts);
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
  [[nodiscard]] OperatorDesk& desk() { return *desk_; }
  [[nodiscard]] StatusBoard& board() { return *board_; }
  [[nodiscard]] Supervisor& supervisor() { return *supervisor_; }
  /// @return name of the session, prefix of every channel
  [[nodiscard]] const std::string& session() const { return session_; }

  /// Starts every part. Make all links of MP before.
  /// @throws FaultError start_failed
  void start();

  /// To be called once per macrostep: passes the operator's stop on (rule R3). While only a person can go on, see
  /// OperatorDesk::waits_for_a_person(), macrosteps do not go by faster than they last.
  /// @param sim_s  simulated time [s]
  void each_macrostep(std::int64_t i, double sim_s);

  /// Tells operator and desk what the task does.
  void set_state(TaskState state, bool waits_for_trigger);

  /// Tells of a fault after which the task goes on: to the messages, the summary and a black box of its own,
  /// black_box/PROCESS-MACROSTEP, which is written meanwhile; kMostBoxes of a run.
  /// @param fault   names its process
  /// @param advice  what the operator can do
  void survive(const Fault& fault, const std::string& advice);
  static constexpr std::size_t kMostBoxes = 5;  ///< of survived faults

  /// Does the last work, such as tables and pictures, while terminals are still told that the task is ending.
  /// @param work  runs in a thread of its own, after end(); what it throws is thrown here
  void finish(const std::function<void()>& work);

  /// Brings the system to its end.
  /// @param fault  why the task did not reach its own end; none: it did
  /// @return summary without the task's own figures
  Summary end(const std::optional<Fault>& fault);

 private:
  void open_bus(const TaskOptions& options, bool several_hosts);
  void write_processes(const std::vector<Part>& parts) const;
  void furnish(const std::vector<std::string>& arms, std::vector<Part> parts,
               const std::filesystem::path& messages, std::vector<ScriptedOrder> script,
               const std::filesystem::path& record);
  [[nodiscard]] Fault stop_reason() const;
  void look_after_orders();
  void wait_for_a_person(double macrostep_s);
  void stop_promptly();
  void tell_lateness();

  std::string task_;
  std::filesystem::path folder_;
  std::string session_;
  std::optional<link::LcmAddress> address_;  // none: all in one process
  bool separate_{};
  bool view_{};
  std::string clock_{"step"};  // as in a command line
  std::unique_ptr<link::SessionFile> session_file_;
  std::unique_ptr<link::MemoryHub> hub_;
  std::unique_ptr<link::Bus> lossless_;  // below bus_, when messages are to be lost
  std::unique_ptr<link::Bus> bus_;
  std::unique_ptr<link::EventLog> log_;
  std::unique_ptr<link::Process> own_process_;  // none in a check
  link::Process* process_{};
  std::unique_ptr<Supervisor> supervisor_;
  std::unique_ptr<OperatorDesk> desk_;
  std::unique_ptr<StatusBoard> board_;
  std::vector<SurvivedFault> survived_;
  std::future<void> box_;  // is being written
  double sim_s_{};
  link::Process::Clock::time_point begun_{};
  link::Process::Clock::time_point last_macrostep_{};
  std::int64_t i_{};
  int signals_{};  // to interrupt; a second one does not wait for a macrostep
  bool running_{};
  std::int64_t late_told_{};
  link::Process::Clock::time_point late_told_at_{};
  int signal_{};  // that ended the task, 0: none
};

}  // namespace mrroc::mp
