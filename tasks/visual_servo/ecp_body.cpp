#include "ecp/solo.hpp"
#include "tasks/visual_servo/camera_links.hpp"
#include "tasks/visual_servo/config.hpp"
#include "tasks/visual_servo/program.hpp"

namespace mrroc::visual_servo {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  Parameters k = read_parameters(config);
  k.by_wall_clock = !process.lock_step();
  CameraLinks cameras(process, {arguments.arm, reading_channels(read_object(config))}, k);
  const auto program = [&](Arm::X& x, auto& arm) {
    ServoPort port(arm, cameras);
    port.read(x);
    x.c = begin(k, x.i);
    return run_program(x, port);
  };
  ecp::run_solo_ecp<Arm>(process, config, arguments, program, cameras.others());
}

}  // namespace mrroc::visual_servo
