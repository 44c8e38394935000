#include "edp/platform/shell.hpp"

#include <string_view>
#include <utility>

#include "edp/platform/record.hpp"
#include "edp/platform/telemetry_stream.hpp"
#include "edp/recorder_impl.hpp"
#include "edp/shell_impl.hpp"

namespace mrroc::edp {
namespace {

struct PlatformShell {
  using Effector = PlatformEffector;
  using Driver = PlatformDriver;
  using Format = OwnFormat<PlatformStepRecord>;
  using Stream = TelemetryStream;
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
