#include "tasks/drawing/ecp_body.hpp"

#include <algorithm>

#include "ecp/shell.hpp"
#include "tasks/drawing/tables.hpp"

namespace mrroc::drawing {
namespace {

/// Tool and force tool, as the configuration gives them.
RobotModel read_model(const Config& tool) {
  RobotModel m;
  m.set_tool = true;
  m.tool_representation = Representation::xyz_angle_axis;
  std::ranges::copy(tool.numbers<6>("pose", std::nullopt, {-10, 10}, "m, rad"), m.tool.begin());
  m.set_force_tool = true;
  m.weight = tool.number("weight", std::nullopt, {0, 50}, "N");
  m.mass_centre = tool.numbers<3>("mass_centre", std::nullopt, {-1, 1}, "m");
  return m;
}

}  // namespace

void run_drawing_ecp(link::Process& process, const Config& config, const link::PartArguments& arguments) {
  const std::string& arm = arguments.arm;
  ecp::Preparation prepare{.model = read_model(config.section("robots." + arm + ".tool"))};
  ecp::run_ecp<Arm>(process, {.robot = arm, .sensor = arm + ".pen_state"}, prepare,
                    [](Arm::X& x, auto& port) { return move(kTransparent, x, port); });
}

}  // namespace mrroc::drawing
