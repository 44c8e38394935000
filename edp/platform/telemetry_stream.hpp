// What a platform's driver thinks, published once per macrostep.
#pragma once
#include <memory>
#include <string>

#include "base/link/process.hpp"
#include "base/msg/convert_platform.hpp"
#include "edp/shell_impl.hpp"
#include "mrroc/platform_telemetry_t.hpp"

namespace mrroc::edp {

/// The stream of a ShellKind whose driver has telemetry(): the channel ROBOT.telemetry, stamped as the replies are.
class TelemetryStream {
 public:
  /// Make it before the process assembles. @param process  must outlive the stream
  TelemetryStream(link::Process& process, const std::string& robot)
      : out_(process.outbox<platform_telemetry_t>(robot + ".telemetry")) {}

  /// Publishes it, in a macrostep that is counted.
  template <class D>
  void send(const D& driver, const Moment& moment) {
    if (!moment.waits) out_->publish(to_message(driver.telemetry()), moment.macrostep);
  }

 private:
  std::unique_ptr<link::Outbox<platform_telemetry_t>> out_;
};

}  // namespace mrroc::edp
