// The control subsystem of a platform that pushes: hands the coordinator's fragments over to its effector driver.
#pragma once
#include "base/motion.hpp"
#include "tasks/box_push/images.hpp"

namespace mrroc::box_push {

extern const Motion<Pusher> kReady;   ///< m = 1: stands, until the coordinator's first order of work
extern const Motion<Pusher> kFollow;  ///< m = 2: hands fragments over until the task is over

/// Follows the coordinator until it says that the task is over.
template <class Port>
Outcome run_pusher(Pusher::X& x, Port& port) {
  const Outcome o = move(kReady, x, port);
  return o == Outcome::terminated ? move(kFollow, x, port) : o;
}

}  // namespace mrroc::box_push
