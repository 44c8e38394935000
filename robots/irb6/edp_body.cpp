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
  const Config injected = config.section("robots." + arguments.arm + ".command_link");
  shell.injection.loss = injected.number("loss", 0.0, {0, 1});
  shell.injection.duplication = injected.number("duplication", 0.0, {0, 1});
  shell.injection.delay = injected.number("delay", 0.0, {0, 1});
  shell.injection.max_delay = injected.integer("max_delay", 2, {1, link::Injection::kMaxDelay}, "macrosteps");
  shell.injection.seed = static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1));
  edp::Driver driver(*setup.arm, setup.driver);
  edp::run_edp(process, driver, shell);
}

}  // namespace mrroc::irb6
