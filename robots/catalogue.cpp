#include "robots/catalogue.hpp"

namespace mrroc::robots {

link::PartBody driver_of(const Kind& kind) {
  return [&kind](link::Process& process, const Config& config, const link::PartArguments& arguments) {
    const auto robot = kind.make();
    run_driver(process, config, arguments, *robot,
               read_driver(config, arguments.arm, *robot, kind.driver, {}));
  };
}

}  // namespace mrroc::robots
