#include "edp/platform/shell.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "edp/platform/load_note.hpp"
#include "edp/platform/record.hpp"
#include "edp/platform/telemetry_stream.hpp"
#include "edp/recorder_impl.hpp"
#include "edp/shell_impl.hpp"

namespace mrroc::edp {
namespace {

/// Telemetry, and a line to the user when the load cells are wrong.
class PlatformStream {
 public:
  PlatformStream(link::Process& process, const std::string& robot)
      : process_(&process), telemetry_(process, robot) {}

  void send(const PlatformDriver& driver, const Moment& moment) {
    telemetry_.send(driver, moment);
    if (const std::string note = loads_.next(driver.sensors()); !note.empty()) process_->log(note);
  }

 private:
  link::Process* process_;
  TelemetryStream telemetry_;
  LoadNote loads_;
};

struct PlatformShell {
  using Effector = PlatformEffector;
  using Driver = PlatformDriver;
  using Format = OwnFormat<PlatformStepRecord>;
  using Stream = PlatformStream;
  static constexpr std::string_view kSilence =
      "the platform goes on with what it has, and then comes to rest";
};

}  // namespace

template class BasicRecordFiles<PlatformShell::Format>;

void run_edp(link::Process& process, PlatformDriver& driver, AnyPlatformHardware hardware,
             const ShellParameters& parameters) {
  Shell<PlatformShell>(process, driver, std::move(hardware), parameters, {}).run();
}

}  // namespace mrroc::edp
