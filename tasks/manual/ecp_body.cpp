#include "ecp/solo.hpp"
#include "tasks/manual/config.hpp"

namespace mrroc::manual {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments,
             const Reach& reach) {
  link::IncomingLink<ManualOrder> orders(process, arguments.arm + ".manual");
  Memory memory = read_memory(config, arguments.arm);
  memory.reach = &reach;
  ecp::run_ecp<Arm>(
      process, {.robot = arguments.arm, .sensor = {}, .others = {.incoming = {&orders}}},
      {.by_program = true}, [&](Arm::X& x, ecp::ArmPort<Arm>& arm) {
        ecp::SoloPort<Arm> port(arm.links());
        // In a pause, too: an order that calls off the present one, and the end of the task.
        const auto urgent = [](const Arm::X& now) { return called_off(now); };
        port.also({.read = [&](Arm::X& now) { now.T.manual = orders.image().value; }, .urgent = urgent});
        port.read(x);
        x.c = memory;
        return run_program(x, port);
      });
}

}  // namespace mrroc::manual
