#include <algorithm>

#include "base/link/clocked_inbox.hpp"
#include "base/linked_port.hpp"
#include "base/msg/convert_platform.hpp"
#include "ecp/shell.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/keys.hpp"
#include "tasks/rex_drive/locomotion.hpp"

namespace mrroc::rex_drive {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  Parameters k = read_parameters(config);
  link::IncomingLink<Plan> plan(process, plan_channel());
  link::IncomingLink<MapReport> map(process, pose_channel());
  link::OutgoingLink<PlatformEstimate> estimate(process, estimate_channel());
  link::OtherLinks others{.incoming = {&plan, &map}, .outgoing = {&estimate}};
  std::optional<link::ClockedInbox<odometry_reading_t>> odometry;
  if (const auto clock = read_eyes(config)) {
    k.stale = std::max(k.stale, clock->latency + 2 * clock->period);
    odometry.emplace(process, std::string(kPlatform) + ".odometry", *clock);
    others.sources = {odometry->source()};
    others.here = [&odometry](std::int64_t, std::int64_t step) { return odometry->here(step); };
  }
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
              if (odometry) heard.V = odometry->at(heard.e.step).value_or(OdometryReading{});
            });
        port.read(x);
        x.c = begin(k);
        return run_program(x, port);
      });
}

void run_map(link::Process& process, const Config& config, const link::NodeArguments&) {
  ecp::run_map(process, config, map_names());
}

}  // namespace mrroc::rex_drive
