#include "base/link/child_main.hpp"
#include "tasks/edge_follow/edge_follow.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Control subsystem (ECP) of an arm that follows an edge.",
                                 mrroc::edge_follow::run_ecp);
}
