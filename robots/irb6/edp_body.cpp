#include "robots/irb6/edp_body.hpp"

#include "robots/driver_config.hpp"
#include "robots/irb6/config.hpp"

namespace mrroc::irb6 {

void run_edp_of_arm(link::Process& process, const Config& config, const link::PartArguments& arguments) {
  const DriverSetup setup = read_driver(config, arguments.arm, "irb6_postument", {});
  robots::run_driver(process, config, arguments, *setup.arm, setup.driver);
}

}  // namespace mrroc::irb6
