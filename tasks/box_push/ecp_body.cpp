#include "base/linked_port.hpp"
#include "base/msg/convert_platform.hpp"
#include "ecp/shell.hpp"
#include "tasks/box_push/config.hpp"
#include "tasks/box_push/keys.hpp"
#include "tasks/box_push/pusher.hpp"

namespace mrroc::box_push {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  const PusherParameters k = read_pusher(config);
  const ecp::MapAgentNames names = map_names(arguments.arm);
  link::IncomingLink<FragmentOrder> go(process, go_channel(arguments.arm));
  link::IncomingLink<MapReport> map(process, ecp::pose_channel(names));
  link::OutgoingLink<PlatformEstimate> estimate(process, ecp::estimate_channel(names));
  const link::OtherLinks others{.incoming = {&go, &map}, .outgoing = {&estimate}};
  const ecp::PlatformPreparation prepare{
      [&](PlatformCommand& command) { command.map = map.image().value.pose; }};
  ecp::run_ecp<Pusher, PlatformEffector>(process, {.robot = arguments.arm, .sensor = {}, .others = others},
                                         prepare, [&](Pusher::X& x, auto& platform) {
                                           LinkedPort port(
                                               platform,
                                               [&](const Pusher::Y& y) { estimate.set(y.T.estimate); },
                                               [&](Pusher::X& heard) {
                                                 heard.T.go = go.image().value;
                                                 heard.T.map = map.image().value;
                                               });
                                           port.read(x);
                                           x.c.k = k;
                                           return run_pusher(x, port);
                                         });
}

void run_map(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  ecp::run_map(process, config, map_names(arguments.arm));
}

}  // namespace mrroc::box_push
