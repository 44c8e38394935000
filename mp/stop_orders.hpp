// Passes a stop from the operator's order to the macrostep in which all processes obey it.
#pragma once
#include <cstdint>
#include <functional>

#include "base/link/process.hpp"
#include "mp/operator_command_server.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::mp {

/// Passes stops on, and tells the terminals what has become of them (rule R3).
class StopOrders {
 public:
  /// Macrosteps between the order to stop and the first macrostep without a command: far enough ahead that
  /// nobody has passed it.
  static constexpr std::int64_t kAhead = 3;

  /// All must outlive this object. @param reason  why the system is stopped when an order is the reason
  StopOrders(OperatorCommandServer& command_server, Supervisor& supervisor, link::Process& process,
             std::function<Fault()> reason);

  /// Passes on what does not wait for the coordinator's next macrostep. Call it often.
  /// @param impatient  nothing is waited for any more
  void look(bool impatient);
  /// Macrostep i of the coordinator: passes on what has waited for it.
  void each_macrostep(std::int64_t i);

  /// Tells the terminals whether everybody has confirmed the stop, when that is known.
  void settle();

 private:
  using Clock = link::Process::Clock;

  OperatorCommandServer& command_server_;
  Supervisor& supervisor_;
  link::Process& process_;
  std::function<Fault()> reason_;
  bool begun_{};  // there was a macrostep
  std::int64_t i_{};
  Clock::time_point last_macrostep_{Clock::now()};
};

}  // namespace mrroc::mp
