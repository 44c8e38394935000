#include "base/step_interval.hpp"

#include <cmath>
#include <vector>

#include "base/fault.hpp"

namespace mrroc {

StepInterval read_step_interval(const Config& config, const std::string& key) {
  constexpr double kLastStep = 100'000'000;
  const auto steps = config.list(key, std::vector<double>{}, {0, kLastStep},
                                 {"steps from, to; empty: never", "steps in which that is broken"});
  if (steps.empty()) return {};
  if (steps.size() != 2 || steps[0] != std::floor(steps[0]) || steps[1] != std::floor(steps[1]) ||
      steps[0] >= steps[1])
    throw FaultError(
        FaultCode::bad_configuration,
        key + ": two whole numbers, the first step and a later one, with which it is over; or none");
  return {.from = static_cast<std::int64_t>(steps[0]), .to = static_cast<std::int64_t>(steps[1])};
}

}  // namespace mrroc
