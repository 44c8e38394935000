#include "tasks/calibrate_cell/calibrate_cell.hpp"

namespace mrroc::calibrate_cell {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  ecp::run_solo_ecp<Arm>(process, config, arguments, [&](Arm::X& x, auto& port) {
    x.c = read_memory(config, arguments.arm);
    return run_program(x, port);
  });
}

}  // namespace mrroc::calibrate_cell
