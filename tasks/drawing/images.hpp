// Images of the agents of the drawing task (MS 8.1): the coordinator a_0 and the transparent agents a_1, a_2.
#pragma once
#include <array>
#include <cstdint>

#include "base/operator.hpp"
#include "base/pose.hpp"
#include "base/transmission.hpp"
#include "ecp/generators/rows.hpp"
#include "tasks/drawing/recording.hpp"

namespace mrroc::drawing {

/// Number of arms that draw.
inline constexpr std::size_t kArms = 2;

using ecp::None;

/// Parameters of the task, constant during a run; part of the memory, so that f' depends on x alone.
struct Parameters {
  double dt{0.002};         ///< duration of a step [s]
  int n_s{10};              ///< steps of a macrostep; n_Q = n_s - 1
  double teach_force{1};    ///< F_d along z in m = 2 while the pen is on the paper [N], see docs/decisions.md
  double draw_force{1};     ///< F_d along z in m = 5 [N]
  int settle{25};           ///< macrosteps in m = 4 after both pens have touched
  int touch_patience{750};  ///< macrosteps in m = 4 after which a pen that has not touched is a fault
  int lift_off{50};         ///< i_d: macrosteps of m = 6
  double pace_change{
      0.1};  ///< change of the pace of task time per macrostep at pause and resume, 1 / whole number

  friend bool operator==(const Parameters&, const Parameters&) = default;
};

/// a_0: coordinates; has neither effector nor virtual sensors.
struct Coordinator {
  /// c_c0. Indices of the paper in brackets.
  struct Memory {
    Parameters k;            ///< constant during a run
    Recording recording;     ///< [1] velocities, [2] pen states and [4] number n of the nodes
    double p{};              ///< [3] nodes already executed; whole numbers except around a pause
    Pose T_previous;         ///< [5] pose of E of arm 1 when the last node ended
    double instant{};        ///< [6] task time at which the behaviour, or in m = 4 the contact of both, began
    double begun{};          ///< m = 4: task time at which it began
    std::int64_t trigger{};  ///< operator's trigger number at entry
    double time{};           ///< task time [macrosteps]: stands still during a pause
    double pace{1};          ///< task time per macrostep, 0..1
    bool touched{};          ///< m = 4: both pens are on the paper since `instant`
  };
  /// x_cT0: what the agents and the operator say.
  struct Transmission {
    std::array<Report, kArms> agent;  ///< x_cT_0j
    OperatorImage h;                  ///< x_cT_0h
  };
  /// x: memory c, what is told T, macrostep i, and i_0 in which the behaviour began; no effector e, no sensors V.
  struct X {
    Memory c;
    None e;
    None V;
    Transmission T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c and the orders T.
  struct Y {
    Memory c;
    None e;
    None V;
    std::array<Order, kArms> T;  ///< y_cT_0j
  };
};

/// a_1, a_2: copy the coordinator's orders to the effector, and effector and sensor to the coordinator. They
/// have no memory.
struct Arm : ecp::ArmAgent<None> {};

}  // namespace mrroc::drawing
