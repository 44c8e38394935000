// The agent a_j of the task: goes to the start of its motions and executes one after another.
#pragma once
#include <array>
#include <memory>
#include <span>

#include "base/motion.hpp"
#include "ecp/generators/rows.hpp"
#include "tasks/move/plan.hpp"

namespace mrroc::any_motion {

/// c_c: what an arm remembers.
struct Memory {
  std::shared_ptr<const ArmPlan> plan;  ///< constant during a run; null: nothing is to be done
  std::shared_ptr<const Body> body;     ///< of the arm; constant. Null: the way to the start is a slow one
  bool together{};                      ///< each motion waits for the other arms; constant
  std::size_t motion{};                 ///< which one is executed, or comes next
  ecp::Trajectory path;                 ///< to the start

  friend bool operator==(const Memory& a, const Memory& b) {
    return a.plan == b.plan && a.body == b.body && a.together == b.together && a.motion == b.motion &&
           a.path.macrosteps() == b.path.macrosteps();
  }
};

/// One of the arms. Its report's `event` is the number of the motion, from 1 on, for which it is ready or which it executes; 0: none.
/// The order's `variant` is the number of the motion for which all arms are ready.
struct Arm : ArmAgent<Memory> {};

/// The behaviours, m = 1, 2, ...
enum class Row : std::uint8_t { start, rest, wait, move };
/// The table, in the order of Row.
extern const std::array<Motion<Arm>, 4> kMove;
/// @return the row
inline const Motion<Arm>& row(Row r) { return kMove[static_cast<std::size_t>(r)]; }

/// Executes the plan in x.c.
template <class Port>
Outcome run_program(Arm::X& x, Port& port) {
  if (!x.c.plan || !x.c.plan->moves) return Outcome::terminated;
  Outcome o = Outcome::terminated;
  const auto execute = [&](Row r) {
    if (o == Outcome::terminated) o = mrroc::move(row(r), x, port);
  };
  execute(Row::start);
  execute(Row::rest);
  for (; o == Outcome::terminated && x.c.motion < x.c.plan->motions.size(); ++x.c.motion) {
    if (x.c.together) execute(Row::wait);
    execute(Row::move);
    execute(Row::rest);
  }
  return o;
}

/// f_cT of the coordinator: tells all arms for which motion every one of them is ready.
void coordinate(std::span<const Report> agents, std::span<Order> orders);

}  // namespace mrroc::any_motion
