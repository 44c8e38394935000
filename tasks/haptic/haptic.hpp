// Master and slave: an operator's hand leads arm 1; arm 2 follows in its own cell, and arm 1 feels what it meets.
#pragma once
#include <array>
#include <string_view>

#include "base/agent_images.hpp"
#include "base/motion.hpp"
#include "ecp/generators/commands.hpp"
#include "tasks/haptic/coupling.hpp"

namespace mrroc::haptic {

/// Steps of a macrostep, as the original had; n_Q is one less. Short: every macrostep is delay in the loop of the force.
inline constexpr ecp::Pacing kPacing{.n_s = 2, .n_Q = 1};

/// Numbers of the arms.
inline constexpr std::size_t kMaster = 0, kSlave = 1;

/// What is constant during a run.
struct Parameters {
  Law law;
  double fade{0.5};  ///< time in which the master's force goes when the arms are uncoupled [s]
};

/// c_c0, the memory of the coordinator.
struct Memory {
  Parameters k{};
  std::array<Vector3, 2> begin{Vector3::Zero(),
                               Vector3::Zero()};  ///< of the arms when they were coupled, in their bases [m]
  Coupling coupling{};
  std::int64_t trigger{};  ///< triggers given when the behaviour began
};

/// The coordinator a_0 of both arms.
struct Coordinator : CoordinatorAgent<Memory, 2> {};

/// Numbers of behaviours.
inline constexpr int kCoupled = 1, kUncoupled = 2;

/// m = 0: until both arms are ready and the operator has given start.
extern const Motion<Coordinator> kWaitForStart;
/// The behaviours: coupled, uncoupled.
extern const std::array<Motion<Coordinator>, 2> kBehaviours;

/// @return ways and force that the arms have reported
[[nodiscard]] Sides sides(const Coordinator::X& x);

/// The coordinator's program. @param port  links, or memory in a test
template <class Port>
Outcome run_program(Coordinator::X& x, Port& port) {
  Outcome o = move(kWaitForStart, x, port);
  for (const Motion<Coordinator>& behaviour : kBehaviours)
    if (o == Outcome::terminated) o = move(behaviour, x, port);
  return o;
}

}  // namespace mrroc::haptic
