// Starts the processes of a task, watches them, and leads the system from assembling to its end.
#pragma once
#include <array>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/fault.hpp"
#include "base/link/child.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/process.hpp"

namespace mrroc::mp {

/// One process of a task besides MP: a program, or the same thing as a thread.
struct Part {
  std::string name;                          ///< in the roster and on its channels
  std::string program;                       ///< file beside the task's program
  std::vector<std::string> arguments;        ///< beyond those that every part gets
  std::function<void(link::Process&)> body;  ///< what the program does, for a system in one process
  std::vector<std::string> start{};          ///< words before the program: make it run on another host
};

/// What the supervisor knows of a process.
struct PartStatus {
  std::string name;  ///< as in the roster
  /// As it has told last; dead: as the supervisor has found.
  link::ProcessState state{link::ProcessState::starting};
  double age{};               ///< [s] since it was last heard
  int m{};                    ///< behaviour of its agent, 0: none, or one without a number
  std::string behaviour;      ///< its name; empty: none has been told
  std::string ended_because;  ///< the behaviour before, and why it ended
};

/// The supervisor. Lives in MP's thread; everything happens in poll(), which MP's process calls whenever it
/// waits.
class Supervisor {
 public:
  /// @param mp        MP's own connection; its roster names MP first, then the parts in order
  /// @param messages  file for all processes' lines
  /// @param leave     time for processes and threads to end by themselves
  Supervisor(link::Process& mp, std::vector<Part> parts, const std::filesystem::path& messages,
             std::chrono::milliseconds leave = std::chrono::seconds(5));
  /// A thread that does not end cannot be ended: then the whole process ends here, with the status of process_hung.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Starts every part as a child process.
  /// @param common  arguments for all
  /// @throws FaultError start_failed
  void start_processes(const std::vector<std::string>& common);
  /// Starts every part as a thread.
  void start_threads(link::MemoryHub& hub);

  /// Everything that has to be looked after.
  void poll();

  /// Brings the system to rest. The first reason is kept.
  /// @param as_of  first macrostep without a command; 0: at once
  void stop(const Fault& reason, std::int64_t as_of);

  /// Waits until the parts have done their work (after the task's end) or the arms are at rest (after a
  /// stop), and ends everything that still runs. A thread that does not end is told of as process_hung.
  void end();

  /// @return why the system was stopped: the first reason; nothing: it was not
  [[nodiscard]] const std::optional<Fault>& fault() const { return fault_; }
  /// @return in the order of the roster, MP first
  [[nodiscard]] std::vector<PartStatus> parts() const;
  /// @return how often any process has begun another behaviour
  [[nodiscard]] std::int64_t behaviours_begun() const { return behaviours_begun_; }
  /// @return steps from the end of the last commanded macrostep to rest, per arm; -1 unknown
  [[nodiscard]] const std::array<int, 4>& stop_steps() const { return stop_steps_; }
  /// @return fingerprint of all control messages; 0 when not every process has told its own
  [[nodiscard]] std::uint64_t log_hash() const;
  /// @return steps, macrosteps and periods that processes have passed over because of lateness, of all; with the wall
  /// clock alone
  [[nodiscard]] std::int64_t skipped() const;
  /// @return the last line that a process said
  [[nodiscard]] const std::string& last_message() const { return last_message_; }
  /// @return its code; none: information
  [[nodiscard]] FaultCode last_code() const { return last_code_; }
  /// Writes a line of MP itself.
  void log(const std::string& process, const std::string& text, FaultCode code);

 private:
  using Clock = link::Process::Clock;
  struct Watched;

  void hear();
  void watch_children();
  void watch_hangs();
  void lead();
  void publish();
  void end_threads();
  void tell(const Fault& fault);  // of a part
  void declare_dead(Watched& part, const Fault& fault);
  void tell_dead(const Watched& part);  // the others do not wait for it any more
  [[nodiscard]] bool all(link::ProcessState at_least) const;
  [[nodiscard]] bool world_is_dead() const;

  link::Process& mp_;
  std::vector<std::unique_ptr<Watched>> watched_;  // in the order of the roster, MP first
  link::Outbox<supervisor_t> out_;
  supervisor_t said_{};
  Clock::time_point last_said_{};
  Clock::time_point last_look_{};
  Clock::time_point begun_;
  std::chrono::milliseconds leave_;
  std::ofstream messages_;
  std::string last_message_;
  FaultCode last_code_{FaultCode::none};
  std::optional<Fault> fault_;
  bool led_{};  // everybody was there, and the system ran
  std::array<int, 4> stop_steps_{-1, -1, -1, -1};
  std::int64_t behaviours_begun_{};
  bool at_rest_{};
  bool ending_{};
  bool abandons_threads_{};
};

}  // namespace mrroc::mp
