#include "tasks/manual/cell/arm_reach.hpp"

int main(int argc, char** argv) {
  return mrroc::link::child_main(argc, argv, "Control subsystem (ECP) of an arm that is led by hand.",
                                 mrroc::manual::run_manual_ecp);
}
