// Images of the agents of the drawing task (MS 8.1): the coordinator a_0 and the transparent agents a_1, a_2.
#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "base/agent_images.hpp"
#include "base/latency.hpp"
#include "base/pose.hpp"
#include "base/task_clock.hpp"
#include "base/transmission.hpp"
#include "ecp/generators/paced_command.hpp"
#include "ecp/generators/rows.hpp"
#include "tasks/drawing/belt.hpp"
#include "tasks/drawing/recording.hpp"

namespace mrroc::drawing {

/// Number of arms that draw.
inline constexpr std::size_t kArms = 2;
/// Number of the conveyor among the effectors of a run that has one: behind the arms.
inline constexpr std::size_t kConveyor = kArms;

/// Task time at full pace in every macrostep from an order to what is decided on its effect.
inline constexpr auto kFullPace = [] {
  std::array<double, latency::kLoop> paces{};
  paces.fill(1);
  return paces;
}();

/// Parameters of the task, constant during a run; part of the memory, so that f' depends on x alone.
struct Parameters {
  double dt{0.002};        ///< duration of a step [s]
  int n_s{10};             ///< steps of a macrostep; n_Q = n_s - 1
  double teach_force{1};   ///< F_d along z in m = 2 while the pen is on the paper [N], see docs/decisions.md
  double draw_force{1};    ///< F_d along z in m = 5 [N]
  int settle{25};          ///< macrosteps in m = 4 after both pens have touched
  int touch_timeout{750};  ///< macrosteps in m = 4 after which a pen that has not touched is a fault
  int lift_off{50};        ///< i_d: macrosteps of m = 6
  bool belt_runs{};  ///< the conveyor runs by itself and the arms follow it; else it moves for them (MS 8.3)
  double belt_lag{
      kBeltLag};  ///< time by which the arms come later than they are ordered [macrosteps], see belt.hpp
  int pause{TaskClock::kRamp};  ///< macrosteps from full pace of task time to standstill

  friend bool operator==(const Parameters&, const Parameters&) = default;
};

/// c_c0. Indices of the paper in brackets.
struct CoordinatorMemory {
  Parameters k;            ///< constant during a run
  Recording recording;     ///< [1] velocities, [2] pen states and [4] number n of the nodes
  double p{};              ///< [3] nodes already executed; whole numbers except around a pause
  Pose T_previous;         ///< [5] pose of E of arm 1 when the last node ended
  Pose T_seen;             ///< m = 2: pose of E of arm 1 when task time went on last
  double share{};          ///< m = 2: of the next node that has passed, 0..1
  double way{};            ///< m = 2: of E of arm 1 in the last macrostep at full pace [m]
  bool lifted{};           ///< m = 2: lift_off or above_paper was reported and no node has told of it yet
  double instant{};        ///< [6] task time at which the behaviour, or in m = 4 the contact of both, began
  double begun{};          ///< m = 4: task time at which it began
  std::int64_t trigger{};  ///< operator's trigger number at entry
  /// Pace of task time in the macrostep that the reports are about, and in those that have been ordered since.
  std::array<double, latency::kLoop> paces = kFullPace;
  std::array<std::optional<Vector3>, kArms>
      met{};       ///< where E of each arm was on its sheet before the first stroke, in its base [m]
  bool touched{};  ///< m = 4: both pens are on the paper since `instant`
  std::array<ecp::HeldShares, kArms> held{};  ///< m = 4: of each arm's velocities
  BeltTrack belt;                             ///< of a conveyor that runs by itself
};

/// a_0: coordinates; has neither effector nor virtual sensors. Its agents are the arms', and behind them that of the
/// conveyor in a run that has one.
struct Coordinator : CoordinatorAgent<CoordinatorMemory, std::dynamic_extent> {
  /// As in CoordinatorAgent; without more it is of the arms alone.
  struct X : CoordinatorAgent<CoordinatorMemory, std::dynamic_extent>::X {
    X() { T.agent.resize(kArms); }
    [[nodiscard]] bool has_conveyor() const { return T.agent.size() > kConveyor; }
  };
};

/// a_1, a_2: copy the coordinator's orders to the effector, and effector and sensor to the coordinator. They
/// have no memory.
struct Arm : ArmAgent<None> {};

}  // namespace mrroc::drawing
