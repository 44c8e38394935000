// Ends nodes that do not confirm a stop: first by a request, then by force.
#pragma once
#include <chrono>
#include <string>

#include "base/link/heartbeat_monitor.hpp"

namespace mrroc::mp {

/// Counts wall time, as far as the supervisor was run in it, from the moment in which a node has to confirm a stop and has
/// not.
class StopEscalation {
 public:
  using Clock = link::HeartbeatMonitor::Clock;                 ///< wall time
  static constexpr std::chrono::milliseconds kConfirm{3000};   ///< for nodes to confirm a stop
  static constexpr std::chrono::milliseconds kHurry{500};      ///< the same after a second word
  static constexpr std::chrono::milliseconds kTerminate{500};  ///< from SIGTERM to SIGKILL

  explicit StopEscalation(Clock::time_point now) : waited_(now) {}

  /// Second order of the user to stop the system: kHurry counts.
  void hurry() { hurried_ = true; }
  /// There is no stop, or everybody has confirmed it.
  void settle(Clock::time_point now) { waited_.hear(now); }
  /// Somebody has not.
  void wait(Clock::time_point now) { waited_.look(now); }

  /// @return time that nodes have
  [[nodiscard]] std::chrono::milliseconds timeout() const { return hurried_ ? kHurry : kConfirm; }
  /// @return whether it is over: nodes that have not confirmed are to be asked to end
  [[nodiscard]] bool asks() const { return waited_.counted() >= timeout(); }
  /// @return whether the time of the nodes that were asked to end is over, too
  [[nodiscard]] bool kills() const { return waited_.counted() >= timeout() + kTerminate; }

  /// Takes note of a node that was asked to end.
  void add(const std::string& name) { unconfirmed_ += (unconfirmed_.empty() ? "" : ", ") + name; }
  /// @return their names; empty: there is none
  [[nodiscard]] const std::string& unconfirmed() const { return unconfirmed_; }

 private:
  link::HeartbeatMonitor waited_;
  bool hurried_{};
  std::string unconfirmed_;
};

}  // namespace mrroc::mp
