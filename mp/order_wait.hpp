// Handles a run that waits for an order which only a person can give.
#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "base/link/process.hpp"
#include "mp/operator_command_server.hpp"
#include "mp/print_line.hpp"
#include "mp/status_board.hpp"
#include "mp/supervisor.hpp"
#include "mp/wait_notice.hpp"

namespace mrroc::mp {

/// Detects the wait, tells the user at the terminal, lets macrosteps last as long as they would take, and
/// ends the run where nobody has to be there.
class OrderWait {
 public:
  /// All must outlive this object. @param scripted  orders come from a script
  OrderWait(link::Process& process, OperatorCommandServer& command_server, const StatusBoard& board,
            Supervisor& supervisor, const Announcer& announce, bool scripted);

  /// As TaskRun::set_idle() and TaskRun::set_attended().
  void set_idle(bool idle) { idle_ = idle; }
  void set_attended() { attended_ = true; }

  /// As fast as the machine can, nothing but waiting would fill the log with megabytes in a second. So a macrostep of
  /// waiting lasts; what is sent stays the same, and orders end the wait. Call it before each_macrostep().
  /// @param sim_s  simulated time of the macrostep [s]
  void let_last(double sim_s);
  /// Takes note of a macrostep.
  void each_macrostep(std::int64_t i, double sim_s);

  /// Tells a person, for whom a run that stands still looks like one that works. Call it often.
  void look();
  /// @return what the run waits for
  [[nodiscard]] Wait wait() const;

 private:
  using Clock = link::Process::Clock;
  void look_after_script(Clock::time_point now);

  link::Process& process_;
  OperatorCommandServer& command_server_;
  const StatusBoard& board_;
  Supervisor& supervisor_;
  const Announcer& announce_;
  bool scripted_;
  bool idle_{}, attended_{};
  std::int64_t i_{};
  double sim_s_{};
  Clock::time_point last_macrostep_{Clock::now()};
  WaitNotice notice_;
  Clock::time_point looked_at_{};
  std::optional<Clock::time_point> lacks_order_since_;  // which the script does not have
};

}  // namespace mrroc::mp
