#include "ecp/map/map_process.hpp"

#include "base/link/clocked_inbox.hpp"
#include "base/linked_port.hpp"
#include "base/msg/convert_platform.hpp"
#include "ecp/agent_shell.hpp"
#include "ecp/map/config.hpp"

namespace mrroc::ecp {

void run_map(link::Process& process, const Config& config, const MapAgentNames& names) {
  const MapParameters k = read_map(config);
  const link::ClockedInbox<motion_capture_t> capture(process, names.platform + ".motion_capture",
                                                     {k.capture.period, k.capture.latency});
  link::IncomingLink<PlatformEstimate> estimate(process, estimate_channel(names));
  link::OutgoingLink<MapReport> pose(process, pose_channel(names));
  const link::OtherLinks others{.sources = {capture.source()},
                                .here = [&](std::int64_t, std::int64_t step) { return capture.here(step); },
                                .incoming = {&estimate},
                                .outgoing = {&pose}};
  MotionCapture none;
  none.step = -1;
  run_agent<MapAgent>(process, {.agent = names.agent, .n_s = k.n_s, .others = others},
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

}  // namespace mrroc::ecp
