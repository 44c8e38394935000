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
       .behaviours = sim::names_of(weigh::kWeigh),
       .ends = {"the tool is there", "the arm rests", "the force is zero", "the tool is there",
                "the arm rests", "all readings taken", "the tool is there", "the arm rests",
                "all readings taken", "the driver has it"},
       .ecp = weigh::run_ecp,
       .read = [](const Config& config) { std::ignore = weigh::read_memory(config, "arm1"); },
       .figures = weigh::figures,
       .result = weigh::result},
      argc, argv);
}
