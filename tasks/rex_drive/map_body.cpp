#include "base/linked_port.hpp"
#include "base/msg/convert_platform.hpp"
#include "ecp/agent_shell.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/keys.hpp"

namespace mrroc::rex_drive {
namespace {

/// The readings of the motion capture system: each is visible `latency` steps after it was taken (rule R6).
class CaptureInput {
 public:
  CaptureInput(link::Process& process, const MapParameters& k)
      : process_(process),
        k_(k),
        in_(process.inbox<motion_capture_t>(std::string(kPlatform) + ".motion_capture")) {}

  /// @return links that are waited for
  [[nodiscard]] link::OtherLinks others() {
    return {.sources = {in_.get()}, .here = [this](std::int64_t, std::int64_t step) {
              const std::int64_t n = newest(step);
              return n < 0 || in_->at(n) != nullptr;
            }};
  }
  /// @return the newest reading that is visible in macrostep i; of step -1 when there is none
  /// @throws FaultError malformed_message
  [[nodiscard]] MotionCapture at(std::int64_t i) const {
    const motion_capture_t* const m =
        process_.lock_step() ? in_->at(newest((i - 1) * k_.n_s)) : in_->newest();
    if (!m) {
      MotionCapture none;
      none.step = -1;
      return none;
    }
    if (!is_proper(*m))
      throw FaultError(FaultCode::malformed_message, in_->channel() + ": a number is not proper");
    return from_message(*m);
  }

 private:
  /// @return number of the newest reading that is visible at a step; negative: there is none
  [[nodiscard]] std::int64_t newest(std::int64_t step) const {
    return step < k_.capture.latency ? -1 : (step - k_.capture.latency) / k_.capture.period;
  }

  link::Process& process_;
  MapParameters k_;
  std::unique_ptr<link::Inbox<motion_capture_t>> in_;
};

}  // namespace

void run_map(link::Process& process, const Config& config, const link::NodeArguments&) {
  const MapParameters k = read_map(config);
  CaptureInput capture(process, k);
  link::IncomingLink<PlatformEstimate> estimate(process, estimate_channel());
  link::OutgoingLink<MapReport> pose(process, pose_channel());
  link::OtherLinks others = capture.others();
  others.incoming = {&estimate};
  others.outgoing = {&pose};
  ecp::run_agent<MapAgent>(process, {.agent = kMap, .n_s = k.n_s, .others = others},
                           [&](MapAgent::X& x, auto& agent) {
                             LinkedPort port(
                                 agent, [&](const MapAgent::Y& y) { pose.set(y.T.map); },
                                 [&](MapAgent::X& heard) {
                                   heard.T.estimate = estimate.image().value;
                                   heard.V = capture.at(heard.i);
                                 });
                             port.read(x);
                             x.c.k = k;
                             return run_map_program(x, port);
                           });
}

}  // namespace mrroc::rex_drive
