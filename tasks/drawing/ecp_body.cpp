#include "tasks/drawing/ecp_body.hpp"

#include "ecp/shell.hpp"
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {

void run_drawing_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  const std::string& arm = arguments.arm;
  ecp::Preparation prepare{.model = ecp::read_tool_model(config, arm)};
  ecp::run_ecp<Arm>(process, {.robot = arm, .sensor = arm + ".pen_state"}, prepare,
                    [](Arm::X& x, auto& port) { return move(kTransparent, x, port); });
}

}  // namespace mrroc::drawing
