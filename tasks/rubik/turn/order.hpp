// The parts of the messages between the coordinator and an arm of the cube's task beside Order and Report.
#pragma once
#include <array>

#include "base/transmission.hpp"
#include "mrroc/cube_order_t.hpp"
#include "mrroc/cube_report_t.hpp"
#include "tasks/rubik/turn/joint_path.hpp"

namespace mrroc::rubik {

/// Order to the holder for the face that the worker has gripped. Part of the memory.
struct TurnOrder {
  double torque{5};        ///< F_d about z [N m]; negative: turns the other way
  double mobility{0.025};  ///< B about z [s/(kg m^2)] while the face turns, MG tab. 7; solving takes 0.1
  double angle{1.5707963267948966};  ///< to turn by [rad]; not above zero: the turn is over at once
};

/// y_cT_0j of the task: what goes with Order::m, which decides what of it counts. Trivially copyable.
struct CubeOrder {
  TurnOrder turn{.torque = 0, .mobility = 0, .angle = 0};  ///< m = 5
  double jaw_step{};  ///< m = 3, 4, 6: dg of the jaws, per macrostep [m]; 0: as in the tables
  PathPoint point;    ///< kTakePath: point number Order::variant of the path
  double jaws{};      ///< kTakePath: distance of the jaws on the path [m], 0: they stay
  double weight{};    ///< kWeigh: of what hangs on the force sensor, w [N]
  std::array<double, 3> mass_centre{};  ///< kWeigh: of it, W_G P [m]
};

/// y_cT_j0 of the task. Trivially copyable.
struct CubeReport {
  int points{};  ///< kTakePath: of the path that the arm knows
};

/// x_cT of an arm: the coordinator's order with what it is about.
struct ArmOrder : Order {
  CubeOrder cube;  ///< of the same macrostep
  using Order::operator=;
};
/// y_cT of an arm: its report with the task's part.
struct ArmReport : Report {
  CubeReport cube;  ///< of the same macrostep
  using Report::operator=;
};

/// The values as messages; meaning and units stay. The header is left to the channel.
[[nodiscard]] cube_order_t to_message(const CubeOrder& order);
[[nodiscard]] cube_report_t to_message(const CubeReport& report);

}  // namespace mrroc::rubik

namespace mrroc {

/// The messages as values. @param m  a proper one
[[nodiscard]] rubik::CubeOrder from_message(const cube_order_t& m);
[[nodiscard]] rubik::CubeReport from_message(const cube_report_t& m);
/// @return whether all numbers are finite and within what arms and cubes have. Real-time safe
[[nodiscard]] bool is_proper(const cube_order_t& m) noexcept;
[[nodiscard]] bool is_proper(const cube_report_t& m) noexcept;

}  // namespace mrroc
