// The agent of an arm in the cube's task: the behaviours of a cycle, acting or standing, and between cycles
// free motions along paths and the weighing of the load on its sensor.
#pragma once
#include <array>

#include "tasks/rubik/turn/tables.hpp"

namespace mrroc::rubik {

/// Report::event of these behaviours: their number, when they are done; of kTakePath never.
extern const std::array<Motion<Arm>, 4> kBetween;

/// @return the behaviour that the coordinator orders; "wait" when that one has ended already
[[nodiscard]] const Motion<Arm>& select(const Arm::X& x);

/// Obeys the coordinator until the task is over.
/// @return terminated; otherwise why the port gave up
template <class P>
Outcome run_arm(Arm::X& x, P& port) {
  while (!x.T.finished)
    if (const Outcome o = move(select(x), x, port); o != Outcome::terminated) return o;
  return Outcome::terminated;
}

}  // namespace mrroc::rubik
