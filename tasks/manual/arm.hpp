// The agent a_j of manual operation: executes one order after the other.
#pragma once
#include <array>

#include "ecp/generators/rows.hpp"
#include "tasks/manual/order.hpp"
#include "tasks/manual/reach.hpp"

namespace mrroc::manual {

/// c_c: what the agent remembers.
struct Memory {
  int axes{6};           ///< of the arm
  ecp::Pacing pacing;    ///< of its macrosteps
  RobotModel model;      ///< set after homing: tool and force tool
  std::int64_t doing{};  ///< number of the order that it does, or did last
  std::int64_t done{};   ///< number of the order that has ended last
  Fault fault;           ///< why the last order failed; none: it did not
  ecp::Trajectory path;  ///< of the present motion
  const Reach* reach{};  ///< refuses goals beyond the arm's ranges; none: the driver does when it comes there
  std::optional<int> kinematic_model;  ///< as the operator set it; nothing: that of the configuration
};

/// Images. T is what the coordinator says: its Order, and the operator's order for this arm. The report's `event` is the
/// number of the order that has ended last, its `fault` why that failed.
struct Arm {
  /// x_cT: the coordinator's order with what the operator asks of this arm.
  struct Heard : Order {
    ManualOrder manual;  ///< the newest one; its number tells whether it is new
    using Order::operator=;
  };
  /// x: memory c, reply e of the effector, what is heard T, macrostep i, and i_0 in which the behaviour began; no V.
  struct X {
    Memory c;
    EffectorReply e;
    ecp::None V;
    Heard T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  /// y: the new memory c, command e to the effector, report T.
  struct Y {
    Memory c;
    EffectorCommand e;
    ecp::None V;
    Report T;
  };
};

/// The behaviours: m = 1 waits for an order, the others do one.
enum class Row : std::uint8_t { idle, find_position, settle, set_tool, move, set, grip };
/// The table, in the order of Row.
extern const std::array<Motion<Arm>, 7> kManual;
/// @return the row
inline const Motion<Arm>& row(Row r) { return kManual[static_cast<std::size_t>(r)]; }

/// @return whether the operator wants something else than what the agent does, or nothing any more
[[nodiscard]] bool called_off(const Arm::X& x);

/// Executes orders until the task is over.
template <class Port>
Outcome run_program(Arm::X& x, Port& port) {
  Outcome o = mrroc::move(row(Row::idle), x, port);
  const auto execute = [&](std::initializer_list<Row> rows) {
    for (const Row r : rows)
      if (o == Outcome::terminated && !x.c.fault && x.T.manual.number == x.c.doing)
        o = mrroc::move(row(r), x, port);
  };
  while (o == Outcome::terminated && !x.T.finished) {
    x.c.doing = x.T.manual.number;
    x.c.fault = {};
    switch (x.T.manual.kind) {
      case Kind::nothing:
      case Kind::stop:
        break;
      case Kind::home:
        execute({Row::find_position, Row::settle, Row::set_tool});
        break;
      case Kind::move:
        execute({Row::move});
        break;
      case Kind::gripper:
        execute({Row::grip});
        break;
      default:
        execute({Row::set});
    }
    if (o == Outcome::terminated) o = mrroc::move(row(Row::idle), x, port);
  }
  return o;
}

}  // namespace mrroc::manual
