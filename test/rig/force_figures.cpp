// Identification of random tools, and the force that is measured without contact afterwards.
#include "test/rig/force_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "ecp/generators/weighing.hpp"
#include "robots/irb6/robot_type.hpp"
#include "test/rig/driven_arm.hpp"

namespace mrroc::rig {
namespace {

using std::numbers::pi;

struct Memory {
  ecp::Weighing weighing;
  Wrench sum{};
  int readings{};
};
struct Agent : ArmAgent<Memory> {};
using X = Agent::X;

/// Joints of an IRb-6 whose last three axes point the tool where it is wanted.
AxisVector joints(double q4, double q5, double q6) {
  AxisVector q(6);
  q << 0, -pi / 2, 0, q4, q5, q6;
  return q;
}

ecp::WeighingPlan plan_of(const irb6::Arm& robot) {
  ecp::WeighingPlan plan;
  plan.down = joints(0, 3 * pi / 2, 0);
  plan.up = joints(0, pi / 2, 0);
  plan.side = joints(0, 0, 0);
  plan.limits = ecp::default_limits(Representation::joints, robot.axes());
  plan.T_WE = robot.tool_in_wrist();
  return plan;
}

Memory add_reading(const X& x) {
  Memory c = x.c;
  if (ecp::age(x) < 50) return c;  // comes to rest
  c.sum += x.e.F_a;
  ++c.readings;
  return c;
}

Memory clear(const X& x) {
  Memory c = x.c;
  c.sum = {};
  c.readings = 0;
  return c;
}

const Motion<Agent> kTurn =
    ecp::row<Agent>(11, "turn", ecp::WeighingRows<Agent>::follow, ecp::WeighingRows<Agent>::arrived);
const Motion<Agent> kMeasure{12,
                             "measure",
                             clear,
                             add_reading,
                             ecp::at_rest<Agent>,
                             ecp::no_sensor<Agent>,
                             ecp::tell<Agent>,
                             ecp::after<Agent, 75>};

void must(Outcome outcome, const DrivenArm& arm) {
  if (outcome != Outcome::terminated) throw FaultError(arm.fault());
}

/// A simulated arm with a tool, and its control subsystem.
class WeighedArm {
 public:
  WeighedArm(const sim::ToolParameters& tool, std::uint64_t seed) : arm_(with(tool), seed), port_(arm_) {
    port_.read(x_);
    x_.c.weighing.plan = plan_of(arm_.robot());
  }
  ecp::ForceTool weigh() {
    for (const Motion<Agent>& row : ecp::WeighingRows<Agent>::rows(1)) must(move(row, x_, port_), arm_);
    return x_.c.weighing.found;
  }
  /// @return mean F_a at rest in those joints
  Wrench free_force(const AxisVector& goal) {
    x_.c.weighing.path = ecp::way_to(x_.c.weighing.plan, x_.e, goal);
    must(move(kTurn, x_, port_), arm_);
    must(move(kMeasure, x_, port_), arm_);
    return x_.c.sum * (1.0 / x_.c.readings);
  }

 private:
  static sim::ArmParameters with(const sim::ToolParameters& tool) {
    sim::ArmParameters arm = sim::arm_parameters(irb6::postument());
    arm.tool = tool;
    return arm;
  }
  DrivenArm arm_;
  DrivenPort<Agent> port_;
  X x_;
};

}  // namespace

ForceFigures measure_forces(int tools, int orientations, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  ForceFigures worst;
  for (int k = 0; k < tools; ++k) {
    const sim::ToolParameters tool{between(3, 20),
                                   {between(-0.03, 0.03), between(-0.03, 0.03), between(0.05, 0.2)}};
    WeighedArm arm(tool, seed + static_cast<std::uint64_t>(k));
    const ecp::ForceTool found = arm.weigh();
    worst.weight_pct = std::max(worst.weight_pct, 100 * std::abs(found.w / tool.weight - 1));
    worst.centre_mm = std::max(worst.centre_mm, 1e3 * (found.P - tool.mass_centre).norm());
    if (k > 0) continue;
    for (int n = 0; n < orientations; ++n) {
      const Wrench F = arm.free_force(joints(between(-0.5, 0.5), between(0.7, 4.5), between(-2.7, 2.7)));
      worst.free_force_N += F.linear().norm() / orientations;
      worst.free_torque_Nm += F.angular().norm() / orientations;
    }
  }
  return worst;
}

}  // namespace mrroc::rig
