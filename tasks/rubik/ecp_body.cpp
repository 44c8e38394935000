#include "ecp/shell.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/turn/agent.hpp"

namespace mrroc::rubik {

void run_ecp(link::Process& process, const Config& config, const link::PartArguments& arguments) {
  const std::string& arm = arguments.arm;
  const auto start =
      config.list("robots." + arm + ".start_joints", std::vector<double>{}, {-10, 10}, "rad, m");
  const ecp::MotionLimits limits = read_motion_limits(config, arm, static_cast<int>(start.size()));
  const ecp::Preparation prepare{.model = ecp::read_tool_model(config, arm)};
  ecp::run_ecp<Arm>(process, {.robot = arm, .sensor = {}}, prepare, [&limits](Arm::X& x, auto& port) {
    x.c.limits = limits;
    return run_arm(x, port);
  });
}

}  // namespace mrroc::rubik
