#include "tasks/drawing/ecp_body.hpp"

#include "ecp/shell.hpp"
#include "tasks/drawing/config.hpp"
#include "tasks/drawing/conveyor.hpp"
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

/// The agent of the conveyor.
void run_conveyor_ecp(link::Process& process, const Config& config, const ecp::Preparation& prepare) {
  const ecp::EffectorLinkNames names{.robot = kConveyorKey, .sensor = {}};
  const double speed = read_belt_speed(config);
  if (speed == 0)
    return ecp::run_ecp<Arm>(process, names, prepare,
                             [](Arm::X& x, auto& port) { return move(kTransparent, x, port); });
  const Parameters k = read_parameters(config);
  ecp::run_ecp<Belt>(process, names, prepare, [&](Belt::X& x, auto& port) {
    x.c = {.speed = speed, .dt = k.dt, .n_s = k.n_s};
    const Outcome o = move(kBeltStands, x, port);
    return o == Outcome::terminated ? move(kBeltRuns, x, port) : o;
  });
}

}  // namespace

void run_drawing_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  const std::string& arm = arguments.arm;
  ecp::Preparation prepare{.model = ecp::read_tool_model(config, arm)};
  if (arm == kConveyorKey) return run_conveyor_ecp(process, config, prepare);
  ecp::run_ecp<Arm>(process, {.robot = arm, .sensor = arm + ".pen_state"}, prepare,
                    [](Arm::X& x, auto& port) { return move(kTransparent, x, port); });
}

}  // namespace mrroc::drawing
