#include "robots/irb6/edp_body.hpp"

#include <algorithm>
#include <iterator>

#include "edp/driver.hpp"
#include "edp/shell.hpp"
#include "mrroc/world_state_t.hpp"
#include "robots/irb6/config.hpp"

namespace mrroc::irb6 {

void run_edp_of_arm(link::Process& process, const Config& config, const link::PartArguments& arguments) {
  process.needs_unlogged("the servo links");
  const DriverSetup setup = read_driver(config, arguments.arm, "irb6_postument", {});
  const std::vector<std::string> arms = config.texts("robots.order", std::nullopt);
  edp::ShellParameters shell;
  shell.robot = arguments.arm;
  const auto place = std::ranges::find(arms, arguments.arm);
  shell.index = static_cast<int>(place - arms.begin());
  if (place == arms.end() || shell.index >= static_cast<int>(std::size(world_state_t{}.robot)))
    throw FaultError(FaultCode::bad_configuration,
                     "robots.order: '" + arguments.arm + "' is not among the first four");
  shell.n_s = setup.driver.n_s;
  shell.dt = setup.driver.dt;
  shell.ecp = "ecp-" + arguments.arm;
  shell.axes = setup.arm->axes();
  shell.recording = read_recording(config, arguments.arm);
  shell.folder = config.text("run.folder", std::nullopt);
  shell.injection = read_command_link(config, arguments.arm);
  edp::Driver driver(*setup.arm, setup.driver);
  edp::run_edp(process, driver, shell);
}

}  // namespace mrroc::irb6
