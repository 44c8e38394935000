// One arm weighs its tool.
#include <tuple>

#include "sim/arm_task.hpp"
#include "tasks/weigh/weigh.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return sim::run_arm_task(
      {.name = "weigh",
       .about = "One arm turns its tool and finds its weight and mass centre.",
       .config = weigh::config(),
       .behaviours = sim::words_of(weigh::kWeigh),
       .ecp = weigh::run_ecp,
       .read = [](const Config& config) { std::ignore = weigh::read_memory(config, "arm1"); },
       .figures = weigh::figures,
       .result = weigh::result},
      argc, argv);
}
