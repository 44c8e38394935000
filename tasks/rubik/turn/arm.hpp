// Images of the two arms that turn a face of the cube (MG 9.2).
#pragma once
#include <cstdint>

#include "base/pose.hpp"
#include "ecp/generators/rows.hpp"
#include "ecp/generators/space.hpp"
#include "tasks/rubik/turn/way.hpp"

namespace mrroc::rubik {

/// Order::m besides the behaviours of a cycle, 1..6, which any of them ends.
inline constexpr int kTakeWay = 7;  ///< remember the point number `variant` of a way, and its jaws
inline constexpr int kGo = 8;       ///< go along the way; `variant` is kActs: until the jaws are there, too
inline constexpr int kWeigh = 9;    ///< force tool and bias: pose[0] is w [N], pose[1..3] P [m]
inline constexpr int kWait = 10;    ///< come to rest, the jaws stay

/// Order::variant of the behaviours of a cycle: the arm looks for the event, or it stands.
inline constexpr int kStands = 0;
inline constexpr int kActs = 1;

/// What the holder is to do with the face that the worker has gripped. Part of the memory.
struct TurnOrder {
  double torque{5};        ///< F_d about z [N m]; negative: turns the other way
  double mobility{0.025};  ///< B about z [s/(kg m^2)] while the face turns, MG tab. 7; solving takes 0.1
  double angle{1.5707963267948966};  ///< to turn by [rad]; not above zero: the turn is over at once
};

/// @return what the coordinator orders: F_d and B about z, and the angle as a pose relative to the present one
[[nodiscard]] TurnOrder turn_of(const Order& order);
/// Puts it into an order.
void put_turn(const TurnOrder& turn, Order& order);
/// @return dg of jaws that touch nothing, per macrostep [m]: gripper of the order's command; without one the tables'
[[nodiscard]] double jaw_step_of(const Order& order);

/// c_c of an arm: what the entry functions memorise, and the order.
struct ArmMemory {
  ecp::MotionLimits limits;  ///< of its motors in free motions; as many as the arm has axes
  Way way;                   ///< of the next free motion, as far as it is known
  ecp::Trajectory path;      ///< of the present free motion
  std::int64_t weighed{};    ///< macrostep in which the force tool was set in this behaviour, 0: not yet
  TurnOrder turn;            ///< as it was ordered last
  double mobility{0.025};    ///< B about z in this macrostep [s/(kg m^2)]
  double gap{};              ///< distance of the jaws at entry [m] (76)
  Pose T_0E;                 ///< pose of E at entry (74)
  double angle{};            ///< turned about z since then, unwrapped [rad]
};

/// An arm, holder or worker. The report's `event` is y_cT, tagged with m.
struct Arm : ecp::ArmAgent<ArmMemory> {};

/// Steps of a macrostep: n_Q = n_s - 1.
inline constexpr ecp::Pacing kPacing{.n_s = 10, .n_Q = 9};

}  // namespace mrroc::rubik
