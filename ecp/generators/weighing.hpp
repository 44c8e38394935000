// Identification of a tool: its weight and mass centre from three orientations (MG 8.2.1, eq. (40)-(42)).
#pragma once
#include <array>

#include "ecp/generators/rows.hpp"
#include "ecp/generators/trapezoid.hpp"

namespace mrroc::ecp {

/// Weight and mass centre of everything beyond the force sensor.
struct ForceTool {
  double w{};                  ///< [N]
  Vector3 P{Vector3::Zero()};  ///< W_G P [m], in W
};

/// MG (40)-(42) in the form of a control subsystem, which sees F_a only: E = W, and the force tool was w = 0,
/// P = 0 when the force was biased with z_W down.
/// @param F_b  mean F_a with z_W up  @param F_c  mean F_a with x_W up, y_W and z_W horizontal
/// @return the tool; its centre is zero when there is no weight to speak of (below 0.05 N)
[[nodiscard]] ForceTool identified_tool(const Wrench& F_b, const Wrench& F_c);

/// Parameters of the weighing. Joints are data of the robot, not of the method: they belong into a
/// configuration.
struct WeighingPlan {
  Coordinates down, up, side;  ///< joints in which z_W points down (a) and up (b), and x_W up (c)
  MotionLimits limits;         ///< of the joints, full
  double velocity{0.35};       ///< fractions of them, on the way between the three
  double acceleration{0.1};    ///< the same of the acceleration
  int settling{50};            ///< macrosteps at rest before anything is measured
  Pose T_WE;                   ///< tool that is set when all is done: the task frame is the wrist meanwhile
  int readings{100};           ///< macrosteps over which F_a is averaged
  Pacing pacing;               ///< of the agent's macrosteps
};

/// Memory of the weighing, a part of the memory c_c of an agent under the name `weighing`.
struct Weighing {
  WeighingPlan plan;    ///< given before the first row
  Trajectory path;      ///< to the next orientation
  Wrench sum{};         ///< of F_a
  int readings{};       ///< in it
  Wrench F_b{}, F_c{};  ///< means
  ForceTool found;      ///< valid when the last row has ended

  /// @return the mean so far
  [[nodiscard]] Wrench mean() const;
};

/// @return the joints that a reply has measured
[[nodiscard]] Coordinates joints_of(const EffectorReply& reply, Eigen::Index axes);
/// @return from the measured joints to the goal, at the plan's speed
[[nodiscard]] Trajectory way_to(const WeighingPlan& plan, const EffectorReply& reply,
                                const Coordinates& goal);

/// @return SET ROBOT_MODEL: the force tool that was found, and the plan's tool
[[nodiscard]] EffectorCommand with_found(const Weighing& weighing);

/// Rows of a table that weigh the tool. Before: the arm is at rest without contact. After: the force tool is
/// set and the force is biased at the orientation (c).
/// @tparam A  agent whose memory has a `Weighing weighing`
template <class A>
struct WeighingRows {
  /// Image and memory of the agent.
  using X = typename A::X;
  using C = decltype(X::c);

  /// Orientations of the tool, as in WeighingPlan.
  enum class Goal : std::uint8_t { down, up, side };

  /// @return memory with the way from the measured joints to the goal
  template <Goal goal>
  static C plan_way(const X& x) {
    C c = x.c;
    const WeighingPlan& plan = c.weighing.plan;
    c.weighing.path = way_to(plan, x.e,
                             goal == Goal::down ? plan.down
                             : goal == Goal::up ? plan.up
                                                : plan.side);
    return c;
  }
  /// Goes along that way, until its last macrostep.
  static EffectorCommand follow(const X& x) { return move_arm(x.c.weighing.path.command(age(x))); }
  static bool arrived(const X& x) { return age(x) >= x.c.weighing.path.macrosteps(); }

  /// Rests, for plan.settling macrosteps.
  static EffectorCommand stand(const X&) { return rest(); }
  static bool settled(const X& x) { return age(x) >= x.c.weighing.plan.settling; }

  /// E = W and no force tool, which biases (a).
  static EffectorCommand begin(const X& x) {
    return age(x) == 0 ? with_tool(change_force_tool(0, Vector3::Zero()), Pose{}) : rest();
  }
  /// The tool that was found, which biases again.
  static EffectorCommand set_found(const X& x) { return age(x) == 0 ? with_found(x.c.weighing) : rest(); }
  /// Ends both: the driver has answered.
  static bool answered(const X& x) { return age(x) >= latency::kCommandToReply; }

  /// Sums F_a, from zero, until there are plan.readings of them.
  static C clear(const X& x) {
    C c = x.c;
    c.weighing.sum = {};
    c.weighing.readings = 0;
    return c;
  }
  static C add(const X& x) {
    C c = x.c;
    c.weighing.sum += x.e.F_a;
    ++c.weighing.readings;
    return c;
  }
  static bool averaged(const X& x) { return x.c.weighing.readings >= x.c.weighing.plan.readings; }
  /// F_b is the mean; then the way to (c).
  static C keep_b(const X& x) {
    C c = plan_way<Goal::side>(x);
    c.weighing.F_b = x.c.weighing.mean();
    return c;
  }
  /// F_c is the mean, which tells the tool.
  static C identify(const X& x) {
    C c = x.c;
    c.weighing.F_c = c.weighing.mean();
    c.weighing.found = identified_tool(c.weighing.F_b, c.weighing.F_c);
    return c;
  }
  /// @param m  number of the first of the ten rows
  static constexpr std::array<Motion<A>, 10> rows(int m) {
    const auto row = [&](const char* name, auto entry, auto memory, auto command, auto ends,
                         const char* until) {
      return Motion<A>{m++, name, entry, memory, command, no_sensor<A>, tell<A>, ends, until};
    };
    // clang-format off
    return {{
        row("turn the tool down",     plan_way<Goal::down>, retain<A>, follow, arrived, "the tool is there"),
        row("rest with the tool down", retain<A>, retain<A>, stand, settled, "the arm rests"),
        row("bias with the tool down", retain<A>,              retain<A>, begin,     answered, "the force is zero"),
        row("turn the tool up",       plan_way<Goal::up>,   retain<A>, follow, arrived, "the tool is there"),
        row("rest with the tool up", retain<A>, retain<A>, stand, settled, "the arm rests"),
        row("weigh with the tool up", clear,                add,    stand,     averaged, "all readings taken"),
        row("turn the tool sideways", keep_b,               retain<A>, follow, arrived, "the tool is there"),
        row("rest with the tool sideways", retain<A>, retain<A>, stand, settled, "the arm rests"),
        row("weigh with the tool sideways", clear,          add,    stand,     averaged, "all readings taken"),
        row("set the tool found",     identify,             retain<A>, set_found, answered, "the driver has it"),
    }};
    // clang-format on
  }
};

}  // namespace mrroc::ecp
