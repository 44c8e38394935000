// Executes an arm of the cube's task step by step, for programs that move several arms in one thread.
#pragma once
#include "tasks/rubik/turn/agent.hpp"

namespace mrroc::rubik {

/// run_arm() in steps: what it does in one call is one round of base/motion.hpp's move(), over the ends of behaviours.
class SteppedArm {
 public:
  /// @param x  images of the macrostep; memory and i_0 are changed at the begin of a behaviour
  /// @return what is decided
  Arm::Y step(Arm::X& x) {
    while (!motion_ || motion_->f_tau(x)) {
      motion_ = &select(x);
      x.i_0 = x.i;
      x.c = motion_->f_entry(x);
    }
    Arm::Y y{motion_->f_cc(x), motion_->f_ce(x), motion_->f_cV(x), motion_->f_cT(x)};
    x.c = y.c;
    return y;
  }

  /// @return number of the behaviour in force, 0: there has been no step yet
  [[nodiscard]] int m() const { return motion_ ? motion_->m : 0; }

 private:
  const Motion<Arm>* motion_{};
};

}  // namespace mrroc::rubik
