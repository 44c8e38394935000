// Images of the two arms that turn a face of the cube (MG 9.2).
#pragma once
#include <cstdint>

#include "base/pose.hpp"
#include "ecp/generators/rows.hpp"

namespace mrroc::rubik {

/// What the holder is to do with the face that the worker has gripped. Part of the memory.
struct TurnOrder {
  double torque{5};                  ///< F_d about z [N m]; negative: turns the other way
  double mobility{0.025};            ///< B about z [s/(kg m^2)], MG tab. 7; solving takes 0.1
  double angle{1.5707963267948966};  ///< to turn by [rad], positive
};

/// c_c of an arm: what the entry functions memorise, and the order.
struct Memory {
  TurnOrder turn;
  double gap{};    ///< distance of the jaws at entry [m] (76)
  Pose T_0E;       ///< pose of E at entry (74)
  double angle{};  ///< turned about z since then, unwrapped [rad]
};

/// An arm, holder or worker. The report's `event` is y_cT, tagged with m.
struct Arm : ecp::ArmAgent<Memory> {};

/// Steps of a macrostep: n_Q = n_s - 1.
inline constexpr ecp::Pacing kPacing{.n_s = 10, .n_Q = 9};

}  // namespace mrroc::rubik
