// Two arms lead a finger around a plate each.
#include <fmt/core.h>

#include <tuple>

#include "sim/arm_task.hpp"
#include "tasks/edge_follow/edge_follow.hpp"

namespace {

using namespace mrroc;

/// Columns of arm1.csv and arm2.csv while the edge is followed.
constexpr std::string_view kColumns =
    "followed(v) = column(3) == 2 ? v : NaN\n"
    "force(k) = followed(sqrt(column(10)**2 + column(11)**2))\n";

std::vector<sim::Picture> pictures(const std::vector<mp::ArmTrace>&, const Config&) {
  const std::string path = fmt::format(
      "{}set size ratio -1\nset xlabel 'to the right [mm]'\nset ylabel 'away from the arm [mm]'\n"
      "set key below\n"
      "plot 'arm1.csv' skip 1 using (-1e3*followed($5)):(1e3*(followed($4)-0.9)) with lines lw 2 lc rgb "
      "'#1f5fa8' "
      "title 'arm 1: rectangle', "
      "'arm2.csv' skip 1 using (-1e3*followed($5)+120):(1e3*(followed($4)-0.9)) with lines lw 2 lc rgb "
      "'#b3541e' "
      "title 'arm 2: ellipse (moved by 120 mm)'\n",
      kColumns);
  const std::string force = fmt::format(
      "{}set xlabel 't [s]'\nset ylabel '|F| [N]'\nset yrange [0:*]\n"
      "plot 'arm1.csv' skip 1 using 2:(force(1)) with lines lc rgb '#1f5fa8' title 'arm 1: rectangle', "
      "'arm2.csv' skip 1 using 2:(force(1)) with lines lc rgb '#b3541e' title 'arm 2: ellipse', "
      "4 with lines dt 2 lc rgb '#667080' title 'desired'\n",
      kColumns);
  return {{"path", path}, {"force", force}};
}

}  // namespace

int main(int argc, char** argv) {
  return sim::run_arm_task({.name = "edge_follow",
                            .about = "Two arms lead a finger around a plate each, pushing with 4 N.",
                            .config = edge_follow::config(),
                            .behaviours = sim::words_of(edge_follow::kEdgeFollow),
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
