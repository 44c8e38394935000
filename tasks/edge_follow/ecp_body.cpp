#include "ecp/solo.hpp"
#include "tasks/edge_follow/edge_follow.hpp"

namespace mrroc::edge_follow {

void run_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  ecp::run_solo_ecp<Arm>(process, config, arguments, [&](Arm::X& x, auto& port) {
    x.c = read_memory(config, arguments.arm);
    return ecp::execute_rows<Arm>(std::span<const Motion<Arm>>(kEdgeFollow), x, port);
  });
}

}  // namespace mrroc::edge_follow
