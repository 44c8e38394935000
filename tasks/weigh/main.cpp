// One arm weighs its tool.
#include <tuple>

#include "launch/arm_task.hpp"
#include "tasks/weigh/plots.hpp"
#include "tasks/weigh/weigh.hpp"

int main(int argc, char** argv) {
  using namespace mrroc;
  return launch::run_arm_task(
      {.name = "weigh",
       .about = "One arm turns its tool and finds its weight and mass centre.",
       .config = weigh::config(),
       .behaviours = launch::words_of(weigh::kWeigh),
       .ecp = weigh::run_ecp,
       .read = [](const Config& config) { std::ignore = weigh::read_memory(config, "arm1"); },
       .figures = weigh::figures,
       .pictures =
           [](const std::vector<mp::ArmTrace>& arms, const Config&) {
             return std::vector<launch::Picture>{
                 {.name = "forces", .chart = weigh::forces_chart(arms[0]), .arms = {0, 0}}};
           },
       .result = weigh::result},
      argc, argv);
}
