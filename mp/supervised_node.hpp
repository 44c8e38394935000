// One node of a task under the supervisor: its start, its signs of life and its end.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/fault.hpp"
#include "base/link/child.hpp"
#include "base/link/heartbeat_monitor.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/process.hpp"
#include "mrroc/console_t.hpp"
#include "mrroc/process_status_t.hpp"

namespace mrroc::mp {

/// Describes one process of a task besides MP: a program, or the same thing as a thread.
struct NodeSpec {
  std::string name;                            ///< in the roster and on its channels
  std::string program{};                       ///< file beside the task's program
  std::vector<std::string> arguments{};        ///< beyond those that every node gets
  std::function<void(link::Process&)> body{};  ///< what the program does, for a system in one process
  std::vector<std::string> start{};            ///< words before the program: make it run on another host
  /// Of a driver: the node that has the drives of its robot, and tells of their rest when the driver is dead; empty: none.
  std::string plant{};
};

/// The supervisor's knowledge of a process.
struct NodeStatus {
  std::string name;  ///< as in the roster
  /// As it has told last; dead: as the supervisor has found.
  link::ProcessState state{link::ProcessState::starting};
  double age{};               ///< [s] since it was last heard
  int m{};                    ///< behaviour of its agent, 0: none, or one without a number
  std::string behaviour;      ///< its name; empty: none has been told
  std::string ended_because;  ///< the behaviour before, and why it ended
};

/// Used by the supervisor's thread.
class SupervisedNode {
 public:
  using Clock = link::Process::Clock;  ///< wall time

  /// Parts of a status that others have to know.
  struct News {
    bool begun{};                  ///< its agent is in another behaviour
    std::int64_t late{};           ///< what it has skipped since that was told last, when it is time to tell
    std::optional<Fault> fault{};  ///< it has failed
  };

  /// @param mp  MP's own connection; must outlive this object
  SupervisedNode(link::Process& mp, NodeSpec spec);

  [[nodiscard]] const std::string& name() const { return spec_.name; }  ///< in the roster
  /// @return name of the node that has the drives of its robot; empty: none
  [[nodiscard]] const std::string& plant() const { return spec_.plant; }

  /// Starts its program, if it has one. @param common  arguments of all  @param input  what it finds on its standard input
  /// @throws FaultError start_failed
  void start_process(const std::vector<std::string>& common, const std::string& input);
  /// Starts its body as a thread, if it has one. @param like  context but for the name
  void start_thread(link::MemoryHub& hub, const link::NodeContext& like);

  /// @return its next line; nothing: there is none
  [[nodiscard]] std::optional<console_t> take_line() { return console_in_.take(); }
  /// Takes its next status, unless that is a late or a wrong one. @return what is new; nothing: there is none
  [[nodiscard]] std::optional<News> take_status(Clock::time_point now);
  /// @return what it has told last
  [[nodiscard]] const process_status_t& status() const { return status_; }
  /// @return what is known of it
  [[nodiscard]] NodeStatus summary(Clock::time_point now) const;

  /// @return as it has told last, or as it was set
  [[nodiscard]] link::ProcessState state() const { return state_; }
  /// Sets the state of a node that has not told it itself, such as one that has died.
  void set_state(link::ProcessState state) { state_ = state; }
  /// @return the child process; null: it is none
  [[nodiscard]] link::Child* child() { return child_ ? &*child_ : nullptr; }
  /// @return whether it is a thread whose body has ended
  [[nodiscard]] bool thread_ended() const { return thread_ended_; }
  /// @return whether it was started and has not ended
  [[nodiscard]] bool runs() const;
  /// Waits for a thread whose body has ended. @return whether none is left
  bool join();

  /// Counts how long nothing has been heard of it. @return the time that counts
  Clock::duration silence(Clock::time_point now);
  /// Counts how long it has said that it is done, from the first call on. @return the time that counts
  Clock::duration left(Clock::time_point now);

  /// @param as_of  first macrostep without a command
  /// @return whether it obeys such a stop, or does not live to obey
  [[nodiscard]] bool confirms(std::int64_t as_of) const;
  /// @return whether it is done or dead, or its process or thread has ended
  [[nodiscard]] bool ended() const;
  /// @return whether it is no driver, or has told that its robot is at rest
  [[nodiscard]] bool rests() const { return status_.effector == 0 || status_.at_rest; }
  /// @return steps to rest that it has told, a driver of its robot or a plant of those of dead drivers; nothing: none
  [[nodiscard]] std::optional<int> stop_steps() const { return stop_steps_; }

  bool asked_to_end{};  ///< it has not confirmed a stop in time, and was told so by SIGTERM

 private:
  NodeSpec spec_;
  link::Queue<process_status_t> status_in_;
  link::Queue<console_t> console_in_;
  process_status_t status_{};
  link::ProcessState state_{link::ProcessState::starting};
  link::HeartbeatMonitor heartbeat_{Clock::now()};
  std::optional<link::HeartbeatMonitor> left_;
  std::optional<int> stop_steps_;
  std::int64_t skipped_told_{};
  Clock::time_point told_at_{};
  std::optional<link::Child> child_;
  std::atomic<bool> thread_ended_{};
  std::jthread thread_;
};

/// In the order of the roster, MP first.
using SupervisedNodes = std::vector<std::unique_ptr<SupervisedNode>>;

}  // namespace mrroc::mp
