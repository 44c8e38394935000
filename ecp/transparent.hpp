// The transparent agent a_j of continuous coordination (MS 34-36): copies the coordinator's orders to the effector, and the
// effector to the coordinator.
#pragma once
#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "ecp/generators/rows.hpp"

namespace mrroc::ecp {

/// @return an order that such an agent copies (MS 33): TCIM-VELOCITY with these rows of the task frame
/// @param m  behaviour of the coordinator
[[nodiscard]] inline Order order(int m, const TaskFrameCommand& frame, const Pacing& pacing = {}) {
  Order o{.m = m};
  o.arm = move_arm(frame, pacing).arm;
  return o;
}

/// f_cT: the effector and the sensor for the coordinator (34), (35), under the number of its own behaviour.
template <class X>
[[nodiscard]] Report copy_images(const X& x) {
  return report_of(x, x.T.m);
}
/// f_tau: the task is over.
template <class X>
[[nodiscard]] bool task_is_over(const X& x) {
  return x.T.finished;
}

/// @return the agent's only behaviour, which has no number in the paper
template <Images A>
[[nodiscard]] constexpr Motion<A> transparent() {
  using X = typename A::X;
  return {0,
          "copy the coordinator's orders",
          retain<A>,
          retain<A>,
          copied_order<X>,
          no_sensor<A>,
          copy_images<X>,
          task_is_over<X>};
}

/// Body of the ECP of an arm that copies orders and has no virtual sensor: the program ecp_transparent.
void run_transparent(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::ecp
