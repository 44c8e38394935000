#include "tasks/weigh/weigh.hpp"

#include <fmt/core.h>

#include <cmath>

#include "base/representation.hpp"
#include "ecp/preparation.hpp"
#include "ecp/solo.hpp"

namespace mrroc::weigh {
Wrench mean_reading(const mp::ArmTrace& trace, int m) {
  Wrench mean;
  for (const Axis a : kAxes) mean[a] = mp::mean_force(trace, a, m, HUGE_VAL);
  return mean;
}

const std::array<Motion<Arm>, 10> kWeigh = ecp::WeighingRows<Arm>::rows(1);

Memory read_memory(const Config& config, const std::string& arm) {
  const Config task = config.section("task");
  const auto joints = [&](std::string_view key) -> ecp::Coordinates {
    const std::array<double, 6> q = task.numbers<6>(key, std::nullopt, {-7, 7}, "rad");
    return Eigen::Map<const Vector6>(q.data());
  };
  Memory c;
  ecp::WeighingPlan& plan = c.weighing.plan;
  plan.down = joints("down");
  plan.up = joints("up");
  plan.side = joints("side");
  plan.limits = ecp::default_limits(Representation::joints, 6);
  plan.readings = static_cast<int>(task.integer("readings", plan.readings, {10, 1000}, "macrosteps"));
  const RobotModel model = ecp::read_tool_model(config, arm);
  plan.T_WE = pose_from_numbers(model.tool_representation, model.tool).value_or(Pose{});
  return c;
}

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  ecp::run_solo_ecp<Arm>(process, config, arguments, [&](Arm::X& x, auto& port) {
    x.c = read_memory(config, arguments.arm);
    return ecp::execute_rows<Arm>(std::span<const Motion<Arm>>(kWeigh), x, port);
  });
}

ecp::ForceTool found_tool(const mp::ArmTrace& trace) {
  return ecp::identified_tool(mean_reading(trace, kWithToolUp), mean_reading(trace, kWithToolSideways));
}

mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Config&) {
  const ecp::ForceTool tool = found_tool(arms[0]);
  return {{{"tool_weight_N", "weight of the tool", "N"}, tool.w},
          {{"tool_mass_centre_m", "its mass centre in the wrist, x y z", "m"},
           std::vector<double>{tool.P.x(), tool.P.y(), tool.P.z()}}};
}

std::string result(const std::vector<mp::ArmTrace>& arms) {
  const ecp::ForceTool tool = found_tool(arms[0]);
  return fmt::format("[robots.arm1.tool]\nweight = {:.3f}\nmass_centre = [{:.4f}, {:.4f}, {:.4f}]\n", tool.w,
                     tool.P.x(), tool.P.y(), tool.P.z());
}

}  // namespace mrroc::weigh
