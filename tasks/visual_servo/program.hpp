// The behaviours of c_1 and the automaton that selects them (VS 3.5.2, fig. 23).
#pragma once
#include <array>

#include "base/motion.hpp"
#include "tasks/visual_servo/images.hpp"

namespace mrroc::visual_servo {

/// A row of the table: a behaviour and its initial condition.
struct Selectable {
  bool (*f_sigma)(const Arm::X&);  ///< initial condition
  Motion<Arm> motion;              ///< f', and the terminal condition f_tau
};

/// m of c_B_1,0: 0 is that of an agent that waits for the coordinator. c_B_1,1..3 have their own numbers.
inline constexpr int kIdle = 4;
/// m of the behaviour that the paper does not have: between two cameras' views the arm goes on to where the object was.
inline constexpr int kFromMemory = 6;

/// c_B_1,0 .. c_B_1,3, and the one from memory. In every image exactly one initial condition holds, and a behaviour whose initial condition
/// holds does not end at once: Move's loop, which tests first, and the paper's, which tests last, are the same.
extern const std::array<Selectable, 5> kBehaviours;

/// @return the behaviour whose initial condition holds
[[nodiscard]] const Motion<Arm>& select(const Arm::X& x);

/// The task is over: its time has passed.
[[nodiscard]] bool done(const Arm::X& x);
/// The task is given up: nothing has been seen for too long, or the driver has made no displacement for too long.
[[nodiscard]] bool in_vain(const Arm::X& x);

/// Tells the coordinator that the task is given up, until the system stops.
extern const Motion<Arm> kGiveUp;

/// @return memory at the beginning of the task
[[nodiscard]] Memory begin(const Parameters& k, std::int64_t i);

/// Executes behaviours until the task is over.
template <class Port>
Outcome run_program(Arm::X& x, Port& port) {
  while (!done(x)) {
    if (in_vain(x)) return move(kGiveUp, x, port);
    if (const Outcome o = move(select(x), x, port); o != Outcome::terminated) return o;
  }
  return Outcome::terminated;
}

}  // namespace mrroc::visual_servo
