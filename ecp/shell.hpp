// Shell of an embodied agent's control subsystem: prepares the effector, runs the task's program, releases
// the effector.
#pragma once
#include <string>

#include "base/motion.hpp"
#include "ecp/effector_links.hpp"
#include "ecp/preparation.hpp"

namespace mrroc::ecp {

/// Port of an agent whose images are
///     X { c; E::Reply e; SensorReading V; Order T; int64 i, i_0 }
///     Y { c; E::Command e; SensorSetting V; Report T }
/// A V of another type is left as it is: an agent with sensors of its own reads and sets them itself, one whose y.V is
/// empty sets nothing. T may be more than Order and Report (base/linked_port.hpp).
template <Images A, Effector E = ArmEffector>
class EffectorPort {
 public:
  /// @param links  must outlive the port
  explicit EffectorPort(EffectorLinks<E>& links) : links_(links) {}

  /// The operations of a Port: sends y.e, y.V and y.T for macrostep i + 1; i := i + 1; fills in e, V, T and i of x.
  void dispatch(const Motion<A>& motion, const typename A::Y& y) {
    links_.in_behaviour(motion.m, motion.name, motion.until);
    if constexpr (std::is_same_v<decltype(y.V), SensorSetting>) links_.set_sensor(y.V);
    links_.send(y.e, y.T);
  }
  Outcome wait() { return links_.wait(); }
  void read(typename A::X& x) const {
    x.e = links_.reply();
    if constexpr (std::is_same_v<decltype(x.V), SensorReading>) x.V = links_.reading();
    x.T = links_.order();
    x.i = links_.i();
  }
  /// @return what the port is made of, for ports that do more
  [[nodiscard]] EffectorLinks<E>& links() const { return links_; }

 private:
  EffectorLinks<E>& links_;
};

/// That of an arm's agent.
template <Images A>
using ArmPort = EffectorPort<A, ArmEffector>;

/// Runs an ECP to its end.
/// @param process   this process's connection
/// @param names     of the agent's links
/// @param prepare   what is set in the driver before the task begins
/// @param program   Outcome program(X& x, EffectorPort<A, E>& port): the task's sequence of Move instructions
template <Images A, Effector E = ArmEffector, class Program>
void run_ecp(link::Process& process, const EffectorLinkNames& names, const PreparationOf<E>& prepare,
             Program program) {
  EffectorLinks<E> links(process, names);
  EffectorPort<A, E> port(links);
  typename A::X x{};
  Outcome outcome = links.begin();
  if (outcome == Outcome::terminated) outcome = prepare_effector(links, prepare);
  if (outcome == Outcome::terminated) {
    port.read(x);
    outcome = program(x, port);
  }
  if (outcome == Outcome::faulted) {
    process.report_fault(fault_of(links));
    return;
  }
  if (outcome == Outcome::terminated) links.end();
  process.report_done();
  process.stay();
}

}  // namespace mrroc::ecp
