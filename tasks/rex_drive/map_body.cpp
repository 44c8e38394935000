#include "base/link/clocked_inbox.hpp"
#include "base/linked_port.hpp"
#include "base/msg/convert_platform.hpp"
#include "ecp/agent_shell.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/keys.hpp"

namespace mrroc::rex_drive {

void run_map(link::Process& process, const Config& config, const link::NodeArguments&) {
  const MapParameters k = read_map(config);
  const link::ClockedInbox<motion_capture_t> capture(process, std::string(kPlatform) + ".motion_capture",
                                                     {k.capture.period, k.capture.latency});
  link::IncomingLink<PlatformEstimate> estimate(process, estimate_channel());
  link::OutgoingLink<MapReport> pose(process, pose_channel());
  const link::OtherLinks others{.sources = {capture.source()},
                                .here = [&](std::int64_t, std::int64_t step) { return capture.here(step); },
                                .incoming = {&estimate},
                                .outgoing = {&pose}};
  MotionCapture none;
  none.step = -1;
  ecp::run_agent<MapAgent>(process, {.agent = kMap, .n_s = k.n_s, .others = others},
                           [&](MapAgent::X& x, auto& agent) {
                             LinkedPort port(
                                 agent, [&](const MapAgent::Y& y) { pose.set(y.T.map); },
                                 [&](MapAgent::X& heard) {
                                   heard.T.estimate = estimate.image().value;
                                   heard.V = capture.at((heard.i - 1) * k.n_s).value_or(none);
                                 });
                             port.read(x);
                             x.c.k = k;
                             return run_map_program(x, port);
                           });
}

}  // namespace mrroc::rex_drive
