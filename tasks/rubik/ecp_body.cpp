#include "base/linked_port.hpp"
#include "ecp/shell.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/turn/agent.hpp"

namespace mrroc::rubik {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  const std::string& arm = arguments.arm;
  const auto start =
      config.list("robots." + arm + ".start_joints", std::vector<double>{}, {-10, 10}, "rad, m");
  const ecp::MotionLimits limits = read_motion_limits(config, arm, static_cast<int>(start.size()));
  const ecp::Preparation prepare{.model = ecp::read_tool_model(config, arm)};
  link::IncomingLink<CubeOrder> order(process, arm + ".cube_order");
  link::OutgoingLink<CubeReport> report(process, arm + ".cube_report");
  const link::OtherLinks others{.incoming = {&order}, .outgoing = {&report}};
  ecp::run_ecp<Arm>(process, {.robot = arm, .sensor = {}, .others = others}, prepare,
                    [&](Arm::X& x, auto& arm_port) {
                      LinkedPort port(
                          arm_port, [&](const Arm::Y& y) { report.set(y.T.cube); },
                          [&](Arm::X& heard) { heard.T.cube = order.image().value; });
                      port.read(x);
                      x.c.limits = limits;
                      return run_arm(x, port);
                    });
}

}  // namespace mrroc::rubik
