#include "ecp/solo.hpp"
#include "tasks/guide/config.hpp"

namespace mrroc::guide {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  ecp::run_solo_ecp<Arm>(process, config, arguments, [&](Arm::X& x, auto& port) {
    // A fixture holds during a pause, too: the operator's hand is at the tool.
    port.also({.read = {}, .urgent = [](const Arm::X&) { return true; }});
    x.c.k = read_setup(config, arguments.arm);
    return ecp::execute_rows<Arm>(std::span<const Motion<Arm>>(kGuide), x, port);
  });
}

}  // namespace mrroc::guide
