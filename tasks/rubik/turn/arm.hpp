// Images of the two arms that turn a face of the cube (MG 9.2).
#pragma once
#include <cstdint>

#include "base/pose.hpp"
#include "ecp/generators/rows.hpp"
#include "ecp/generators/space.hpp"
#include "tasks/rubik/turn/order.hpp"

namespace mrroc::rubik {

/// Order::m besides the behaviours of a cycle, 1..6, which any of them ends.
inline constexpr int kTakePath = 7;  ///< remember the point number `variant` of a path, and its jaws
inline constexpr int kGo = 8;        ///< go along the path; `variant` is kActs: until the jaws are there, too
inline constexpr int kWeigh = 9;     ///< force tool and bias, by weight and mass centre of the order
inline constexpr int kWait = 10;     ///< come to rest, the jaws stay

/// Order::variant of the behaviours of a cycle: the arm looks for the event, or it stands.
inline constexpr int kStands = 0;
inline constexpr int kActs = 1;

/// c_c of an arm: what the entry functions memorise, and the order.
struct ArmMemory {
  ecp::MotionLimits limits;  ///< of its motors in free motions; as many as the arm has axes
  JointPath joint_path;      ///< of the next free motion, as far as it is known
  ecp::Trajectory path;      ///< of the present free motion
  std::int64_t weighed{};    ///< macrostep in which the force tool was set in this behaviour, 0: not yet
  TurnOrder turn;            ///< as it was ordered last
  double mobility{0.025};    ///< B about z in this macrostep [s/(kg m^2)]
  double gap{};              ///< distance of the jaws at entry [m] (76)
  Pose T_0E;                 ///< pose of E at entry (74)
  double angle{};            ///< turned about z since then, unwrapped [rad]
};

/// An arm, holder or worker. The report's `event` is y_cT, tagged with m.
struct Arm : ArmAgent<ArmMemory, None, ArmOrder, ArmReport> {};

/// Steps of a macrostep: n_Q = n_s - 1.
inline constexpr ecp::Pacing kPacing{.n_s = 10, .n_Q = 9};

}  // namespace mrroc::rubik
