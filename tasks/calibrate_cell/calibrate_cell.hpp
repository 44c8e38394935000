// Two arms weigh their tools and touch the same balls, one after the other: what they find tells where their bases stand to
// each other.
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

namespace mrroc::calibrate_cell {

/// c_c: what an arm remembers.
struct Memory {
  ecp::Weighing weighing;         ///< all that its rows need
  ProbePlan plan;                 ///< constant during a run
  std::vector<double> ready;      ///< joints in which the arm is ready before the balls [rad, track m]
  Pose T_ready;                   ///< of E there, in the base
  ecp::Trajectory path;           ///< to the next touch
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
inline constexpr int kGetReady = 11, kWait = 12, kGo = 13, kFeel = 14, kMeasure = 15, kLeave = 16,
                     kGiveUp = 17;

/// The behaviours, m = 1, 2, ...
extern const std::array<Motion<Arm>, kGiveUp> kBehaviours;

/// The coordinator's f_cT: the balls are arm1's first, then arm2's.
void take_turns(std::span<const Report> agents, std::span<Order> orders);

/// @return whether the last touch found nothing
[[nodiscard]] bool lost(const Memory& c);

/// Executes the task.
/// @param x  images of the first macrostep with the memory at the beginning @param port  a Port of the arm
/// @return why it ended; terminated also after a ball was not found, when that has been told
template <class P>
Outcome run_program(Arm::X& x, P& port) {
  const auto behaviour = [&](int m) { return move(kBehaviours[static_cast<std::size_t>(m - 1)], x, port); };
  Outcome o = Outcome::terminated;
  for (int m = 1; m <= kWait && o == Outcome::terminated; ++m) o = behaviour(m);
  while (o == Outcome::terminated && x.c.done.size() < touches(x.c.plan)) {
    for (const int m : {kGo, kFeel})
      if (o == Outcome::terminated) o = behaviour(m);
    if (o != Outcome::terminated) break;
    if (lost(x.c)) return behaviour(kGiveUp);
    o = behaviour(kMeasure);
  }
  return o == Outcome::terminated ? behaviour(kLeave) : o;
}

/// @return memory at the beginning
/// @param arm  key: [task.ARM] says where it believes the balls, [robots.ARM] its tool and where it is ready
/// @throws ConfigError
[[nodiscard]] Memory read_memory(const Config& config, const std::string& arm);
/// @return how the balls are touched, see Memory::plan @throws ConfigError
[[nodiscard]] ProbePlan read_plan(const Config& config, const std::string& arm);

/// Body of the ECP of each arm.
void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

/// @return the task's TOML file
std::string_view config();

}  // namespace mrroc::calibrate_cell
