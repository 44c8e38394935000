// Two arms lead a finger around a plate each.
#include <tuple>

#include "launch/arm_task.hpp"
#include "tasks/edge_follow/edge_follow.hpp"
#include "tasks/edge_follow/plots.hpp"

namespace {

using namespace mrroc;

std::vector<launch::Picture> pictures(const std::vector<mp::ArmTrace>&, const Config& config) {
  return {{.name = "path", .script = edge_follow::path_script(config)},
          {.name = "force", .chart = edge_follow::force_chart(config), .arms = {0, 1}}};
}

}  // namespace

int main(int argc, char** argv) {
  return launch::run_arm_task({.name = "edge_follow",
                               .about = "Two arms lead a finger around a plate each, pushing with 4 N.",
                               .config = edge_follow::config(),
                               .behaviours = launch::words_of(edge_follow::kEdgeFollow),
                               .ecp = edge_follow::run_ecp,
                               .read =
                                   [](const Config& config) {
                                     for (const char* arm : {"arm1", "arm2"})
                                       std::ignore = edge_follow::read_memory(config, arm);
                                   },
                               .figures = edge_follow::figures,
                               .pictures = pictures,
                               .n_s = edge_follow::kPacing.n_s,
                               .arms = {{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}}},
                              argc, argv);
}
