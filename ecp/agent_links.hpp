// The links of an agent without an effector, such as one that knows the map: to the coordinator and to other agents.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/motion.hpp"
#include "base/transmission.hpp"
#include "mrroc/agent_order_t.hpp"
#include "mrroc/agent_report_t.hpp"

namespace mrroc::ecp {

/// Names of such an agent's links.
struct AgentLinkNames {
  std::string agent;          ///< channels AGENT.order, .report
  int n_s{10};                ///< steps of a macrostep of those whose sensors it reads, > 0
  link::OtherLinks others{};  ///< waited for as these are, also while the agent is paused
};

/// Sends y and receives x once per macrostep. No driver tells such an agent the time: the coordinator's orders do. In
/// lock-step every message of macrostep i is waited for (rule R1), and what OtherLinks::here says of step (i - 1) n_s, the
/// first of the macrostep in which it was sent. With the wall clock the newest order sets the pace: i goes on to its
/// macrostep, what is passed over is counted as skipped.
class AgentLinks {
 public:
  /// Make this before the process assembles. @param process  must outlive the links
  AgentLinks(link::Process& process, AgentLinkNames names);

  /// Assembles with the others, publishes the defined messages of macrostep 1 and receives the first images.
  /// @return aborted when the system ends before
  Outcome begin();

  /// Says which behaviour decides on what is sent from now on.
  void in_behaviour(int m, std::string_view name, std::string_view until) {
    process_.in_behaviour(m, name, until);
  }

  /// Sends what is for macrostep i + 1: the report and the typed links.
  void send(const Report& report);

  /// Says that the agent has come to its end, and on the typed links that nothing more will come.
  void end();

  /// i := i + 1, receives the images of the new macrostep.
  /// @return aborted when the system stops
  /// @throws FaultError peer_silent, malformed_message: what must come does not, see link::Process::await_from();
  ///         malformed_message: a number is not proper
  Outcome wait();

  /// @return macrostep of the images, from 1 on
  [[nodiscard]] std::int64_t i() const { return i_; }
  /// @return x_cT, the coordinator's order
  [[nodiscard]] const Order& order() const { return order_; }

 private:
  void go_on_to_newest();

  link::Process& process_;
  AgentLinkNames names_;
  std::unique_ptr<link::Outbox<agent_report_t>> report_out_;
  std::unique_ptr<link::Inbox<agent_order_t>> order_in_;
  link::Sources sources_;
  std::int64_t i_{};
  Order order_;
};

}  // namespace mrroc::ecp
