// The control subsystem c_1 of the locomotion agent: behaviours and algorithms 4-8 of REX.
#pragma once
#include <array>

#include "base/motion.hpp"
#include "tasks/rex_drive/images.hpp"

namespace mrroc::rex_drive {

// --- transition subfunctions of the trajectory planner, REX 3.1 ---------------------------------------------

/// Algorithm 4, c,c f_1,1,tp: a new plan gets orientations, the list of fragments is cleared, the planner begins where the
/// platform will be when it gets the first fragment.
[[nodiscard]] Memory take_plan(const Locomotion::X& x);
/// Algorithm 5, c,T f_1,1,tp: a new plan takes ack back. ack is the number of the plan that has been carried out, 0: there
/// is none.
[[nodiscard]] Said take_back_ack(const Locomotion::X& x);
/// Algorithm 6, c,c f_1,2,tp: plans fragment after fragment, and drops what algorithm 7 hands over.
[[nodiscard]] Memory plan_and_hand_over(const Locomotion::X& x);
/// Algorithm 7, c,e f_1,2,tp: hands the first fragment over, when the driver is ready for it and there is one.
[[nodiscard]] PlatformCommand fragment(const Locomotion::X& x);
/// Algorithm 8, c,T f_1,3,tp: ack.
[[nodiscard]] Said acknowledge(const Locomotion::X& x);

/// isnew: whether the desired plan is another one than that taken last.
[[nodiscard]] bool is_new(const Locomotion::X& x);
/// e_x_c1,1[ready]: whether the driver wants the next fragment. Replies are two macrosteps old, so ready is a number: the
/// driver has notified for everything that it was handed.
[[nodiscard]] bool is_ready(const Locomotion::X& x);
/// f_tau of executing a plan: everything of it has been planned and handed over.
[[nodiscard]] bool plan_is_handed_over(const Locomotion::X& x);
/// @return standard deviation of the position, in the direction in which it is largest, from above [m]
[[nodiscard]] double uncertainty(const PlatformEstimate& estimate);
/// The planner finds no trajectory.
[[nodiscard]] bool in_vain(const Locomotion::X& x);

// --- behaviours -----------------------------------------------------------------------------------------------

/// c_B_1,1: wait for a plan; c_B_1,2: execute it; c_B_1,3: acknowledge it. In their order, again and again.
extern const std::array<Motion<Locomotion>, 3> kBehaviours;
extern const Motion<Locomotion> kWaitForStart;  ///< until the coordinator's first order of work
extern const Motion<Locomotion> kGiveUp;        ///< tells why, until the system stops

/// @return memory at the beginning of the task
[[nodiscard]] Memory begin(const Parameters& k);

/// Executes plans until the coordinator says that the task is over.
template <class Port>
Outcome run_program(Locomotion::X& x, Port& port) {
  Outcome o = move(kWaitForStart, x, port);
  for (std::size_t k = 0; o == Outcome::terminated && !x.T.finished; k = (k + 1) % kBehaviours.size()) {
    if (in_vain(x)) return move(kGiveUp, x, port);
    o = move(kBehaviours[k], x, port);
  }
  return o;
}

}  // namespace mrroc::rex_drive
