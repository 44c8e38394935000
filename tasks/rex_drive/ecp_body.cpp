#include "base/linked_port.hpp"
#include "ecp/shell.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/keys.hpp"
#include "tasks/rex_drive/locomotion.hpp"

namespace mrroc::rex_drive {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  const Parameters k = read_parameters(config);
  link::IncomingLink<Plan> plan(process, plan_channel());
  link::IncomingLink<MapReport> map(process, pose_channel());
  link::OutgoingLink<PlatformEstimate> estimate(process, estimate_channel());
  const link::OtherLinks others{.incoming = {&plan, &map}, .outgoing = {&estimate}};
  const ecp::PlatformPreparation prepare{
      [&](PlatformCommand& command) { command.map = map.image().value.pose; }};
  ecp::run_ecp<Locomotion, PlatformEffector>(
      process, {.robot = arguments.arm, .sensor = {}, .others = others}, prepare,
      [&](Locomotion::X& x, auto& platform) {
        LinkedPort port(
            platform, [&](const Locomotion::Y& y) { estimate.set(y.T.estimate); },
            [&](Locomotion::X& heard) {
              heard.T.desired = plan.image().value;
              heard.T.map = map.image().value;
            });
        port.read(x);
        x.c = begin(k);
        return run_program(x, port);
      });
}

}  // namespace mrroc::rex_drive
