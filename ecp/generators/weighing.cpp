#include "ecp/generators/weighing.hpp"

#include <algorithm>

namespace mrroc::ecp {
namespace {

constexpr double kNoWeight = 0.05;  // [N], what the sensor's noise may look like

}  // namespace

ForceTool identified_tool(const Wrench& F_b, const Wrench& F_c) {
  ForceTool tool;
  tool.w = F_b[Axis::z] / 2;  // (40)
  if (tool.w < kNoWeight) return {};
  tool.P.x() = -F_b[Axis::ay] / (2 * tool.w);  // (41)
  tool.P.y() = F_b[Axis::ax] / (2 * tool.w);
  tool.P.z() = F_c[Axis::ay] / tool.w - F_b[Axis::ay] / (2 * tool.w);  // (42)
  return tool;
}

Wrench Weighing::mean() const { return sum * (1.0 / std::max(1, readings)); }

Coordinates joints_of(const EffectorReply& reply, Eigen::Index axes) {
  return Eigen::Map<const Eigen::VectorXd>(reply.joints.data(), axes);
}

Trajectory way_to(const WeighingPlan& plan, const EffectorReply& reply, const Coordinates& goal) {
  const auto way = std::make_shared<Trapezoid>(
      joints_of(reply, goal.size()), std::vector<ViaPoint>{{goal, plan.velocity, plan.acceleration}},
      plan.limits, plan.pacing.macrostep_s());
  return {way, {.space = Representation::joints}, plan.pacing};
}

EffectorCommand with_found(const Weighing& weighing) {
  return with_tool(change_force_tool(weighing.found.w, weighing.found.P), weighing.plan.T_WE);
}

}  // namespace mrroc::ecp
