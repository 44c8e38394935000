// The operator's words: what is understood are orders within bounds, for arms that are there.
#include "tasks/manual/instruction_script.hpp"

#include <cmath>

#include "test/fuzz/fuzz.hpp"

using namespace mrroc;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<manual::ArmInfo> arms{
      {.key = "arm1", .axes = 6, .presets = {{"front", {}}}, .jaws = true},
      {.key = "arm2", .axes = 7, .presets = {}, .jaws = false}};
  try {
    const manual::Instructions read = manual::understand(fuzz::text_of(data, size), arms);
    fuzz::require(read.end || !read.arms.empty(), "an instruction is for an arm, or ends the session");
    fuzz::require(read.orders.size() == read.arms.size(), "each arm has its order");
    for (const std::size_t arm : read.arms) fuzz::require(arm < arms.size(), "arms are there");
    for (const manual::ManualOrder& order : read.orders) {
      for (const double value : order.value) fuzz::require(std::isfinite(value), "numbers are finite");
      fuzz::require(
          order.velocity > 0 && order.velocity <= 1 && order.acceleration > 0 && order.acceleration <= 1,
          "shares are above 0 and at most 1");
    }
  } catch (const FaultError& e) {
    fuzz::require(e.fault().code == FaultCode::bad_usage, "an instruction that is wrong is bad usage");
    fuzz::require_readable(e.what());
  }
  return 0;
}
