#include "robots/irb6/edp_body.hpp"

#include <algorithm>

#include "edp/driver.hpp"
#include "edp/shell.hpp"
#include "robots/irb6/config.hpp"

namespace mrroc::irb6 {

void run_edp_of_arm(link::Process& process, const Config& config, const link::PartArguments& arguments) {
  const DriverSetup setup = read_driver(config, arguments.arm, "irb6_postument", {});
  const std::vector<std::string> arms = config.texts("robots.order", std::nullopt);
  edp::ShellParameters shell;
  shell.robot = arguments.arm;
  shell.index = static_cast<int>(std::ranges::find(arms, arguments.arm) - arms.begin());
  shell.ecp = "ecp-" + arguments.arm;
  shell.injection = read_command_link(config, arguments.arm);
  edp::Driver driver(*setup.arm, setup.driver);
  edp::run_edp(process, driver, shell);
}

}  // namespace mrroc::irb6
