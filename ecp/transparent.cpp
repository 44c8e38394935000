#include "ecp/transparent.hpp"

#include "ecp/shell.hpp"

namespace mrroc::ecp {
namespace {

struct Arm : ArmAgent<None> {};

}  // namespace

void run_transparent(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  const std::string& arm = arguments.arm;
  const Preparation prepare{.model = read_tool_model(config, arm)};
  run_ecp<Arm>(process, {.robot = arm, .sensor = {}}, prepare,
               [](Arm::X& x, auto& port) { return move(transparent<Arm>(), x, port); });
}

}  // namespace mrroc::ecp
