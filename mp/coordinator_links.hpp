// The coordinator's links to the embodied agents, and to the operator as a fourth agent.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/motion.hpp"
#include "base/operator.hpp"
#include "base/task_clock.hpp"
#include "base/transmission.hpp"
#include "mrroc/agent_order_t.hpp"
#include "mrroc/agent_report_t.hpp"
#include "mrroc/simulation_control_t.hpp"

namespace mrroc::mp {

/// The operator h as the coordinator's partner: gives his image once per macrostep, and learns what goes on.
class OperatorAgent {
 public:
  virtual ~OperatorAgent() = default;
  /// Says what macrostep i is about.
  /// @param m  behaviour of the coordinator
  virtual void inform(std::int64_t i, int m) = 0;
  /// @return whether everything that image(i) needs has come
  [[nodiscard]] virtual bool here(std::int64_t i) const = 0;
  /// @return whether he has hands in the simulation, which take an order in every macrostep
  [[nodiscard]] virtual bool has_hands() const { return false; }
  /// @return where what here() waits for comes from, or null when it comes from within
  [[nodiscard]] virtual const link::InboxBase* inbox() const { return nullptr; }
  /// @return x_cT_0h of macrostep i; called once per macrostep
  virtual OperatorImage image(std::int64_t i) = 0;
};

/// Sends orders and receives reports once per macrostep; the same rules as ecp::EffectorLinks. A simulation learns of a pause
/// and of the end on the channel simulation.control. With the wall clock
/// the latest of the arms sets the pace: i goes on to the newest macrostep of which all have reported.
class CoordinatorLinks {
 public:
  /// @param arms    channels ARM.order and ARM.report
  /// @param human   must outlive the links
  /// @param clock   how the task obeys a pause
  /// @param others  to the same or to other agents, and to virtual sensors of the coordinator's own
  CoordinatorLinks(link::Process& process, const std::vector<std::string>& arms, OperatorAgent& human,
                   const TaskClock& clock = TaskClock::ramped(), link::OtherLinks others = {});

  /// Publishes the defined messages of macrostep 1 and receives the first images.
  Outcome begin(const Order& order);
  /// Says which behaviour of the coordinator decides on what is sent from now on.
  void in_behaviour(int m, std::string_view name, std::string_view until) {
    m_ = m;
    process_.in_behaviour(m, name, until);
  }
  /// Sends what is for macrostep i + 1, one order per arm, and the typed links; ends these with a finished order.
  void send(std::span<const Order> orders);
  /// i := i + 1, receives the images.
  /// @return aborted when the system stops, faulted when an agent reports a fault, says nothing or says what is
  ///         not finite
  Outcome wait();

  /// @return macrostep of the images, from 1 on
  [[nodiscard]] std::int64_t i() const { return i_; }
  /// @return x_cT_0j of that arm, in the order of the arms
  [[nodiscard]] const Report& report(std::size_t arm) const { return reports_[arm]; }
  /// @return x_cT_0h
  [[nodiscard]] const OperatorImage& operator_image() const { return image_; }
  /// @return the task's clock, which goes on with i
  [[nodiscard]] const TaskClock& clock() const { return clock_; }
  /// @return why wait() gave faulted
  [[nodiscard]] const Fault& fault() const { return fault_; }

 private:
  link::Process& process_;
  OperatorAgent& operator_;
  std::vector<std::unique_ptr<link::Outbox<agent_order_t>>> order_out_;
  std::unique_ptr<link::Outbox<simulation_control_t>> control_out_;
  std::vector<std::unique_ptr<link::Inbox<agent_report_t>>> report_in_;
  Outcome receive();
  /// In a paced run reports come two macrosteps before the orders that answer them are used. Three fifths of a
  /// macrostep are given to the operator: what he orders until then still is of this macrostep. The rest is for the
  /// orders, and for a stop, to reach everybody.
  /// @param ends  when it is over before, as it is when the next reports come
  void wait_for_late_orders(const std::function<bool()>& ends);
  [[nodiscard]] std::int64_t newest() const;

  link::OtherLinks others_;
  link::Sources sources_;
  std::int64_t i_{};
  std::vector<Report> reports_;
  OperatorImage image_;
  TaskClock clock_;
  int m_{};  // behaviour that decides on what is sent
  Fault fault_;
};

/// Port of a coordinator whose images are
///     X { c; e; V; T { std::array<Report, N> agent; OperatorImage h }; i, i_0 }   Y { c; e; V;
///     std::array<Order, N> T }
/// An X that has a TaskTime t gets it. Reports and orders may be more than that, and there may be V: see
/// base/linked_port.hpp.
/// @tparam Observer  void operator()(const Motion<A>&, const X&): called after every read
template <Images A, class Observer>
class CoordinatorPort {
 public:
  /// @param links  must outlive the port
  CoordinatorPort(CoordinatorLinks& links, Observer observer) : links_(links), observer_(observer) {}

  /// The operations of a Port: sends y.T for macrostep i + 1; i := i + 1; fills in T and i of x, for the observer, too.
  void dispatch(const Motion<A>& motion, const typename A::Y& y) {
    motion_ = &motion;
    links_.in_behaviour(motion.m, motion.name, motion.until);
    if constexpr (std::is_convertible_v<decltype((y.T)), std::span<const Order>>) {
      links_.send(y.T);
    } else {
      std::array<Order, std::tuple_size_v<decltype(y.T)>> orders;
      std::ranges::copy(y.T, orders.begin());
      links_.send(orders);
    }
  }
  Outcome wait() { return links_.wait(); }
  void read(typename A::X& x) {
    for (std::size_t arm = 0; arm < x.T.agent.size(); ++arm) x.T.agent[arm] = links_.report(arm);
    x.T.h = links_.operator_image();
    x.i = links_.i();
    if constexpr (requires { x.t; }) x.t = links_.clock().now();
    if (motion_) observer_(*motion_, x);
  }

 private:
  CoordinatorLinks& links_;
  Observer observer_;
  const Motion<A>* motion_{};
};

}  // namespace mrroc::mp
