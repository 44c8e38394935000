// Two arms weigh their tools, show a board to cameras and touch the same balls, one after the other: what they find tells where
// their bases stand to each other, and where the cameras are.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "ecp/generators/weighing.hpp"
#include "ecp/solo.hpp"
#include "mp/solo_run.hpp"
#include "tasks/calibrate_cell/probing.hpp"
#include "tasks/calibrate_cell/viewing.hpp"

namespace mrroc::calibrate_cell {

/// c_c: what an arm remembers.
struct Memory {
  ecp::Weighing weighing;  ///< all that its rows need
  ViewPlan views;          ///< constant during a run
  std::size_t turn{};      ///< turns of the views that it has waited for
  std::size_t view{};      ///< poses that it has taken in the last of them
  int waits_for{};         ///< number of the turn that it has waited for last, see Turn; 0: none
  int touch_turn{};  ///< number of the turn in which it touches balls; 0: it touches none; constant during a run
  ProbePlan plan;                 ///< constant during a run
  std::vector<double> ready;      ///< joints in which the arm is ready before the balls [rad, track m]
  Pose T_ready;                   ///< of E there, in the base
  ecp::Trajectory path;           ///< to the next view or touch
  std::vector<Touch> done;        ///< touches so far
  Vector3 from{Vector3::Zero()};  ///< of E when a touch began, in the base [m]
  int contact{};                  ///< macrosteps in succession with contact
  Vector3 sum{Vector3::Zero()};   ///< of the middles of the tip in contact [m]
  int readings{};                 ///< in it
};

/// One of the arms; the coordinator tells it when the balls are its own.
struct Arm : ArmAgent<Memory> {};

/// Numbers of behaviours. Those from 1 to 10 weigh, see ecp::WeighingRows.
inline constexpr int kWithToolUp = 6, kWithToolSideways = 9;  ///< those that read the force
inline constexpr int kStand = 11, kWaitToView = 12, kToView = 13, kSettle = 14, kLook = 15, kKeepStill = 16;
inline constexpr int kGetReady = 17, kWait = 18, kGo = 19, kFeel = 20, kMeasure = 21, kLeave = 22,
                     kGiveUp = 23;

/// The behaviours, m = 1, 2, ...
extern const std::array<Motion<Arm>, kGiveUp> kBehaviours;

/// The coordinator's f_cT: of the turns that the arms wait for, the first one begins (Order::variant) when every arm waits, or
/// has done all.
void take_turns(std::span<const Report> agents, std::span<Order> orders);
/// The coordinator's f_cV: the cameras take pictures while an arm holds still for them.
[[nodiscard]] SensorSetting want_pictures(std::span<const Report> agents);

/// @return whether the last touch found nothing
[[nodiscard]] bool lost(const Memory& c);

/// Executes the task.
/// @param x  images of the first macrostep with the memory at the beginning @param port  a Port of the arm
/// @return why it ended; terminated also after a ball was not found, when that has been told
template <class P>
Outcome run_program(Arm::X& x, P& port) {
  const auto behaviour = [&](int m) { return move(kBehaviours[static_cast<std::size_t>(m - 1)], x, port); };
  const auto all = [&](std::initializer_list<int> behaviours) {
    Outcome o = Outcome::terminated;
    for (const int m : behaviours)
      if (o == Outcome::terminated) o = behaviour(m);
    return o;
  };
  Outcome o = Outcome::terminated;
  for (int m = 1; m < kStand && o == Outcome::terminated; ++m) o = behaviour(m);
  while (o == Outcome::terminated && x.c.turn < x.c.views.size()) {
    o = all({kStand, kWaitToView});
    while (o == Outcome::terminated && x.c.view < x.c.views[x.c.turn - 1].joints.size())
      o = all({kToView, kSettle, kLook, kKeepStill});
  }
  if (o != Outcome::terminated || x.c.touch_turn == 0) return o;
  o = all({kGetReady, kWait});
  while (o == Outcome::terminated && x.c.done.size() < touches(x.c.plan)) {
    o = all({kGo, kFeel});
    if (o != Outcome::terminated) break;
    if (lost(x.c)) return behaviour(kGiveUp);
    o = behaviour(kMeasure);
  }
  return o == Outcome::terminated ? behaviour(kLeave) : o;
}

/// Ways in which the bases are found.
struct Ways {
  bool touch{};  ///< both arms touch the same balls
  bool board{};  ///< one arm shows the board to the camera in the hand of the other one

  friend bool operator==(const Ways&, const Ways&) = default;
};
/// @return task.ways @throws ConfigError
[[nodiscard]] Ways read_ways(const Config& config);

/// @return memory at the beginning
/// @param arm  key: [task.ARM] says where it believes the balls, [robots.ARM] its tool and where it is ready
/// @throws ConfigError
[[nodiscard]] Memory read_memory(const Config& config, const std::string& arm);
/// @return what that arm does for the pictures: task.ARM.stand and so on @throws ConfigError; FaultError bad_configuration
[[nodiscard]] ViewPlan read_views(const Config& config, const std::string& arm);
/// @return how the balls are touched, see Memory::plan @throws ConfigError
[[nodiscard]] ProbePlan read_plan(const Config& config, const std::string& arm);

/// Body of the ECP of each arm.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

/// @return the task's TOML file
std::string_view config();

}  // namespace mrroc::calibrate_cell
