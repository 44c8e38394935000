// Shell of the control subsystem of an agent without an effector: runs the task's program.
#pragma once
#include "base/motion.hpp"
#include "ecp/agent_links.hpp"

namespace mrroc::ecp {

/// Port of an agent whose images are
///     X { c; None e; V; Order T; int64 i, i_0 }
///     Y { c; None e; V; Report T }
/// V is left as it is: the agent reads and sets its sensors itself. T may be more than Order and Report
/// (base/linked_port.hpp).
template <Images A>
class AgentPort {
 public:
  /// @param links  must outlive the port
  explicit AgentPort(AgentLinks& links) : links_(links) {}

  /// The operations of a Port: sends y.T for macrostep i + 1; i := i + 1; fills in T and i of x.
  void dispatch(const Motion<A>& motion, const typename A::Y& y) {
    links_.in_behaviour(motion.m, motion.name, motion.until);
    links_.send(y.T);
  }
  Outcome wait() { return links_.wait(); }
  void read(typename A::X& x) const {
    x.T = links_.order();
    x.i = links_.i();
  }
  /// @return what the port is made of, for ports that do more
  [[nodiscard]] AgentLinks& links() const { return links_; }

 private:
  AgentLinks& links_;
};

/// Runs the control subsystem of such an agent to its end.
/// @param process  this process's connection
/// @param names    of the agent's links
/// @param program  Outcome program(X& x, AgentPort<A>& port): the task's sequence of Move instructions
template <Images A, class Program>
void run_agent(link::Process& process, const AgentLinkNames& names, Program program) {
  AgentLinks links(process, names);
  AgentPort<A> port(links);
  typename A::X x{};
  Outcome outcome = links.begin();
  if (outcome == Outcome::terminated) {
    port.read(x);
    outcome = program(x, port);
  }
  if (outcome == Outcome::terminated) links.end();
  process.report_done();
  process.stay();
}

}  // namespace mrroc::ecp
