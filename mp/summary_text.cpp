#include "mp/summary_text.hpp"

#include <fmt/format.h>

namespace mrroc::mp {

void print_summary(const Summary& s, const std::string& figures) {
  fmt::print("\n{}: {:.1f} s simulated in {:.1f} s ({:.1f} x real time)\n{}",
             s.stopped ? "stopped"
             : s.fault ? "ended with a fault"
                       : "done",
             s.sim_s, s.wall_s, s.wall_s > 0 ? s.sim_s / s.wall_s : 0, figures);
  for (const SurvivedFault& survived : s.survived)
    fmt::print("fault at {:.2f} s, after which the task went on: {}\n", survived.sim_s,
               describe(survived.fault));
  if (!s.black_box.empty())
    fmt::print("black box, the last 5 s of every process: {} files in the run folder, such as {}\n",
               s.black_box.size(), s.black_box.front());
}

}  // namespace mrroc::mp
